//! The tails of the normal distribution without overflow, underflow or cancellation, in a form that vectorises.

use crate::exponential::exponential;

/// √(2/π).
const ROOT_TWO_OVER_PI: f64 = 0.797_884_560_802_865_4;

/// The polynomial P(y) ≈ (1 + 2z) e^(z²) erfc(z), y = (z − 3) / (z + 3), z ≥ 0, to 3e-16: the first 24 terms of its
/// Chebyshev series, summed at 96 nodes with 60 digits and rewritten in powers of y.
///
/// The map of the half line to [−1, 1] is that of M. M. Shepherd, J. G. Laframboise, *Mathematics of Computation* 36 (1981)
/// 249–253, who have 3.75 for 3.
const SCALED_TAIL: [f64; 24] = [
    1.2530080582697296,
    -0.13562110612458117,
    -0.04756229435342038,
    0.1296451587027594,
    -0.11927366341676002,
    0.0683080273440099,
    -0.023770514891530075,
    0.0025293918156939696,
    0.0018886900977441495,
    -0.0007798322696543306,
    -0.00010515831297813128,
    0.0001250993424583729,
    4.94412434222366e-06,
    -2.0100542268525612e-05,
    -7.187883834404266e-07,
    3.472370944977168e-06,
    3.3669790806407595e-07,
    -6.166011460398726e-07,
    -1.205414228648938e-07,
    1.0183620603842736e-07,
    2.7843881265502222e-08,
    -1.3312919661038687e-08,
    -3.1813541434969274e-09,
    9.862533510345587e-10,
];

/// What Φ(t) and φ(t) are made of, with z = |t|/√2: Φ(−|t|) = `bump` · `half` / `width`, φ(t) = `bump` / √2π.
pub(crate) struct Tail {
    /// ½ (1 + 2z) e^(z²) erfc(z), between ½ and 0.64.
    half: f64,
    /// 1 + 2z.
    width: f64,
    /// e^(−t²/2).
    bump: f64,
}

impl Tail {
    /// The parts for a finite t.
    #[inline(always)]
    pub(crate) fn new(t: f64) -> Self {
        const C: [f64; 24] = SCALED_TAIL;
        let z = t.abs() * std::f64::consts::FRAC_1_SQRT_2;
        let y = (z - 3.0) / (z + 3.0);
        // Four chains in y⁴, for the processor to work on side by side.
        let y2 = y * y;
        let y4 = y2 * y2;
        let mut chains = [C[20], C[21], C[22], C[23]];
        let mut k = 20;
        while k > 0 {
            k -= 4;
            chains = [
                chains[0].mul_add(y4, C[k]),
                chains[1].mul_add(y4, C[k + 1]),
                chains[2].mul_add(y4, C[k + 2]),
                chains[3].mul_add(y4, C[k + 3]),
            ];
        }
        Self {
            half: 0.5 * y2.mul_add(chains[3].mul_add(y, chains[2]), chains[1].mul_add(y, chains[0])),
            width: 1.0 + 2.0 * z,
            bump: exponential(-0.5 * t * t),
        }
    }

    /// Φ(t) for t ≥ 0, Φ(t) e^(t²/2) for t < 0, times `width` = 1 + √2 |t|.
    #[inline(always)]
    fn numerator(&self, t: f64) -> f64 {
        if t < 0.0 {
            self.half
        } else {
            self.width - self.bump * self.half
        }
    }

    /// Φ(t) for t ≥ 0, Φ(t) e^(t²/2) for t < 0.
    #[inline(always)]
    pub(crate) fn without_square(&self, t: f64) -> f64 {
        self.numerator(t) / self.width
    }
}

/// φ(t) / Φ(t), which is −t to leading order as t → −∞.
#[inline(always)]
pub(crate) fn inverse_mills_ratio(t: f64) -> f64 {
    let tail = Tail::new(t);
    let height = if t < 0.0 { 1.0 } else { tail.bump };
    0.5 * ROOT_TWO_OVER_PI * height * tail.width / tail.numerator(t)
}

/// log Φ(t) = −t²/2 + log(½ e^(z²) erfc(z)) for t < 0, log(1 − Φ(−t)) for t ≥ 0.
pub(crate) fn log_normal_distribution(t: f64) -> f64 {
    let tail = Tail::new(t);
    if t < 0.0 {
        (tail.half / tail.width).ln() - 0.5 * t * t
    } else {
        (-tail.bump * tail.half / tail.width).ln_1p()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Computed with 60 digits.
    #[test]
    fn agrees_with_known_values() {
        for (t, log, ratio) in [
            (-1000.0_f64, -500007.82669481216, 1000.000999998),
            (-100.0, -5005.524208694205, 100.00999800099926),
            (-38.5, -745.695270290411, 38.52593909685449),
            (-30.0, -454.3212439563432, 30.033259667433676),
            (-12.0, -75.4106730015688, 12.082214175254284),
            (-8.0, -35.01343715991455, 8.121368112236112),
            (-5.5, -17.77937635262526, 5.671410313897305),
            (-3.0, -6.607726221510349, 3.2830986549304364),
            (-1.25, -2.247625677214318, 1.728816627331054),
            (-0.5, -1.1759117615936185, 1.1410777703680646),
            (-0.0009765625, -0.6939266682991533, 0.7985063637384954),
            (0.0, -std::f64::consts::LN_2, 0.7978845608028654),
            (0.25, -0.5129840754094305, 0.6458393710168173),
            (1.0, -0.17275377902344988, 0.2875999709391784),
            (2.0, -0.02301290932896349, 0.055247862678989956),
            (3.5, -0.00023265614137680455, 0.000872885753654736),
            (5.0, -2.866516129637636e-07, 1.4867199409049056e-06),
            (7.0, -1.279812543886654e-12, 9.134720408376284e-12),
            (8.25, -7.919726314642478e-17, 6.627137455968752e-16),
        ] {
            let (found, found_ratio) = (log_normal_distribution(t), inverse_mills_ratio(t));
            // e^(−t²/2) multiplies the rounding of its argument.
            let tolerance = 2e-15 + 2e-16 * if t > 0.0 { t * t } else { 0.0 };
            assert!((found / log - 1.0_f64).abs() < tolerance, "{t}: {found} for {log}");
            assert!(
                (found_ratio / ratio - 1.0_f64).abs() < tolerance,
                "{t}: {found_ratio} for {ratio}"
            );
        }
    }

    /// d log Φ = φ/Φ and, for r = φ/Φ, r′ = −r (t + r): the functions against their own differences, on a fine grid.
    #[test]
    fn satisfies_its_differential_equations() {
        for i in -4000..=800 {
            let t = 0.01 * f64::from(i);
            let step = 1e-3;
            let slope = |f: fn(f64) -> f64| {
                (8.0 * (f(t + step) - f(t - step)) - (f(t + 2.0 * step) - f(t - 2.0 * step))) / (12.0 * step)
            };
            let ratio = inverse_mills_ratio(t);
            let scale = 1.0 + t.abs();
            assert!(
                (slope(log_normal_distribution) - ratio).abs() < 2e-11 * scale * scale,
                "{t}"
            );
            assert!(
                (slope(inverse_mills_ratio) + ratio * (t + ratio)).abs() < 5e-11 * scale,
                "{t}"
            );
        }
    }

    #[test]
    fn far_tails_are_finite() {
        for t in [-1e150, -1e30, -1e8, -40.0, 40.0, 1e8, 1e30, 1e150] {
            assert!(log_normal_distribution(t).is_finite(), "{t}");
            assert!(inverse_mills_ratio(t).is_finite(), "{t}");
        }
        assert!((inverse_mills_ratio(-1e8) / 1e8 - 1.0).abs() < 1e-15);
        assert!(log_normal_distribution(40.0).abs() < 1e-300);
        assert!(inverse_mills_ratio(f64::NAN).is_nan());
    }
}
