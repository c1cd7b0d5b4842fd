//! Laws that are neither hyperelastic nor plastic: what they promise, D = 1…4.

use mpm_materials::{ElasticModuli, KelvinVoigt, Law, LinearCauchy, LinearElastic, Material, NeoHookean};
use mpm_tensor::{Matrix, vector};
use proptest::prelude::*;

use crate::common::{Sample, rotation};

/// The Kelvin–Voigt solid is objective, τ(Q F, Q L Qᵀ) = Q τ Qᵀ, and never gains energy from a rate beyond what its spring stores.
fn kelvin_voigt<const D: usize>(sample: &Sample) -> Result<(), TestCaseError> {
    let moduli = ElasticModuli::new(sample.young_modulus, sample.poisson_ratio).expect("in range");
    let law = KelvinVoigt::new(moduli, sample.reference_density).expect("in range");
    let (F, Q, L) = (
        sample.deformation::<D>(),
        rotation(&sample.block::<D>(2)),
        sample.block::<D>(1),
    );
    let stress = law.kirchhoff_stress(&F, &(), &L);
    let turned = law.kirchhoff_stress(&(Q * F), &(), &(Q * L * Q.transpose()));
    let scale = 1.0 + stress.frobenius_norm();
    prop_assert!((turned - Q * stress * Q.transpose()).frobenius_norm() < 1e-12 * scale);
    let spring = Material::kirchhoff_stress(&NeoHookean::new(moduli), &F);
    prop_assert!((stress - spring).contract(&L) >= -1e-13 * scale);
    Ok(())
}

/// Linear elasticity of the Cauchy stress is that of the first Piola–Kirchhoff stress to first order, its stress is symmetric, and its wave speed
/// bounds d/dε of the traction of P = τ F⁻ᵀ along a nᵀ.
fn linear_cauchy<const D: usize>(sample: &Sample) -> Result<(), TestCaseError> {
    let moduli = ElasticModuli::new(sample.young_modulus, sample.poisson_ratio).expect("in range");
    let (law, first_order) = (LinearCauchy::new(moduli), LinearElastic::new(moduli));
    let stress = |F: &Matrix<D>| law.kirchhoff_stress(F, &(), &Matrix::ZERO);
    let F = sample.deformation::<D>();
    prop_assert_eq!(stress(&F), stress(&F).transpose());
    let small = 1e-6;
    let near = Matrix::IDENTITY + (F - Matrix::IDENTITY) * small;
    let difference = stress(&near) - Material::kirchhoff_stress(&first_order, &near);
    prop_assert!(difference.frobenius_norm() < 1e3 * sample.young_modulus * small * small);

    let (a, n) = (sample.direction(0), sample.direction(1));
    let step = 1e-5;
    // P Fᵀ n at F + ε a nᵀ F, with the F of before: τ(ε) (I + ε n aᵀ)⁻¹ n.
    let traction = |epsilon: f64| {
        let moved = Matrix::IDENTITY + Matrix::outer(&a, &n) * epsilon;
        let back = moved.transpose().inverse().expect("a small step");
        stress(&(moved * F)).apply(&back.apply(&n))
    };
    let difference = vector::subtract(&traction(step), &traction(-step));
    let slope = vector::norm(&vector::scale(&difference, 0.5 / step));
    let speed = law.wave_speed(&F, &(), sample.reference_density);
    let bound = sample.reference_density * speed * speed;
    prop_assert!(slope <= bound * (1.0 + 1e-6) + 1e-6, "{slope} above {bound}");
    Ok(())
}

properties! {
    a_spring_beside_a_dashpot: kelvin_voigt;
    small_strain_and_cauchy_stress: linear_cauchy;
}
