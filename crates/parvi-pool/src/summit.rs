//! Summits: where scouts come to rest, with the normal approximation of the density there.

use mpm_tensor::{Matrix, SymmetricEigen, vector};

use crate::density::Density;

/// Least curvature over the largest one.
const FLATTEST: f64 = 1e-12;

/// A summit bends where log p falls over one standard deviation by more than so many times the ½ of a normal law, and how much of that is believed.
const BENDING: f64 = 3.0;
const STEEPEST: f64 = 1e4;

/// Standard deviations within which a place may be explained by a summit.
const SLOPE: f64 = 2.0;

/// Where a scout came to rest.
#[derive(Clone, Copy, Debug)]
pub(super) struct Summit<const D: usize> {
    pub point: [f64; D],
    pub log_density: f64,
    /// |−∇² log p|, the absolute value taken of the eigenvalues.
    pub precision: Matrix<D>,
    /// Its inverse.
    pub covariance: Matrix<D>,
    /// log det of the precision.
    pub log_determinant: f64,
    /// Whether the curvature is that of a far smaller place than a standard deviation: a ridge that bends, or a flat top that ends.
    pub bends: bool,
}

impl<const D: usize> Summit<D> {
    /// With the absolute curvature, and no standard deviation above `widest`; `None` where there is no curvature.
    pub fn new(point: [f64; D], log_density: f64, curvature: &Matrix<D>, widest: f64) -> Option<Self> {
        let eigen = SymmetricEigen::new(curvature)?;
        let largest = eigen.values.iter().fold(0.0_f64, |most, q| most.max(q.abs()));
        let least = (FLATTEST * largest).max(1.0 / (widest * widest));
        let summit = Self::of(point, log_density, &eigen, |k| eigen.values[k].abs().max(least));
        let sound = largest > 0.0 && summit.precision.is_finite() && summit.covariance.is_finite();
        sound.then_some(summit)
    }

    /// With a precision of these eigenvectors and of a value for each of them.
    fn of(point: [f64; D], log_density: f64, eigen: &SymmetricEigen<D>, value: impl Fn(usize) -> f64) -> Self {
        let precision = SymmetricEigen {
            values: std::array::from_fn(value),
            vectors: eigen.vectors,
        };
        Self {
            point,
            log_density,
            precision: precision.map(|q| q),
            covariance: precision.map(f64::recip),
            log_determinant: precision.values.iter().map(|q| q.ln()).sum(),
            bends: false,
        }
    }

    /// The same with no standard deviation above `widest`.
    pub fn no_wider_than(self, widest: f64) -> Option<Self> {
        let eigen = SymmetricEigen::new(&self.precision)?;
        let least = 1.0 / (widest * widest);
        Some(Self::of(self.point, self.log_density, &eigen, |k| {
            eigen.values[k].max(least)
        }))
    }

    /// The same where every axis v whose standard deviation σ says far less than log p shows has the precision 2 (log p(x) − log p(x + σ v))/σ². D densities.
    ///
    /// Curvature at a point of a bent ridge tells of a needle that leaves it; kernels as long as that would cover nothing and be given the mass of much.
    pub fn measured(self, density: &mut Density<'_, D>) -> Option<Self> {
        let eigen = SymmetricEigen::new(&self.precision)?;
        let places: [[f64; D]; D] = std::array::from_fn(|k| {
            let axis = std::array::from_fn(|row| eigen.vectors.0[row][k]);
            vector::add_scaled(&self.point, eigen.values[k].sqrt().recip(), &axis)
        });
        let there = density.log_densities(&places);
        let falls: [f64; D] = std::array::from_fn(|k| (2.0 * (self.log_density - there[k])).min(STEEPEST));
        let bends = falls.iter().any(|&fall| fall > BENDING);
        let stretch = |k: usize| if falls[k] > BENDING { falls[k] } else { 1.0 };
        Some(Self {
            bends,
            ..Self::of(self.point, self.log_density, &eigen, |k| eigen.values[k] * stretch(k))
        })
    }

    /// Laplace's log ∫ p about it: log p + D/2 log 2π − ½ log det H.
    pub fn log_mass(&self) -> f64 {
        self.log_density + 0.5 * (D as f64 * std::f64::consts::TAU.ln() - self.log_determinant)
    }

    /// Whether another summit is within a standard deviation of this one, and as high.
    pub fn is_near(&self, other: &Self) -> bool {
        self.square_to(&other.point) < 1.0 && (self.log_density - other.log_density).abs() < 1.0
    }

    /// Whether a place is on this summit's own slope, by the normal approximation.
    pub fn explains(&self, place: &[f64; D], log: f64) -> bool {
        let square = self.square_to(place);
        square < SLOPE * SLOPE && (self.log_density - 0.5 * square - log).abs() < 0.25 + 0.1 * square
    }

    /// Squared distance in standard deviations.
    fn square_to(&self, place: &[f64; D]) -> f64 {
        let apart = vector::subtract(place, &self.point);
        vector::dot(&apart, &self.precision.apply(&apart))
    }
}

#[cfg(test)]
mod tests {
    use parvi_targets::{Banana, Frame, Gaussian, Ring, Target};

    use super::*;

    fn summit<const D: usize>(target: &dyn Target<D>, point: [f64; D], curvature: &Matrix<D>) -> Summit<D> {
        let frame = Frame::identity();
        let mut density = Density::of(target, &frame);
        let summit = Summit::new(point, target.log_density(&point), curvature, 200.0).unwrap();
        let measured = summit.measured(&mut density).unwrap();
        assert_eq!(density.evaluations(), D as u64);
        measured
    }

    #[test]
    fn a_normal_law_is_as_its_curvature_says() {
        let covariance = Matrix([[2.0, 0.5], [0.5, 1e-4 + 0.125]]);
        let target = Gaussian::new([1.0, -2.0], covariance).unwrap();
        let summit = summit(&target, [1.0, -2.0], &covariance.inverse().unwrap());
        assert!(!summit.bends && summit.log_mass().abs() < 1e-9, "{summit:?}");
    }

    #[test]
    fn a_ring_bends_and_its_summit_is_no_longer_than_an_arc() {
        let target = Ring::new(2.0, 0.05).unwrap();
        // Across it 1/0.05²; along it nothing.
        let summit = summit(&target, [2.0, 0.0], &Matrix([[400.0, 0.0], [0.0, 1e-9]]));
        assert!(summit.bends);
        assert!(summit.covariance.0[1][1].sqrt() < 2.5, "{summit:?}");
        assert!((summit.covariance.0[0][0] * 400.0 - 1.0).abs() < 0.05);
    }

    #[test]
    fn a_weak_bend_is_none() {
        let target = Banana::new(0.1, 1.0).unwrap();
        assert!(!summit(&target, [0.0, -0.1], &Matrix::IDENTITY).bends);
    }
}
