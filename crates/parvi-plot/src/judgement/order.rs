//! The order of convergence.

use super::{MeasuredSeries, Verdict};
use crate::page::MISSING;
use crate::statistics::fit_power_law;

/// Orders p = ln(y₀ / y₁) / ln(x₀ / x₁) between refinements, from the coarsest on, and that of least squares in logarithms, `None` with fewer than two points or values that are not positive.
pub fn orders(series: &MeasuredSeries) -> (Vec<f64>, Option<f64>) {
    let mut pairs = series.pairs();
    pairs.reverse();
    let (x, y): (Vec<f64>, Vec<f64>) = pairs.iter().copied().unzip();
    let law = fit_power_law(&x, &y).ok();
    let overall = law.and_then(|law| Some(law.exponents.first()?.value));
    let between = pairs
        .windows(2)
        .map(|pair| (pair[0].1 / pair[1].1).ln() / (pair[0].0 / pair[1].0).ln());
    (between.collect(), overall)
}

/// Whether the order of least squares is at least so much.
pub fn judge(series: &MeasuredSeries, at_least: f64) -> Verdict {
    let (between, overall) = orders(series);
    let between: Vec<String> = between.iter().map(|order| format!("{order:.2}")).collect();
    let overall_text = overall.map_or(MISSING.to_owned(), |order| format!("{order:.2}"));
    Verdict {
        of: series.name(),
        asked: format!("order ≥ {at_least}"),
        reached: format!("{overall_text} ({})", between.join(", ")),
        pass: overall.is_some_and(|order| order >= at_least),
    }
}

#[cfg(test)]
mod tests {
    use super::super::through;
    use super::*;

    #[test]
    fn a_power_of_the_spacing_has_its_order() {
        let series = through(&[0.1, 0.2, 0.4].map(|h: f64| (h, 3.0 * h.powf(1.7))));
        let verdict = judge(&series, 1.69);
        assert_eq!(verdict.reached, "1.70 (1.70, 1.70)");
        assert!(verdict.pass && !judge(&series, 1.71).pass);
    }

    #[test]
    fn the_coarsest_refinement_comes_first() {
        let verdict = judge(&through(&[(1.0, 1.0), (2.0, 2.0), (4.0, 8.0)]), 2.0);
        assert_eq!(verdict.reached, "1.50 (2.00, 1.00)");
        assert!(!verdict.pass);
        assert!(!judge(&through(&[(1.0, 1.0)]), 0.0).pass);
    }
}
