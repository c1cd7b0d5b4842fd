//! The polar decomposition.

use crate::scaling::reciprocal_scale;
use crate::{Matrix, SingularValues};

/// The polar decomposition F = R S with a proper rotation R and a symmetric S.
///
/// For det F > 0 it is unique and S is the right stretch tensor U = √(Fᵀ F) (Bonet & Wood, *Nonlinear Continuum
/// Mechanics for Finite Element Analysis*, 2nd ed., §4.6). For det F < 0 the smallest singular value takes a negative
/// sign in S, so that R stays a rotation: of all rotations R is the nearest to F in the Frobenius norm. For det F = 0 R
/// is one of several such rotations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Polar<const D: usize> {
    /// The proper rotation R: Rᵀ R = I, det R = 1; without unit.
    pub rotation: Matrix<D>,
    /// The stretch S, exactly symmetric, in the unit of F; positive semidefinite if det F ≥ 0.
    pub stretch: Matrix<D>,
}

impl<const D: usize> Polar<D> {
    /// Decomposes `matrix`: closed form for D = 2, from the singular values otherwise; `None` if an entry is not
    /// finite.
    #[inline]
    pub fn new(matrix: &Matrix<D>) -> Option<Self> {
        if D == 2 {
            return Self::plane(matrix);
        }
        Self::from_singular_values(matrix)
    }

    /// D = 2: R = [[c, −s], [s, c]] / √(c² + s²) with c = F_00 + F_11 and s = F_10 − F_01, which makes Rᵀ F symmetric
    /// with a trace √(c² + s²) = σ_0 ± σ_1 ≥ 0.
    #[inline]
    fn plane(matrix: &Matrix<D>) -> Option<Self> {
        let factor = reciprocal_scale(matrix)?;
        let scaled = *matrix * factor;
        let (cosine, sine) = (scaled.0[0][0] + scaled.0[1][1], scaled.0[1][0] - scaled.0[0][1]);
        let length = cosine.hypot(sine);
        let mut rotation = Matrix::IDENTITY;
        if length > 0.0 {
            rotation.0[0][0] = cosine / length;
            rotation.0[1][1] = cosine / length;
            rotation.0[0][1] = -sine / length;
            rotation.0[1][0] = sine / length;
        }
        Some(Self {
            rotation,
            stretch: (rotation.transpose() * *matrix).symmetric_part(),
        })
    }

    /// Any D: R = U Vᵀ and S = V diag(σ) Vᵀ.
    fn from_singular_values(matrix: &Matrix<D>) -> Option<Self> {
        let SingularValues {
            mut left,
            mut values,
            right,
        } = SingularValues::new(matrix)?;
        if D > 0 && left.determinant() * right.determinant() < 0.0 {
            values[D - 1] = -values[D - 1];
            for row in &mut left.0 {
                row[D - 1] = -row[D - 1];
            }
        }
        let scaled = Matrix::from_fn(|i, k| right.0[i][k] * values[k]);
        Some(Self {
            rotation: left * right.transpose(),
            stretch: (scaled * right.transpose()).symmetric_part(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rotated_stretch_is_taken_apart() {
        let (sine, cosine) = 0.7f64.sin_cos();
        let rotation = Matrix([[cosine, -sine], [sine, cosine]]);
        let stretch = Matrix([[2.0, 0.5], [0.5, 1.0]]);
        let polar = Polar::new(&(rotation * stretch)).expect("finite entries");
        assert!((polar.rotation - rotation).frobenius_norm() < 1e-15);
        assert!((polar.stretch - stretch).frobenius_norm() < 2e-15);
    }

    #[test]
    fn a_reflection_goes_into_the_stretch() {
        let polar = Polar::new(&Matrix::diagonal(&[3.0, 1.0, -2.0])).expect("finite entries");
        assert!((polar.rotation.determinant() - 1.0).abs() < 1e-15);
        assert_eq!(polar.rotation * polar.stretch, Matrix::diagonal(&[3.0, 1.0, -2.0]));
        assert_eq!(Polar::new(&Matrix([[f64::NAN]])), None);
    }

    #[test]
    fn in_the_plane_the_closed_form_is_that_of_the_singular_values() {
        for matrix in [
            Matrix([[1.2, 0.3], [-0.1, 0.9]]),
            Matrix([[1e-3, 5.0], [-5.0, 2e-3]]),
            Matrix([[-1e200, 3e199], [2e199, -1e200]]),
            Matrix([[1.0, 2.0], [3.0, 1.0]]),
        ] {
            let (closed, general) = (Polar::new(&matrix), Polar::from_singular_values(&matrix));
            let (closed, general) = (closed.expect("finite"), general.expect("finite"));
            assert!((closed.rotation - general.rotation).frobenius_norm() < 2e-15);
            let scale = matrix.maximum_norm();
            assert!((closed.stretch - general.stretch).maximum_norm() < 4e-15 * scale);
        }
        let zero = Polar::new(&Matrix::<2>::ZERO).expect("finite");
        assert_eq!((zero.rotation, zero.stretch), (Matrix::IDENTITY, Matrix::ZERO));
    }
}
