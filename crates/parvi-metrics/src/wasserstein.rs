//! The Wasserstein distance on the line, exact.

use crate::error::{finite, parameter};
use crate::sorted::SortedSample;
use crate::summation::CompensatedSum;
use crate::{Cloud, MetricError};

const NAME: &str = "the Wasserstein distance";

/// The Wasserstein distance W_p of two weighted samples of the line,
///
/// W_p = ( ∫₀¹ |F⁻¹(u) − G⁻¹(u)|^p du )^{1/p},
///
/// exact through the merged steps of the two quantile functions; sizes may differ. O((M + N) log). Its unit is that of
/// the points.
///
/// Source: C. Villani, *Topics in Optimal Transportation*, 2003, Theorem 2.18 and Remark 2.19.
///
/// # Errors
/// [`MetricError::InvalidParameter`] unless the order p is finite and at least 1, [`MetricError::Overflow`] if a distance, of
/// order 2 its square, exceeds the range of `f64`.
pub fn wasserstein_1d(first: &Cloud<'_, 1>, second: &Cloud<'_, 1>, order: f64) -> Result<f64, MetricError> {
    let is_order = order.is_finite() && order >= 1.0;
    parameter(
        "the order of the Wasserstein distance",
        order,
        is_order,
        "finite and at least 1",
    )?;
    let (first, second) = (SortedSample::along_axis(first, 0), SortedSample::along_axis(second, 0));
    if order == 1.0 {
        return finite(NAME, transport_cost(&first, &second, f64::abs));
    }
    if order == 2.0 {
        return Ok(finite(NAME, transport_cost(&first, &second, |d| d * d))?.sqrt());
    }
    let mut largest = 0.0_f64;
    transport_cost(&first, &second, |d| {
        largest = largest.max(d.abs());
        0.0
    });
    if finite(NAME, largest)? == 0.0 {
        return Ok(0.0);
    }
    // High powers of distances that are no number by themselves are one as shares of the largest.
    let power = transport_cost(&first, &second, |d| (d.abs() / largest).powf(order));
    Ok(largest * power.powf(order.recip()))
}

/// ∫₀¹ c(F⁻¹(u) − G⁻¹(u)) du over the merged steps.
pub(crate) fn transport_cost(first: &SortedSample, second: &SortedSample, mut cost: impl FnMut(f64) -> f64) -> f64 {
    let (mut i, mut j) = (0, 0);
    let mut level = 0.0;
    let mut total = CompensatedSum::default();
    while i < first.values.len() && j < second.values.len() {
        let (f, g) = (first.cumulative[i], second.cumulative[j]);
        let next = f.min(g);
        total.add((next - level) * cost(first.values[i] - second.values[j]));
        i += usize::from(f <= next);
        j += usize::from(g <= next);
        level = next;
    }
    total.value()
}
