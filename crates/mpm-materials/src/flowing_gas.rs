//! The isothermal gas of a given density as a law that remembers its volume alone.

use mpm_tensor::Matrix;

use crate::material::volume_alone;
use crate::{DeformationError, Law, Material, TrackedGas};

/// [`TrackedGas`] without shear: F is J^(1/D) I, as that of [`TaitFluid`](crate::TaitFluid).
///
/// A gas shears and thins without end, and its force needs neither: of a sheared F rounding would leave no determinant, and of one that particles far apart thin in every step no number. So J stays at
/// 10¹⁰⁰ where it would be above. J ≤ 0, a cell that a step turns inside out, stays an error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlowingGas(pub TrackedGas);

/// The largest J.
const THINNEST: f64 = 1e100;

impl<const D: usize> Law<D> for FlowingGas {
    type State = ();

    #[inline]
    fn advance(&self, trial: &Matrix<D>, _state: &mut ()) -> Matrix<D> {
        let J = trial.determinant();
        if J > THINNEST && J < f64::INFINITY {
            return Matrix::diagonal(&[THINNEST.powf(1.0 / D as f64); D]);
        }
        volume_alone(trial)
    }

    #[inline]
    fn energy_density(&self, F: &Matrix<D>, _state: &()) -> f64 {
        Material::energy_density(&self.0, F)
    }

    #[inline]
    fn kirchhoff_stress(&self, F: &Matrix<D>, _state: &(), _velocity_gradient: &Matrix<D>) -> Matrix<D> {
        Material::kirchhoff_stress(&self.0, F)
    }

    fn kirchhoff_stress_across(&self, F: &Matrix<D>, _state: &()) -> Option<f64> {
        Material::kirchhoff_stress_across(&self.0, F)
    }

    #[inline]
    fn wave_speed(&self, F: &Matrix<D>, _state: &(), reference_density: f64) -> f64 {
        Material::wave_speed(&self.0, F, reference_density)
    }

    fn check(&self, F: &Matrix<D>) -> Result<(), DeformationError> {
        Material::check(&self.0, F)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::IsothermalGas;

    fn gas() -> FlowingGas {
        FlowingGas(IsothermalGas::CALIBRATED.with_reference_density(2.0).expect("positive"))
    }

    /// Sheared and thinned for as long as one likes it has the same stress; the tracked gas loses its determinant.
    #[test]
    fn neither_shear_nor_thinning_ends_it() {
        let step = Matrix([[1.3, 0.9], [0.4, 1.2]]);
        let (mut F, mut tracked, mut lost) = (Matrix::IDENTITY, Matrix::IDENTITY, false);
        for k in 1..5000 {
            F = gas().advance(&(step * F), &mut ());
            tracked = step * tracked;
            lost |= Material::check(&gas().0, &tracked).is_err();
            assert_eq!(gas().check(&F), Ok(()));
            assert_eq!(
                gas().kirchhoff_stress(&F, &(), &Matrix::ZERO),
                Matrix::diagonal(&[-2.0; 2])
            );
            let expected = 1.2f64.powi(k).min(1e100);
            assert!((F.determinant() / expected - 1.0).abs() < 1e-10, "{k}");
        }
        assert!(lost);
    }

    #[test]
    fn what_is_turned_over_is_an_error() {
        let turned = gas().advance(&Matrix::diagonal(&[1.0, -2.0]), &mut ());
        assert!(gas().check(&turned).is_err());
    }
}
