use crate::{Matrix, vector};

impl<const D: usize> Matrix<D> {
    /// An orthogonal matrix by Gram–Schmidt on rows that are drawn one after the other: from the Haar measure if they are standard normal. A row of which no more than
    /// `least` is left is drawn again.
    pub fn orthogonal(least: f64, mut draw: impl FnMut() -> [f64; D]) -> Self {
        let mut rows = [[0.0; D]; D];
        for i in 0..D {
            loop {
                let mut row = draw();
                // Twice, so that rounding leaves no component along the others.
                for _ in 0..2 {
                    for earlier in rows.iter().take(i) {
                        let along = vector::dot(&row, earlier);
                        vector::accumulate(&mut row, -along, earlier);
                    }
                }
                let length = vector::norm(&row);
                if length > least {
                    rows[i] = vector::scale(&row, 1.0 / length);
                    break;
                }
            }
        }
        Self(rows)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_orthonormal_and_one_without_a_part_of_its_own_is_drawn_again() {
        let mut draws = [[3.0, 4.0, 0.0], [6.0, 8.0, 0.0], [1.0, 0.0, 2.0], [0.3, -0.7, 0.2]].into_iter();
        let matrix = Matrix::<3>::orthogonal(1e-3, || draws.next().expect("another draw"));
        assert!(draws.next().is_none());
        assert!((matrix * matrix.transpose() - Matrix::IDENTITY).maximum_norm() < 1e-15);
        assert!(vector::distance(&matrix.0[0], &[0.6, 0.8, 0.0]) < 1e-15);
    }
}
