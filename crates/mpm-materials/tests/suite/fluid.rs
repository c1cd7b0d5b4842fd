//! What the weakly compressible fluid must satisfy, D = 1…4.

use mpm_materials::{Law, TaitFluid};
use mpm_tensor::Matrix;
use proptest::prelude::*;

use crate::common::{Sample, derivative_of, rotation, stiffness_of};

fn fluid(sample: &Sample) -> TaitFluid {
    TaitFluid::new(sample.reference_density, sample.young_modulus, 0.0).expect("in range")
}

/// A deformation with J in [0.6, 0.95].
fn compression<const D: usize>(sample: &Sample) -> Matrix<D> {
    let F = sample.deformation::<D>();
    let volume_ratio = 0.775 + 0.175 * sample.numbers[64];
    F * (volume_ratio / F.determinant()).powf(1.0 / D as f64)
}

fn conforms<const D: usize>(sample: &Sample) -> Result<(), TestCaseError> {
    let (fluid, F) = (fluid(sample), compression::<D>(sample));
    let density = sample.reference_density;
    let bulk_modulus = density * sample.young_modulus * sample.young_modulus;
    let energy = |F: &Matrix<D>| fluid.energy_density(F, &());
    let stress = fluid.kirchhoff_stress(&F, &(), &Matrix::ZERO);
    let error = (stress - derivative_of(energy, &F) * F.transpose()).frobenius_norm();
    prop_assert!(error < 1e-6 * bulk_modulus, "D = {D}: dψ/dF off by {error:e}");

    let n = sample.direction(1);
    let speed = Law::<D>::wave_speed(&fluid, &F, &(), density);
    for a in [sample.direction(0), n] {
        let stiffness = stiffness_of(energy, &F, &a, &n);
        prop_assert!(stiffness <= density * speed * speed * (1.0 + 1e-3));
    }
    // Sound goes along n at this speed: the bound is attained.
    let stiffness = stiffness_of(energy, &F, &n, &n);
    prop_assert!((density * speed * speed / stiffness - 1.0).abs() < 1e-3);

    let kept = fluid.advance(&F, &mut ());
    prop_assert!((fluid.advance(&kept, &mut ()) - kept).frobenius_norm() < 1e-14);
    prop_assert!((fluid.kirchhoff_stress(&kept, &(), &Matrix::ZERO) - stress).frobenius_norm() < 1e-12 * bulk_modulus);
    let turned = fluid.advance(&(rotation(&sample.block::<D>(2)) * F), &mut ());
    prop_assert!((turned - kept).frobenius_norm() < 1e-14);
    Ok(())
}

/// Viscous stress takes power from every flow, τ_v : L ≥ 0, and turns with the frame.
fn viscosity_dissipates<const D: usize>(sample: &Sample) -> Result<(), TestCaseError> {
    let oil = TaitFluid::new(sample.reference_density, 1.0, sample.young_modulus).expect("in range");
    let F = compression::<D>(sample);
    let velocity_gradient = sample.increment::<D>(0);
    let viscous = |L: &Matrix<D>| oil.kirchhoff_stress(&F, &(), L) - oil.kirchhoff_stress(&F, &(), &Matrix::ZERO);
    let stress = viscous(&velocity_gradient);
    prop_assert!(stress.contract(&velocity_gradient) >= -1e-14);
    prop_assert!(stress.trace().abs() < 1e-13 && stress == stress.transpose());
    let Q = rotation(&sample.block::<D>(2));
    let turned = viscous(&(Q * velocity_gradient * Q.transpose()));
    prop_assert!((turned - Q * stress * Q.transpose()).frobenius_norm() < 1e-13);
    Ok(())
}

properties! {
    pressure: conforms;
    viscosity: viscosity_dissipates;
}
