//! Median and extremes of a sample, and weighted quantiles.

use super::{StatisticsError, check_finite, check_weighted};

/// Median and extremes of a sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Summary {
    /// The smallest value.
    pub minimum: f64,
    /// The value in the middle.
    pub median: f64,
    /// The largest value.
    pub maximum: f64,
}

/// Median and extremes of `values`; of an even number the median is half-way between the two in the middle.
///
/// # Errors
/// [`StatisticsError::Empty`] without values, [`StatisticsError::NotFinite`] if one is NaN or infinite.
pub fn summarize(values: &[f64]) -> Result<Summary, StatisticsError> {
    if values.is_empty() {
        return Err(StatisticsError::Empty { what: "values" });
    }
    check_finite("values", values)?;
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let last = sorted.len() - 1;
    Ok(Summary {
        minimum: sorted[0],
        median: sorted[last / 2] + 0.5 * (last % 2) as f64 * (sorted[last.div_ceil(2)] - sorted[last / 2]),
        maximum: sorted[last],
    })
}

/// The quantiles of weighted `values` at `levels` ∈ [0, 1]: linear interpolation between the values at the mid-points of
/// their steps in the weighted distribution function, constant beyond the first and last.
///
/// # Errors
/// See [`StatisticsError`]; the weights need the values' number and a positive sum, and levels have to be from 0 to 1.
pub fn weighted_quantile(values: &[f64], weights: Option<&[f64]>, levels: &[f64]) -> Result<Vec<f64>, StatisticsError> {
    let total = check_weighted("values", values, weights)?;
    if let Some(&level) = levels.iter().find(|level| !(0.0..=1.0).contains(*level)) {
        return Err(StatisticsError::Level { level });
    }
    let weight = |index: usize| weights.map_or(1.0, |weights| weights[index]);
    let mut sorted: Vec<(f64, f64)> = (0..values.len())
        .map(|index| (values[index], weight(index) / total))
        .filter(|(_, weight)| *weight > 0.0)
        .collect();
    sorted.sort_unstable_by(|left, right| {
        let by_value = left.0.total_cmp(&right.0);
        by_value.then(left.1.total_cmp(&right.1))
    });
    let mut middles = Vec::with_capacity(sorted.len());
    let mut below = 0.0;
    for (_, weight) in &sorted {
        middles.push(below + 0.5 * weight);
        below += weight;
    }
    let last = sorted.len() - 1;
    let quantile = |level: f64| {
        let next = middles.partition_point(|&middle| middle < level);
        if next == 0 || next > last {
            return sorted[next.min(last)].0;
        }
        let (low, high) = (sorted[next - 1].0, sorted[next].0);
        let fraction = (level - middles[next - 1]) / (middles[next] - middles[next - 1]);
        low + fraction * (high - low)
    };
    Ok(levels.iter().map(|&level| quantile(level)).collect())
}
