//! The interface of every law that reads the deformation gradient.

use mpm_tensor::Matrix;

use crate::DeformationError;

/// A hyperelastic material: the stress follows from an energy density ψ(F), F the deformation gradient.
///
/// Symbols: F (D × D, no unit), J = det F, P = ∂ψ/∂F the first Piola–Kirchhoff stress, τ = P Fᵀ = J σ the Kirchhoff stress, σ
/// the Cauchy stress; ψ, P, τ and σ all in energy per D-dimensional volume. The force of a
/// particle on node i is −V⁰_p τ_p ∇w_ip.
///
/// A material that needs no F, such as [`IsothermalGas`](crate::IsothermalGas), does *not* implement this trait, so a
/// step that is generic over `Material` is the only one that has to store F. The trait is object safe.
///
/// Source: Bonet & Wood, *Nonlinear Continuum Mechanics for Finite Element Analysis*, 2nd ed., ch. 5–6.
pub trait Material<const D: usize>: Sync {
    /// ψ(F), the energy per reference volume. Not finite where [`check`](Self::check) fails.
    fn energy_density(&self, F: &Matrix<D>) -> f64;

    /// τ = P Fᵀ, the Kirchhoff stress. Called once per particle and step, without a check of its own: an F for which
    /// [`check`](Self::check) fails gives a stress that is not finite. That of an objective material is symmetric to the bit.
    fn kirchhoff_stress(&self, F: &Matrix<D>) -> Matrix<D>;

    /// τ along each axis that D < 3 leaves out, as [`Law::kirchhoff_stress_across`](crate::Law::kirchhoff_stress_across).
    fn kirchhoff_stress_across(&self, _F: &Matrix<D>) -> Option<f64> {
        None
    }

    /// P = ∂ψ/∂F, the first Piola–Kirchhoff stress. Not finite where [`check`](Self::check) fails.
    fn first_piola_kirchhoff(&self, F: &Matrix<D>) -> Matrix<D>;

    /// An upper bound of the speed c of small waves on the deformed state, in space (length per time), for the CFL condition.
    ///
    /// ρ₀ c² = max over unit vectors a, n of d²/dε² ψ((I + ε a nᵀ) F) at ε = 0, the largest eigenvalue of the acoustic tensor
    /// (Ogden, *Non-Linear Elastic Deformations*, ch. 6). At F = I every member attains it. `reference_density` is ρ₀, mass
    /// per reference volume. Not finite where [`check`](Self::check) fails or ρ₀ ≤ 0.
    fn wave_speed(&self, F: &Matrix<D>, reference_density: f64) -> f64;

    /// [`kirchhoff_stress`](Self::kirchhoff_stress) of many F, as many as `stresses`. Materials that can work on several at once override
    /// it; each result depends on its own F alone, and agrees with that of the single F up to rounding.
    fn kirchhoff_stresses(&self, F: &[Matrix<D>], stresses: &mut [Matrix<D>]) {
        stresses_one_by_one(self, F, stresses);
    }

    /// [`wave_speed`](Self::wave_speed) of many F, in the same way.
    fn wave_speeds(&self, F: &[Matrix<D>], reference_densities: &[f64], wave_speeds: &mut [f64]) {
        wave_speeds_one_by_one(self, F, reference_densities, wave_speeds);
    }

    /// Whether the material has a stress at F; by default, whether J > 0.
    ///
    /// # Errors
    ///
    /// [`DeformationError`] with the entry, or with the volume ratio J where the law needs J > 0.
    fn check(&self, F: &Matrix<D>) -> Result<(), DeformationError> {
        check_volume_ratio(F)
    }

    /// [`kirchhoff_stress`](Self::kirchhoff_stress) after [`check`](Self::check), for use outside the inner loop.
    ///
    /// # Errors
    ///
    /// Those of [`check`](Self::check).
    fn checked_kirchhoff_stress(&self, F: &Matrix<D>) -> Result<Matrix<D>, DeformationError> {
        self.check(F)?;
        Ok(self.kirchhoff_stress(F))
    }
}

/// The stress of every F, one after the other.
#[inline]
pub(crate) fn stresses_one_by_one<const D: usize, M: Material<D> + ?Sized>(
    material: &M,
    F: &[Matrix<D>],
    stresses: &mut [Matrix<D>],
) {
    for (F, stress) in F.iter().zip(stresses) {
        *stress = material.kirchhoff_stress(F);
    }
}

/// The wave speed of every F, one after the other.
#[inline]
pub(crate) fn wave_speeds_one_by_one<const D: usize, M: Material<D> + ?Sized>(
    material: &M,
    F: &[Matrix<D>],
    reference_densities: &[f64],
    wave_speeds: &mut [f64],
) {
    for ((F, &density), wave_speed) in F.iter().zip(reference_densities).zip(wave_speeds) {
        *wave_speed = material.wave_speed(F, density);
    }
}

/// A reference to a material is a material, `&dyn Material<D>` among them.
impl<const D: usize, M: Material<D> + ?Sized> Material<D> for &M {
    fn energy_density(&self, F: &Matrix<D>) -> f64 {
        (**self).energy_density(F)
    }

    fn kirchhoff_stress(&self, F: &Matrix<D>) -> Matrix<D> {
        (**self).kirchhoff_stress(F)
    }

    fn kirchhoff_stress_across(&self, F: &Matrix<D>) -> Option<f64> {
        (**self).kirchhoff_stress_across(F)
    }

    fn first_piola_kirchhoff(&self, F: &Matrix<D>) -> Matrix<D> {
        (**self).first_piola_kirchhoff(F)
    }

    fn wave_speed(&self, F: &Matrix<D>, reference_density: f64) -> f64 {
        (**self).wave_speed(F, reference_density)
    }

    fn kirchhoff_stresses(&self, F: &[Matrix<D>], stresses: &mut [Matrix<D>]) {
        (**self).kirchhoff_stresses(F, stresses);
    }

    fn wave_speeds(&self, F: &[Matrix<D>], reference_densities: &[f64], wave_speeds: &mut [f64]) {
        (**self).wave_speeds(F, reference_densities, wave_speeds);
    }

    fn check(&self, F: &Matrix<D>) -> Result<(), DeformationError> {
        (**self).check(F)
    }
}

/// The error for the first entry of F that is not finite.
pub(crate) fn check_finite<const D: usize>(F: &Matrix<D>) -> Result<(), DeformationError> {
    for (row, entries) in F.0.iter().enumerate() {
        for (column, &value) in entries.iter().enumerate() {
            if !value.is_finite() {
                return Err(DeformationError::NotFinite { row, column, value });
            }
        }
    }
    Ok(())
}

/// The error of an F that is not finite, or whose volume ratio J = det F is not positive and finite.
pub(crate) fn check_volume_ratio<const D: usize>(F: &Matrix<D>) -> Result<(), DeformationError> {
    check_finite(F)?;
    let volume_ratio = F.determinant();
    if volume_ratio > 0.0 && volume_ratio.is_finite() {
        Ok(())
    } else {
        Err(DeformationError::VolumeRatio { volume_ratio })
    }
}

/// J = det F; NaN unless it is positive and finite.
#[inline]
pub(crate) fn volume_ratio<const D: usize>(F: &Matrix<D>) -> f64 {
    let J = F.determinant();
    if J > 0.0 && J < f64::INFINITY { J } else { f64::NAN }
}

/// ln J, J = det F; NaN unless J is positive and finite.
#[inline]
pub(crate) fn log_volume_ratio<const D: usize>(F: &Matrix<D>) -> f64 {
    volume_ratio(F).ln()
}

/// A + s I.
#[inline]
pub(crate) fn shifted<const D: usize>(mut matrix: Matrix<D>, shift: f64) -> Matrix<D> {
    for i in 0..D {
        matrix.0[i][i] += shift;
    }
    matrix
}

/// J^(1/D) I, which has the volume of F and no shear; F itself unless J is positive and finite.
#[inline]
pub(crate) fn volume_alone<const D: usize>(F: &Matrix<D>) -> Matrix<D> {
    let J = F.determinant();
    if !(J > 0.0 && J < f64::INFINITY) {
        return *F;
    }
    let stretch = match D {
        1 => J,
        2 => J.sqrt(),
        3 => J.cbrt(),
        _ => J.powf(1.0 / D as f64),
    };
    Matrix::diagonal(&[stretch; D])
}

/// F⁻ᵀ; all NaN if F has no inverse.
pub(crate) fn inverse_transpose<const D: usize>(F: &Matrix<D>) -> Matrix<D> {
    F.inverse()
        .map_or(Matrix([[f64::NAN; D]; D]), |inverse| inverse.transpose())
}
