//! Directions to project on.

use parvi_targets::normal_quantile;

use crate::MetricError;
use crate::error::parameter;

/// Unit vectors θ_1…θ_L of ℝᴰ, spread over the sphere.
#[derive(Clone, Debug, PartialEq)]
pub struct Directions<const D: usize> {
    vectors: Vec<[f64; D]>,
}

impl<const D: usize> Directions<D> {
    /// `count` evenly spread directions, the same on every call: one in one dimension, where more add nothing; equal
    /// angles over the half circle in two; above, the Kronecker sequence of the generalised golden ratio through the
    /// normal quantile, divided by the length.
    ///
    /// Source: M. Roberts, *The unreasonable effectiveness of quasirandom sequences*, 2018 (the sequence).
    ///
    /// # Errors
    /// [`MetricError::InvalidParameter`] for a count of zero.
    pub fn evenly_spread(count: usize) -> Result<Self, MetricError> {
        check_count(count)?;
        let count = if D == 1 { 1 } else { count };
        let ratios = golden_ratios::<D>();
        let vector = |index: usize| {
            let mut vector = [0.0; D];
            if D == 2 {
                let (sine, cosine) = (std::f64::consts::PI * (index as f64 + 0.5) / count as f64).sin_cos();
                (vector[0], vector[1]) = (cosine, sine);
            } else {
                vector = ratios.map(|ratio| normal_quantile((0.5 + (index as f64 + 1.0) * ratio).fract()));
            }
            normalised(vector)
        };
        Ok(Self {
            vectors: (0..count).map(vector).collect(),
        })
    }

    /// The unit vectors.
    pub fn vectors(&self) -> &[[f64; D]] {
        &self.vectors
    }
}

fn check_count(count: usize) -> Result<f64, MetricError> {
    parameter("the number of directions", count as f64, count > 0, "at least 1")
}

/// `vector` divided by its length; the first axis for the zero vector.
fn normalised<const D: usize>(vector: [f64; D]) -> [f64; D] {
    let length = mpm_tensor::vector::norm(&vector);
    if length > 0.0 {
        vector.map(|component| component / length)
    } else {
        std::array::from_fn(|axis| f64::from(axis == 0))
    }
}

/// φ^{−1}, …, φ^{−D} for the positive root φ of φ^{D+1} = φ + 1.
fn golden_ratios<const D: usize>() -> [f64; D] {
    let mut root: f64 = 1.5;
    for _ in 0..60 {
        root = (1.0 + root).powf(1.0 / (D as f64 + 1.0));
    }
    std::array::from_fn(|axis| root.powi(-(axis as i32 + 1)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn second_moments<const D: usize>(directions: &Directions<D>, tolerance: f64) {
        let count = directions.vectors().len() as f64;
        for i in 0..D {
            for j in 0..D {
                let moment = directions.vectors().iter().map(|v| v[i] * v[j]).sum::<f64>() / count;
                let expected = if i == j { 1.0 / D as f64 } else { 0.0 };
                assert!((moment - expected).abs() < tolerance, "{D} {i} {j}: {moment}");
            }
        }
        for vector in directions.vectors() {
            assert!((mpm_tensor::vector::norm(vector) - 1.0).abs() < 1e-15);
        }
    }

    #[test]
    fn directions_are_isotropic_unit_vectors() {
        second_moments(&Directions::<1>::evenly_spread(5).unwrap(), 1e-15);
        second_moments(&Directions::<2>::evenly_spread(7).unwrap(), 1e-15);
        second_moments(&Directions::<3>::evenly_spread(500).unwrap(), 0.01);
        second_moments(&Directions::<6>::evenly_spread(500).unwrap(), 0.01);
        assert!(matches!(
            Directions::<2>::evenly_spread(0),
            Err(MetricError::InvalidParameter { .. })
        ));
    }
}
