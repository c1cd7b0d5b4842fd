//! Uniformly random rotations.

use mpm_tensor::Matrix;
use rand::Rng;
use rand_distr::{Distribution, StandardNormal};

/// An orthogonal matrix from the Haar measure: Gram–Schmidt on the rows of a matrix of normal draws.
pub(crate) fn random_rotation<const D: usize>(generator: &mut impl Rng) -> Matrix<D> {
    Matrix::orthogonal(1e-8, || std::array::from_fn(|_| StandardNormal.sample(generator)))
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
