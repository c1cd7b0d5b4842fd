//! Uniformly random rotations.

use mpm_tensor::{Matrix, vector};
use rand::Rng;
use rand_distr::{Distribution, StandardNormal};

/// An orthogonal matrix from the Haar measure: Gram–Schmidt on the rows of a matrix of normal draws.
pub(crate) fn random_rotation<const D: usize>(generator: &mut impl Rng) -> Matrix<D> {
    let mut rows: [[f64; D]; D] = std::array::from_fn(|_| [0.0; D]);
    for i in 0..D {
        loop {
            let mut row: [f64; D] = std::array::from_fn(|_| StandardNormal.sample(generator));
            for _ in 0..2 {
                // twice is enough: the second pass removes what rounding left
                for earlier in rows.iter().take(i) {
                    let product = vector::dot(&row, earlier);
                    vector::accumulate(&mut row, -product, earlier);
                }
            }
            let length = vector::norm(&row);
            if length > 1e-8 {
                rows[i] = vector::scale(&row, 1.0 / length);
                break;
            }
        }
    }
    Matrix(rows)
}

#[cfg(test)]
mod tests {
    use rand::{SeedableRng, rngs::ChaCha8Rng};

    use super::*;

    #[test]
    fn rows_are_orthonormal() {
        let mut generator = ChaCha8Rng::seed_from_u64(5);
        for _ in 0..20 {
            let rotation = random_rotation::<6>(&mut generator);
            let defect = rotation * rotation.transpose() - Matrix::IDENTITY;
            assert!(defect.maximum_norm() < 1e-14);
        }
    }
}
