//! The quadrature points of a step, whatever they are.

use mpm_materials::Material;
use mpm_tensor::{Matrix, Polar, SymmetricEigen};

use super::instant::Instant;
use super::{Inverted, OnlineError};

/// The least stretch of a limited F.
const LEAST_STRETCH: f64 = 0.1;

/// One entry per point in every list.
#[derive(Clone, Debug, Default)]
pub(super) struct QuadraturePoints<const D: usize> {
    /// x_q.
    pub positions: Vec<[f64; D]>,
    /// v_q.
    pub velocities: Vec<[f64; D]>,
    /// F_q.
    pub gradients: Vec<Matrix<D>>,
    /// m_q / ρ₀: V⁰ of a material point, V_q / J_q of a point of space.
    pub volumes: Vec<f64>,
    /// τ_q.
    stresses: Vec<Matrix<D>>,
    /// Points whose F was limited because of J ≤ 0, counted in every step.
    pub limited: usize,
}

impl<const D: usize> QuadraturePoints<D> {
    /// Number of points.
    pub fn len(&self) -> usize {
        self.positions.len()
    }

    /// No points; the storage stays, and the count of what was limited.
    pub fn clear(&mut self) {
        self.positions.clear();
        self.velocities.clear();
        self.gradients.clear();
        self.volumes.clear();
    }

    /// F and J of a point as they are used: where J ≤ 0 the F that [`Inverted`] asks for, which is counted.
    pub fn admit(
        &mut self,
        gradient: &Matrix<D>,
        reference: &[f64; D],
        now: &Instant<D>,
    ) -> Result<(Matrix<D>, f64), OnlineError> {
        let volume_ratio = gradient.determinant();
        if volume_ratio > 0.0 && volume_ratio.is_finite() {
            return Ok((*gradient, volume_ratio));
        }
        let limited = match now.inverted {
            Inverted::Refuse => None,
            Inverted::Limit => limited(gradient),
        };
        let limited = limited.ok_or_else(|| OnlineError::Inverted {
            step: now.step,
            reference: reference.to_vec(),
            volume_ratio,
        })?;
        self.limited += 1;
        Ok((limited, limited.determinant()))
    }

    /// A point with x_q, v_q, F_q and m_q / ρ₀.
    pub fn push(&mut self, position: [f64; D], velocity: [f64; D], gradient: Matrix<D>, volume: f64) {
        self.positions.push(position);
        self.velocities.push(velocity);
        self.gradients.push(gradient);
        self.volumes.push(volume);
    }

    /// τ_q = τ(F_q) of every point.
    pub fn update_stresses(&mut self, material: &dyn Material<D>) {
        self.stresses.resize(self.gradients.len(), Matrix::ZERO);
        material.kirchhoff_stresses(&self.gradients, &mut self.stresses);
    }

    /// x_q, v_q, m_q / ρ₀ and τ_q.
    pub fn iter(&self) -> impl Iterator<Item = (&[f64; D], &[f64; D], f64, &Matrix<D>)> {
        let vectors = self.positions.iter().zip(&self.velocities);
        let rest = self.volumes.iter().zip(&self.stresses);
        vectors
            .zip(rest)
            .map(|((x, v), (&volume, stress))| (x, v, volume, stress))
    }
}

/// The nearest F whose stretches are at least [`LEAST_STRETCH`]: R Q max(Λ, 0.1) Qᵀ with F = R Q Λ Qᵀ and a rotation R, the smallest stretch being negative where det F < 0, as in
/// G. Irving, J. Teran & R. Fedkiw, *Invertible finite elements for robust simulation of large deformation*, SCA 2004. `None` unless F is finite.
fn limited<const D: usize>(gradient: &Matrix<D>) -> Option<Matrix<D>> {
    let polar = Polar::new(gradient)?;
    let stretch = SymmetricEigen::new(&polar.stretch)?;
    Some(polar.rotation * stretch.map(|value| value.max(LEAST_STRETCH)))
}

#[cfg(test)]
mod tests {
    use mpm_tensor::SingularValues;

    use super::*;

    #[test]
    fn a_limited_gradient_keeps_its_rotation_and_its_large_stretches() {
        let (sine, cosine) = 0.7f64.sin_cos();
        let turn = Matrix([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]]);
        for (least, expected) in [(-0.4, 0.1), (0.0, 0.1), (0.05, 0.1), (0.3, 0.3)] {
            let gradient = turn * Matrix::diagonal(&[1.5, 0.8, least]);
            let found = limited(&gradient).expect("finite");
            let difference = found - turn * Matrix::diagonal(&[1.5, 0.8, expected]);
            assert!(difference.frobenius_norm() < 1e-12, "{least}: {found:?}");
            let values = SingularValues::new(&found).expect("finite").values;
            assert!(values.iter().all(|&value| value > LEAST_STRETCH - 1e-12) && found.determinant() > 0.0);
        }
        assert!(limited(&Matrix([[f64::NAN; 2]; 2])).is_none());
    }
}
