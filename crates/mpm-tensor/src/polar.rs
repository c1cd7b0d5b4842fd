//! The polar decomposition.

use crate::{Matrix, SingularValues};

/// The polar decomposition F = R S with a proper rotation R and a symmetric S.
///
/// For det F > 0 it is unique and S is the right stretch tensor U = √(Fᵀ F) (Bonet & Wood, *Nonlinear Continuum Mechanics
/// for Finite Element Analysis*, 2nd ed., §4.6). For det F < 0 the smallest singular value takes a negative sign
/// in S, so that R stays a rotation: of all rotations R is the nearest to F in the Frobenius norm. For det F = 0 R is one
/// of several such rotations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Polar<const D: usize> {
    /// The proper rotation R: Rᵀ R = I, det R = 1; without unit.
    pub rotation: Matrix<D>,
    /// The stretch S, exactly symmetric, in the unit of F; positive semidefinite if det F ≥ 0.
    pub stretch: Matrix<D>,
}

impl<const D: usize> Polar<D> {
    /// Decomposes `matrix`; `None` if an entry is not finite.
    pub fn new(matrix: &Matrix<D>) -> Option<Self> {
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
}
