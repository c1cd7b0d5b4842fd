//! A power law through measured points, with a confidence interval for the exponent.

use statrs::distribution::{ContinuousCDF, StudentsT};

/// y = c xᵖ through points in logarithms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PowerLaw {
    /// c.
    pub factor: f64,
    /// p.
    pub exponent: f64,
    /// Half the width of the interval that holds p with 95 % confidence: t_{n−2} s / √(Σ (ln x − mean)²) with the residuals'
    /// standard deviation s (n − 2 degrees of freedom).
    pub half_width: f64,
}

/// Least squares of ln y on ln x.
///
/// `None` with fewer than three points, or where a coordinate is not positive and finite, or all x are the same.
pub fn fit(points: &[(f64, f64)]) -> Option<PowerLaw> {
    let valid = |value: f64| value > 0.0 && value.is_finite();
    if points.len() < 3 || !points.iter().all(|&(x, y)| valid(x) && valid(y)) {
        return None;
    }
    let count = points.len() as f64;
    let logs: Vec<(f64, f64)> = points.iter().map(|&(x, y)| (x.ln(), y.ln())).collect();
    let mean = |pick: fn(&(f64, f64)) -> f64| logs.iter().map(pick).sum::<f64>() / count;
    let (mean_x, mean_y) = (mean(|point| point.0), mean(|point| point.1));
    let spread: f64 = logs.iter().map(|(x, _)| (x - mean_x).powi(2)).sum();
    if spread <= 0.0 {
        return None;
    }
    let exponent = logs.iter().map(|(x, y)| (x - mean_x) * (y - mean_y)).sum::<f64>() / spread;
    let intercept = mean_y - exponent * mean_x;
    let residual: f64 = logs.iter().map(|(x, y)| (y - intercept - exponent * x).powi(2)).sum();
    let quantile = StudentsT::new(0.0, 1.0, count - 2.0).ok()?.inverse_cdf(0.975);
    Some(PowerLaw {
        factor: intercept.exp(),
        exponent,
        half_width: quantile * (residual / (count - 2.0) / spread).sqrt(),
    })
}

#[cfg(test)]
mod tests {
    use super::fit;

    #[test]
    fn an_exact_power_is_found_without_doubt() {
        let points: Vec<_> = [0.5, 1.0, 2.0, 7.0].map(|x: f64| (x, 3.0 * x.powf(2.0 / 3.0))).to_vec();
        let law = fit(&points).expect("valid");
        assert!((law.exponent - 2.0 / 3.0).abs() < 1e-14 && (law.factor - 3.0).abs() < 1e-13 && law.half_width < 1e-13);
    }

    /// By hand: x = e⁰, e¹, e², y = e⁰, e², e¹ has slope ½, s² = 1.5, spread 2, t₁(0.975) = 12.7062.
    #[test]
    fn the_interval_is_students() {
        let e = 1f64.exp();
        let law = fit(&[(1.0, 1.0), (e, e * e), (e * e, e)]).expect("valid");
        assert!((law.exponent - 0.5).abs() < 1e-14);
        assert!((law.half_width - 12.7062 * (1.5f64 / 2.0).sqrt()).abs() < 1e-3);
    }

    #[test]
    fn points_without_a_line_have_none() {
        assert_eq!(fit(&[(1.0, 1.0), (2.0, 2.0)]), None);
        assert_eq!(fit(&[(1.0, 1.0), (1.0, 2.0), (1.0, 3.0)]), None);
        assert_eq!(fit(&[(1.0, 1.0), (2.0, -1.0), (3.0, 3.0)]), None);
    }
}
