//! Vectors as functions of the place.

use mpm_tensor::{Matrix, vector as algebra};

use crate::manufactured::in_the_plane;
use crate::scene::{Scene, VectorField, VectorTable};
use crate::values::{finite, vector, within};
use crate::{SceneFault, reference};

/// v as a function of the place.
pub(crate) struct PlaceVector<const D: usize>(Box<Field<D>>);

type Field<const D: usize> = dyn Fn(&[f64; D]) -> [f64; D];

impl<const D: usize> PlaceVector<D> {
    /// v(X) = G (X − c).
    fn linear(centre: [f64; D], gradient: Matrix<D>) -> Self {
        Self(Box::new(move |x| gradient.apply(&algebra::subtract(x, &centre))))
    }

    /// v(X).
    pub fn at(&self, x: &[f64; D]) -> [f64; D] {
        (self.0)(x)
    }
}

/// The field that a table describes, 0 without one.
///
/// # Errors
/// [`SceneFault::Value`] for vectors of the wrong length and solutions that do not exist.
pub(crate) fn build<const D: usize>(
    field: &str,
    table: Option<&VectorTable>,
    scene: &Scene,
) -> Result<PlaceVector<D>, SceneFault> {
    let vector_of = |key: &str, list: &[f64]| vector::<D>(&format!("{field}.{key}"), list);
    let table = match table {
        None => return Ok(PlaceVector(Box::new(|_| [0.0; D]))),
        Some(VectorTable::Uniform(list)) => {
            let velocity = vector(field, list)?;
            return Ok(PlaceVector(Box::new(move |_| velocity)));
        }
        Some(VectorTable::Field(table)) => table,
    };
    Ok(match table {
        VectorField::Sine {
            amplitude,
            wave_vector,
            phase,
        } => {
            let amplitude = vector_of("amplitude", amplitude)?;
            let waves = vector_of("wave_vector", wave_vector)?;
            let phase = finite(&format!("{field}.phase"), *phase)?;
            PlaceVector(Box::new(move |x| {
                algebra::scale(&amplitude, (algebra::dot(&waves, x) + phase).sin())
            }))
        }
        VectorField::Rotation { centre, rate } => {
            PlaceVector::linear(vector_of("centre", centre)?, spin(&format!("{field}.rate"), rate)?)
        }
        VectorField::Linear { centre, gradient } => {
            let mut rows = [[0.0; D]; D];
            let (name, square) = (format!("{field}.gradient"), gradient.len() == D);
            within(&name, gradient, square, "a row for each axis of the scene")?;
            for (row, list) in rows.iter_mut().zip(gradient) {
                *row = vector_of("gradient", list)?;
            }
            PlaceVector::linear(vector_of("centre", centre)?, Matrix(rows))
        }
        VectorField::Manufactured { solution } => {
            let solution = reference::manufactured(solution, scene)?;
            PlaceVector(Box::new(move |x| {
                in_the_plane(x, |start| solution.velocity(start, 0.0))
            }))
        }
    })
}

/// The matrix of v = ω × x: ω is one number in the plane and three in space.
pub(crate) fn spin<const D: usize>(field: &str, rate: &[f64]) -> Result<Matrix<D>, SceneFault> {
    let mut matrix = Matrix::<D>::ZERO;
    let omega = match (D, rate.len()) {
        (2, 1) => [0.0, 0.0, vector::<1>(field, rate)?[0]],
        (3, 3) => vector::<3>(field, rate)?,
        _ => {
            let expected = "one number in two dimensions, three in three";
            return Err(SceneFault::value(field, rate, expected));
        }
    };
    for (i, j, value) in [(1, 0, omega[2]), (2, 1, omega[0]), (0, 2, omega[1])] {
        if i < D && j < D {
            matrix.0[i][j] = value;
            matrix.0[j][i] = -value;
        }
    }
    Ok(matrix)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rotations_follow_the_cross_product() {
        let matrix = spin::<3>("rate", &[1.0, 2.0, 3.0]).expect("three numbers");
        // (1, 2, 3) × (4, 5, 6) = (-3, 6, -3).
        assert_eq!(matrix.apply(&[4.0, 5.0, 6.0]), [-3.0, 6.0, -3.0]);
        let matrix = spin::<2>("rate", &[2.0]).expect("one number");
        assert_eq!(matrix.apply(&[1.0, 3.0]), [-6.0, 2.0]);
        assert!(spin::<1>("rate", &[2.0]).is_err());
    }
}
