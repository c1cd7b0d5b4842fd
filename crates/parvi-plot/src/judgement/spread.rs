//! How much meshes differ, where nothing exact is known.

use super::{MeasuredSeries, Verdict};
use crate::page::counted;

/// Largest value minus the least, over that at the least x; NaN without points.
fn relative_spread(series: &MeasuredSeries) -> f64 {
    let values = || series.points.iter().map(|point| point.value);
    let largest = values().fold(f64::NEG_INFINITY, f64::max);
    let least = values().fold(f64::INFINITY, f64::min);
    let finest = series.points.first().map_or(f64::NAN, |point| point.value);
    (largest - least) / finest.abs()
}

/// Whether the spread is at most so much; one mesh alone shows nothing.
pub fn judge(series: &MeasuredSeries, at_most: f64) -> Verdict {
    let spread = relative_spread(series);
    Verdict {
        of: series.name(),
        asked: format!("spread ≤ {} %", 100.0 * at_most),
        reached: format!(
            "{:.1} % over {}",
            100.0 * spread,
            counted(series.points.len(), "meshes")
        ),
        pass: series.points.len() > 1 && spread <= at_most,
    }
}

#[cfg(test)]
mod tests {
    use super::super::through;
    use super::*;

    #[test]
    fn the_spread_is_that_of_the_extremes_over_the_finest() {
        let series = through(&[(0.1, 4.77), (0.2, 4.75), (0.4, 4.80)]);
        assert!((relative_spread(&series) - 0.05 / 4.77).abs() < 1e-12);
        assert!(judge(&series, 0.05).pass && !judge(&series, 0.01).pass);
        assert!(!judge(&through(&[]), 0.05).pass);
        assert!(!judge(&through(&[(0.1, 1.0)]), 0.05).pass);
    }
}
