//! What every [`Material`] must do, as assertions for the tests of whoever writes one. A material that does not do it panics.
//!
//! ```
//! use mpm_materials::{ElasticModuli, NeoHookean, conformance};
//! use mpm_tensor::Matrix;
//!
//! let material = NeoHookean::new(ElasticModuli::new(1e4, 0.3)?);
//! for shear in [-0.4, 0.0, 0.4] {
//!     let F = Matrix([[1.1, shear, 0.0], [0.0, 0.9, 0.1], [0.2, 0.0, 1.0]]);
//!     // Tolerances are relative to Young's modulus.
//!     conformance::stress_is_the_derivative_of_energy(&material, &F, 1e4, "Neo-Hookean");
//!     conformance::wave_speed_bounds_stiffness(&material, &F, 1000.0, 1e4, "Neo-Hookean");
//! }
//! conformance::undefined_is_not_finite::<3>(&material, "Neo-Hookean");
//! # Ok::<(), mpm_materials::ParameterError>(())
//! ```

use mpm_tensor::Matrix;

use crate::Material;

/// The step of differences in F.
const STEP: f64 = 1e-3;

/// P = ∂ψ/∂F by five-point differences, to 1e-9 of `scale` (a stress, as Young's modulus) and ‖P‖; τ = P Fᵀ, and the same with a check.
///
/// # Panics
///
/// Where that is not so, with `what` in the message.
pub fn stress_is_the_derivative_of_energy<const D: usize>(
    material: &dyn Material<D>,
    F: &Matrix<D>,
    scale: f64,
    what: &str,
) {
    let P = material.first_piola_kirchhoff(F);
    let scale = scale + P.frobenius_norm();
    let error = (P - derivative_of(|F| material.energy_density(F), F)).frobenius_norm();
    assert!(error < 1e-9 * scale, "{what}, D = {D}: dψ/dF is off by {error:e}");
    let stress = material.kirchhoff_stress(F);
    let error = (stress - P * F.transpose()).frobenius_norm();
    assert!(error < 1e-13 * scale, "{what}, D = {D}: P Fᵀ is off by {error:e}");
    assert_eq!(material.checked_kirchhoff_stress(F), Ok(stress), "{what}, D = {D}");
}

/// ρ₀ c² ≥ d²/dε² ψ((I + ε a nᵀ) F) at ε = 0 for the axes and diagonals a and n, to 1e-4 of `scale` (a stress) and ‖P‖: a smaller wave speed lets the Courant condition take steps that are too long, and the body explodes without an error.
///
/// # Panics
///
/// Where that is not so, with `what` in the message.
pub fn wave_speed_bounds_stiffness<const D: usize>(
    material: &dyn Material<D>,
    F: &Matrix<D>,
    reference_density: f64,
    scale: f64,
    what: &str,
) {
    let scale = scale + material.first_piola_kirchhoff(F).frobenius_norm();
    let bound = reference_density * material.wave_speed(F, reference_density).powi(2);
    let axis = |k: usize| std::array::from_fn(|axis| if axis == k { 1.0 } else { 0.0 });
    let diagonal = |sign: f64| std::array::from_fn(|axis| sign.powi(axis as i32) / (D as f64).sqrt());
    let directions: Vec<[f64; D]> = (0..D).map(axis).chain([diagonal(1.0), diagonal(-1.0)]).collect();
    for a in &directions {
        for n in &directions {
            let stiffness = stiffness_of(|F| material.energy_density(F), F, a, n);
            assert!(
                stiffness <= bound + 1e-4 * scale,
                "{what}, D = {D}: ρ₀ c² = {bound} is below the stiffness {stiffness} along {a:?}, {n:?}"
            );
        }
    }
}

/// ψ(Q F) = ψ(F) and τ(Q F) = Q τ(F) Qᵀ for a rotation Q, to 1e-13 of `scale` (a stress) and ‖P‖, and τ = τᵀ: no law of small strains does that.
///
/// # Panics
///
/// Where that is not so, with `what` in the message.
pub fn rotations_do_not_matter<const D: usize>(
    material: &dyn Material<D>,
    F: &Matrix<D>,
    Q: &Matrix<D>,
    scale: f64,
    what: &str,
) {
    let tolerance = 1e-13 * (scale + material.first_piola_kirchhoff(F).frobenius_norm());
    let turned = *Q * *F;
    let error = (material.energy_density(&turned) - material.energy_density(F)).abs();
    assert!(error < tolerance, "{what}, D = {D}: ψ(Q F) is off by {error:e}");
    let stress = material.kirchhoff_stress(F);
    let error = (material.kirchhoff_stress(&turned) - *Q * stress * Q.transpose()).frobenius_norm();
    assert!(error < tolerance, "{what}, D = {D}: τ(Q F) is off by {error:e}");
    let error = (stress - stress.transpose()).frobenius_norm();
    assert!(error < tolerance, "{what}, D = {D}: τ is not symmetric by {error:e}");
}

/// Where [`check`](Material::check) fails, τ, P, ψ and c are not finite, at I with one entry of the diagonal turned round, 0, infinite or no number: a step asks for the stress alone, and a particle with a finite
/// one may be turned inside out without an error.
///
/// # Panics
///
/// Where that is not so, with `what` in the message.
pub fn undefined_is_not_finite<const D: usize>(material: &dyn Material<D>, what: &str) {
    for entry in [-1.0, -0.5, 0.0, f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
        for axis in 0..D {
            let F = Matrix::diagonal(&std::array::from_fn(|k| if k == axis { entry } else { 1.0 }));
            if material.check(&F).is_ok() {
                continue;
            }
            let finite = [
                ("τ", material.kirchhoff_stress(&F).is_finite()),
                ("P", material.first_piola_kirchhoff(&F).is_finite()),
                ("ψ", material.energy_density(&F).is_finite()),
                ("c", material.wave_speed(&F, 1.0).is_finite()),
            ];
            for (symbol, is_finite) in finite {
                assert!(
                    !is_finite,
                    "{what}, D = {D}: {symbol} is finite at F = {F:?}, where the material is undefined"
                );
            }
        }
    }
}

/// ∂ψ/∂F_ij by five-point differences.
pub fn derivative_of<const D: usize>(energy: impl Fn(&Matrix<D>) -> f64, F: &Matrix<D>) -> Matrix<D> {
    let moved = |i: usize, j: usize, step: f64| {
        let mut moved = *F;
        moved.0[i][j] += step;
        energy(&moved)
    };
    Matrix::from_fn(|i, j| {
        let near = moved(i, j, STEP) - moved(i, j, -STEP);
        let far = moved(i, j, 2.0 * STEP) - moved(i, j, -2.0 * STEP);
        (8.0 * near - far) / (12.0 * STEP)
    })
}

/// d²/dε² ψ((I + ε a nᵀ) F) at ε = 0 by three-point differences.
pub fn stiffness_of<const D: usize>(
    energy: impl Fn(&Matrix<D>) -> f64,
    F: &Matrix<D>,
    a: &[f64; D],
    n: &[f64; D],
) -> f64 {
    let along = |step: f64| energy(&((Matrix::IDENTITY + Matrix::outer(a, n) * step) * *F));
    (along(STEP) - 2.0 * along(0.0) + along(-STEP)) / (STEP * STEP)
}
