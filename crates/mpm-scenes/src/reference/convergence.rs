//! Order of convergence.

/// Observed orders p_k = ln(e_k / e_{k+1}) / ln(h_k / h_{k+1}) between neighbouring pairs (spacing h, error e).
pub fn orders(errors: &[(f64, f64)]) -> Vec<f64> {
    let pairs = errors.windows(2).filter_map(|pair| match *pair {
        [(h0, e0), (h1, e1)] => Some((e0 / e1).ln() / (h0 / h1).ln()),
        _ => None,
    });
    pairs.collect()
}

/// √(Σ V_p |a_p|² / Σ V_p), the norm that errors of particles are given in; NaN without any.
pub fn weighted_norm<const D: usize>(errors: impl Iterator<Item = (f64, [f64; D])>) -> f64 {
    let (volume, sum) = errors.fold((0.0, 0.0), |(volume, sum), (v, e)| {
        (volume + v, sum + v * e.iter().map(|c| c * c).sum::<f64>())
    });
    (sum / volume).sqrt()
}

#[cfg(test)]
mod tests {
    use super::{orders, weighted_norm};

    #[test]
    fn a_power_of_the_spacing_gives_its_exponent() {
        let errors: Vec<_> = [0.1, 0.05, 0.02].map(|h: f64| (h, 3.0 * h.powf(1.7))).to_vec();
        let orders = orders(&errors);
        assert_eq!(orders.len(), 2);
        assert!(orders.iter().all(|p| (p - 1.7).abs() < 1e-12));
    }

    #[test]
    fn a_constant_error_is_its_length_whatever_the_volumes() {
        let norm = weighted_norm([(0.1, [3.0, 4.0]), (2.0, [-5.0, 0.0])].into_iter());
        assert!((norm - 5.0).abs() < 1e-15);
        assert!(weighted_norm::<2>(std::iter::empty()).is_nan());
    }
}
