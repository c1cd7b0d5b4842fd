//! Points with weights, checked once.

use crate::MetricError;
use crate::summation::sum;

/// A cloud of points x_p ∈ ℝᴰ with weights w_p ≥ 0: the discrete measure Σ_p w_p δ(x_p) / Σ_p w_p.
///
/// The constructors check the input, so every metric can rely on finite points and a positive total weight. Weights
/// need not sum to one; without weights every point has the same.
#[derive(Clone, Copy, Debug)]
pub struct Cloud<'a, const D: usize> {
    points: &'a [[f64; D]],
    weights: Option<&'a [f64]>,
    total: f64,
}

impl<'a, const D: usize> Cloud<'a, D> {
    /// A cloud with equal weights.
    ///
    /// # Errors
    /// [`MetricError::Empty`] without points, [`MetricError::NonFinitePoint`] for a NaN or infinite coordinate.
    pub fn new(points: &'a [[f64; D]]) -> Result<Self, MetricError> {
        if points.is_empty() {
            return Err(MetricError::Empty);
        }
        for (index, point) in points.iter().enumerate() {
            for (axis, &value) in point.iter().enumerate() {
                if !value.is_finite() {
                    return Err(MetricError::NonFinitePoint { index, axis, value });
                }
            }
        }
        Ok(Self {
            points,
            weights: None,
            total: points.len() as f64,
        })
    }

    /// A cloud with one weight per point.
    ///
    /// # Errors
    /// Those of [`Cloud::new`]; [`MetricError::LengthMismatch`] unless there are as many weights as points,
    /// [`MetricError::InvalidWeight`] for a negative, NaN or infinite weight and [`MetricError::InvalidTotalWeight`]
    /// if they sum to zero, to infinity or to less than 1/`f64::MAX`.
    pub fn weighted(points: &'a [[f64; D]], weights: &'a [f64]) -> Result<Self, MetricError> {
        let cloud = Self::new(points)?;
        if weights.len() != points.len() {
            return Err(MetricError::LengthMismatch {
                name: "weights",
                points: points.len(),
                given: weights.len(),
            });
        }
        if let Some((index, &value)) = weights.iter().enumerate().find(|(_, w)| !(w.is_finite() && **w >= 0.0)) {
            return Err(MetricError::InvalidWeight { index, value });
        }
        let total = sum(weights.iter().copied());
        // A reciprocal that overflows could not normalise the weights.
        if !(total.is_finite() && total.recip().is_finite()) {
            return Err(MetricError::InvalidTotalWeight { total });
        }
        Ok(Self {
            weights: Some(weights),
            total,
            ..cloud
        })
    }

    /// [`Cloud::weighted`] or [`Cloud::new`], whichever `weights` asks for.
    ///
    /// # Errors
    /// Those of the two.
    pub fn with_optional_weights(points: &'a [[f64; D]], weights: Option<&'a [f64]>) -> Result<Self, MetricError> {
        match weights {
            Some(weights) => Self::weighted(points, weights),
            None => Self::new(points),
        }
    }

    /// The points.
    pub fn points(&self) -> &'a [[f64; D]] {
        self.points
    }

    /// The weights as given; `None` if all are equal.
    pub fn weights(&self) -> Option<&'a [f64]> {
        self.weights
    }

    /// Number of points M ≥ 1.
    #[allow(clippy::len_without_is_empty)] // never empty
    pub fn len(&self) -> usize {
        self.points.len()
    }

    /// The normalised weight of point `index`; the weights sum to one. Zero beyond the last point.
    pub fn weight(&self, index: usize) -> f64 {
        match self.weights {
            None => f64::from(index < self.points.len()) / self.total,
            Some(weights) => weights.get(index).map_or(0.0, |weight| weight / self.total),
        }
    }

    /// Points with their normalised weights, in order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (&'a [f64; D], f64)> + '_ {
        self.points
            .iter()
            .enumerate()
            .map(|(index, point)| (point, self.weight(index)))
    }

    /// Σ_p w_p² of the normalised weights (1/M for equal ones).
    pub(crate) fn squared_weight_sum(&self) -> f64 {
        match self.weights {
            None => 1.0 / self.total,
            Some(weights) => sum(weights.iter().map(|weight| (weight / self.total).powi(2))),
        }
    }

    /// 1 − Σ_p w_p², the share of pairs of distinct points; an error if only one point has weight.
    pub(crate) fn distinct_pair_share(&self, statistic: &'static str) -> Result<f64, MetricError> {
        let positive = self
            .weights
            .map_or(self.len(), |weights| weights.iter().filter(|w| **w > 0.0).count());
        let share = 1.0 - self.squared_weight_sum();
        if positive < 2 || share <= 0.0 {
            Err(MetricError::TooFewPoints { statistic })
        } else {
            Ok(share)
        }
    }
}

/// Kish's effective sample size (Σ w)² / Σ w² of a list of weights: M for M equal weights, 1 if one holds everything.
///
/// Source: L. Kish, *Survey Sampling*, 1965; A. Kong, 1992 (importance sampling).
///
/// # Errors
/// [`MetricError::Empty`], [`MetricError::InvalidWeight`] and [`MetricError::InvalidTotalWeight`] as for
/// [`Cloud::weighted`].
pub fn effective_sample_size(weights: &[f64]) -> Result<f64, MetricError> {
    let points = vec![[]; weights.len()];
    Ok(Cloud::<0>::weighted(&points, weights)?.squared_weight_sum().recip())
}

#[cfg(test)]
mod tests {
    use super::*;

    const POINTS: [[f64; 2]; 3] = [[0.0, 1.0], [2.0, 3.0], [4.0, 5.0]];

    #[test]
    fn bad_input_is_named() {
        assert_eq!(Cloud::<2>::new(&[]).unwrap_err(), MetricError::Empty);
        let error = Cloud::new(&[[0.0, 1.0], [f64::INFINITY, 0.0]]).unwrap_err();
        assert_eq!(
            error,
            MetricError::NonFinitePoint {
                index: 1,
                axis: 0,
                value: f64::INFINITY
            }
        );
        let error = Cloud::weighted(&POINTS, &[1.0]).unwrap_err();
        assert_eq!(
            error,
            MetricError::LengthMismatch {
                name: "weights",
                points: 3,
                given: 1
            }
        );
        let error = Cloud::weighted(&POINTS, &[1.0, -0.5, 1.0]).unwrap_err();
        assert_eq!(error, MetricError::InvalidWeight { index: 1, value: -0.5 });
        assert!(error.to_string().contains("weight 1 is -0.5"));
        assert!(matches!(
            Cloud::weighted(&POINTS, &[1.0, 1.0, f64::NAN]),
            Err(MetricError::InvalidWeight { index: 2, .. })
        ));
        let error = Cloud::weighted(&POINTS, &[0.0; 3]).unwrap_err();
        assert_eq!(error, MetricError::InvalidTotalWeight { total: 0.0 });
        assert!(matches!(
            Cloud::weighted(&POINTS, &[f64::MAX; 3]),
            Err(MetricError::InvalidTotalWeight { .. })
        ));
        let error = Cloud::weighted(&POINTS, &[5e-324; 3]).unwrap_err();
        assert_eq!(
            error.to_string(),
            "the weights sum to 1.5e-323; the sum and its reciprocal must be positive and finite"
        );
    }

    #[test]
    fn weights_are_normalised() {
        let cloud = Cloud::weighted(&POINTS, &[2.0, 0.0, 6.0]).unwrap();
        assert_eq!(cloud.iter().map(|(_, w)| w).collect::<Vec<_>>(), [0.25, 0.0, 0.75]);
        assert_eq!(Cloud::new(&POINTS).unwrap().weight(2), 1.0 / 3.0);
        assert_eq!(Cloud::new(&POINTS).unwrap().weight(3), 0.0);
    }

    #[test]
    fn effective_sample_size_spans_one_to_all() {
        assert_eq!(effective_sample_size(&[3.0; 8]).unwrap(), 8.0);
        assert_eq!(effective_sample_size(&[0.0, 5.0, 0.0]).unwrap(), 1.0);
        assert!((effective_sample_size(&[1.0, 2.0, 3.0]).unwrap() - 36.0 / 14.0).abs() < 1e-15);
        assert_eq!(effective_sample_size(&[]).unwrap_err(), MetricError::Empty);
    }

    #[test]
    fn pairs_need_two_points_of_positive_weight() {
        let cloud = Cloud::weighted(&POINTS, &[0.0, 1.0, 0.0]).unwrap();
        assert!(matches!(
            cloud.distinct_pair_share("this"),
            Err(MetricError::TooFewPoints { statistic: "this" })
        ));
        assert!((Cloud::new(&POINTS).unwrap().distinct_pair_share("").unwrap() - 2.0 / 3.0).abs() < 1e-15);
    }
}
