//! The quadratic B-spline N₂ of a distance.

use mpm_kernels::Lanes;

/// N₂(r) = ¾ − r² for r < ½, ½ (3/2 − r)² for r < 3/2 and zero beyond, r² = `square`.
///
/// Without a case: N₂(r) = ½ max(3/2 − r, 0)² − (3/2) max(½ − r, 0)².
#[inline(always)]
pub(super) fn quadratic(square: Lanes) -> Lanes {
    let r = square.sqrt();
    let outer = (Lanes::splat(1.5) - r).fast_max(Lanes::ZERO);
    let inner = (Lanes::splat(0.5) - r).fast_max(Lanes::ZERO);
    (outer * outer).mul_add(Lanes::splat(0.5), inner * inner * Lanes::splat(-1.5))
}

/// N₂(r) and N₂′(r) / r, r² = `square`; the latter is −2 for r < ½, also at r = 0.
#[inline(always)]
pub(super) fn quadratic_and_slope(square: Lanes) -> (Lanes, Lanes) {
    let r = square.sqrt();
    let outer = (r - Lanes::splat(1.5)).fast_min(Lanes::ZERO) / r;
    let inside = r.simd_lt(Lanes::splat(0.5));
    (quadratic(square), inside.select(Lanes::splat(-2.0), outer))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_the_spline_of_its_pieces() {
        for k in 0..200 {
            let r = 0.01 * f64::from(k);
            let expected = match r {
                r if r < 0.5 => 0.75 - r * r,
                r if r < 1.5 => 0.5 * (1.5 - r) * (1.5 - r),
                _ => 0.0,
            };
            let found = quadratic(Lanes::splat(r * r)).to_array()[2];
            assert!((found - expected).abs() < 4e-16, "N({r}) = {found}, not {expected}");
            let slope = match r {
                r if r < 0.5 => -2.0,
                r if r < 1.5 => (r - 1.5) / r,
                _ => 0.0,
            };
            let (value, found_slope) = quadratic_and_slope(Lanes::splat(r * r));
            assert_eq!(value.to_array()[1], found);
            let found = found_slope.to_array()[1];
            assert!((found - slope).abs() < 1e-14, "N'({r}) / {r} = {found}, not {slope}");
        }
    }
}
