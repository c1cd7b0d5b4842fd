//! Random covariances of the plane.

use mpm_tensor::{Cholesky, Matrix};
use rand::Rng;
use rand_distr::{ChiSquared, Distribution};

use crate::TargetError;
use crate::gaussian::standard_normal;

/// The inverse Wishart law of 2 × 2 matrices S, density ∝ |S|^(−(ν+3)/2) exp(−½ tr S⁻¹A), through Bartlett's decomposition of S⁻¹:
/// S⁻¹ = L T Tᵀ Lᵀ with L Lᵀ = A⁻¹, T lower triangular, T₁₁² ~ χ²_ν, T₂₂² ~ χ²_(ν−1), T₂₁ ~ N(0, 1).
#[derive(Clone, Copy, Debug)]
pub struct InverseWishart {
    lower: Matrix<2>,
    squares: [ChiSquared<f64>; 2],
}

impl InverseWishart {
    /// The law of A and ν > 1.
    ///
    /// # Errors
    /// [`TargetError::NotPositiveDefinite`]: A; [`TargetError::OutOfRange`]: ν.
    pub fn new(scatter: &Matrix<2>, degrees_of_freedom: f64) -> Result<Self, TargetError> {
        let factor = Cholesky::new(scatter).ok().and_then(|factor| factor.inverse());
        let lower = factor.and_then(|inverse| Cholesky::new(&inverse).ok());
        let lower = lower.ok_or_else(|| TargetError::NotPositiveDefinite {
            field: "the scatter of the observations".to_owned(),
            axis: 1,
            value: scatter.determinant(),
        })?;
        let square = |value: f64| {
            ChiSquared::new(value).map_err(|_| TargetError::OutOfRange {
                field: "degrees of freedom of an inverse Wishart law".to_owned(),
                value: degrees_of_freedom,
                allowed: "a number above 1",
            })
        };
        Ok(Self {
            lower: *lower.lower(),
            squares: [square(degrees_of_freedom)?, square(degrees_of_freedom - 1.0)?],
        })
    }

    /// Q, lower triangular with a positive diagonal, of a draw S = Qᵀ Q.
    pub fn root(&self, rng: &mut dyn Rng) -> Matrix<2> {
        let [first, second] = self.squares.map(|law| law.sample(rng).sqrt());
        let [below] = standard_normal(rng);
        let [[a, _], [b, c]] = (self.lower * Matrix([[first, 0.0], [below, second]])).0;
        Matrix([[a.recip(), 0.0], [-b / (a * c), c.recip()]])
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand::rngs::ChaCha8Rng;

    use super::*;

    /// The mean of S⁻¹ is ν A⁻¹.
    #[test]
    fn precisions_have_their_mean() {
        let scatter = Matrix([[2.0, -0.6], [-0.6, 0.5]]);
        let law = InverseWishart::new(&scatter, 2.5).unwrap();
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        let (count, mut mean) = (100_000, Matrix([[0.0; 2]; 2]));
        for _ in 0..count {
            let root = law.root(&mut rng);
            mean += (root.transpose() * root).inverse().unwrap() * (1.0 / f64::from(count));
        }
        let expected = scatter.inverse().unwrap() * 2.5;
        assert!((mean - expected).maximum_norm() < 0.02 * expected.maximum_norm());
        assert!(InverseWishart::new(&scatter, 1.0).is_err());
        assert!(InverseWishart::new(&Matrix([[1.0; 2]; 2]), 2.5).is_err());
    }
}
