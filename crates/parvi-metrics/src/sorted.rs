//! Samples of the line in order, as step functions: what turns one-dimensional double sums into O(n log n).

use crate::Cloud;
use crate::summation::CompensatedSum;

/// A discrete measure on the line: values in ascending order and the distribution function at each.
#[derive(Clone, Debug)]
pub(crate) struct SortedSample {
    /// Values, ascending.
    pub(crate) values: Vec<f64>,
    /// F(values\[k\]): total normalised weight of the values up to and including the k-th; the last is 1.
    pub(crate) cumulative: Vec<f64>,
}

impl SortedSample {
    /// The distribution of coordinate `axis` of a cloud. An axis that does not exist counts as zero everywhere.
    pub(crate) fn along_axis<const D: usize>(cloud: &Cloud<'_, D>, axis: usize) -> Self {
        Self::projected(cloud, |point| point.get(axis).copied().unwrap_or(0.0))
    }

    /// The distribution of `projection(x)` under the measure of a cloud. Points without weight are left out.
    pub(crate) fn projected<const D: usize>(cloud: &Cloud<'_, D>, projection: impl Fn(&[f64; D]) -> f64) -> Self {
        let Some(weights) = cloud.weights() else {
            let mut values: Vec<f64> = cloud.points().iter().map(projection).collect();
            values.sort_unstable_by(f64::total_cmp);
            let count = values.len() as f64;
            let cumulative = (1..=values.len()).map(|k| k as f64 / count).collect();
            return Self { values, cumulative };
        };
        let mut pairs: Vec<(f64, f64)> = cloud
            .points()
            .iter()
            .zip(weights)
            .filter(|(_, weight)| **weight > 0.0)
            .map(|(point, weight)| (projection(point), *weight))
            .collect();
        // Ties are ordered by weight, so that the sum does not depend on the order of the points.
        pairs.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
        let mut partial = CompensatedSum::default();
        let mut cumulative: Vec<f64> = pairs
            .iter()
            .map(|(_, weight)| {
                partial.add(*weight);
                partial.value()
            })
            .collect();
        let total = partial.value();
        for value in &mut cumulative {
            *value = (*value / total).min(1.0);
        }
        Self {
            values: pairs.into_iter().map(|(value, _)| value).collect(),
            cumulative,
        }
    }

    /// E|x − x'| = 2 ∫ F (1 − F): a sum of positive terms over the gaps.
    pub(crate) fn mean_absolute_difference(&self) -> f64 {
        let mut total = CompensatedSum::default();
        for (pair, f) in self.values.windows(2).zip(&self.cumulative) {
            total.add((pair[1] - pair[0]) * f * (1.0 - f));
        }
        2.0 * total.value()
    }

    /// The value at which F passes `level`; where F equals it (to rounding) along a gap, the middle of the gap. At level 1 the largest value, however little it weighs.
    pub(crate) fn quantile(&self, level: f64) -> f64 {
        const ROUNDING: f64 = 1e-12;
        let last = self.values.len() - 1;
        if level >= 1.0 {
            return self.values[last];
        }
        let index = self.cumulative.partition_point(|f| *f < level - ROUNDING).min(last);
        let next = (index + 1).min(last);
        let on_gap = level > ROUNDING && (self.cumulative[index] - level).abs() <= ROUNDING;
        if on_gap {
            0.5 * self.values[index] + 0.5 * self.values[next]
        } else {
            self.values[index]
        }
    }

    /// ∫ g(F, G) dx over the gaps of the merged values of two samples, between the smallest and the largest value.
    pub(crate) fn integrate_with(&self, other: &Self, g: impl Fn(f64, f64) -> f64) -> f64 {
        let (mut i, mut j) = (0, 0);
        let (mut f, mut h) = (0.0, 0.0);
        let mut previous = f64::NAN;
        let mut total = CompensatedSum::default();
        while i < self.values.len() || j < other.values.len() {
            let mine = self.values.get(i).copied().unwrap_or(f64::INFINITY);
            let theirs = other.values.get(j).copied().unwrap_or(f64::INFINITY);
            let value = mine.min(theirs);
            if !previous.is_nan() {
                total.add((value - previous) * g(f, h));
            }
            if mine <= theirs {
                f = self.cumulative[i];
                i += 1;
            } else {
                h = other.cumulative[j];
                j += 1;
            }
            previous = value;
        }
        total.value()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gaps_give_the_mean_difference() {
        let points = [[3.0], [0.0], [1.0]];
        let sample = SortedSample::along_axis(&Cloud::new(&points).unwrap(), 0);
        assert_eq!(sample.values, [0.0, 1.0, 3.0]);
        assert!((sample.mean_absolute_difference() - 12.0 / 9.0).abs() < 1e-15);
        let weighted = SortedSample::along_axis(&Cloud::weighted(&points, &[1.0, 0.0, 3.0]).unwrap(), 0);
        assert_eq!(
            (weighted.values.as_slice(), weighted.cumulative.as_slice()),
            (&[1.0, 3.0][..], &[0.75, 1.0][..])
        );
    }

    #[test]
    fn integral_over_the_merged_gaps() {
        let a = SortedSample::along_axis(&Cloud::new(&[[0.0], [2.0]]).unwrap(), 0);
        let b = SortedSample::along_axis(&Cloud::new(&[[1.0], [2.0]]).unwrap(), 0);
        assert_eq!(a.integrate_with(&b, |f, g| (f - g).abs()), 0.5);
        assert_eq!(b.integrate_with(&a, |f, g| f - g), -0.5);
    }
}
