//! A guard: principal stretches that rounding can still tell from zero.

use mpm_materials::{DeformationError, Law, Memory};
use mpm_tensor::{Matrix, SingularValues};

/// A law whose trial deformation gradients are first brought back to principal stretches in [1/k, k], with det F > 0.
///
/// A material that yields to large strain (a fixed corotated solid, a plastic one) is sheared and crushed on and on, until the determinant of F is nothing but rounding and the body comes to an end that
/// the motion does not know. F = U diag(σ) Vᵀ becomes U diag(min(max(σ, 1/k), k)) Vᵀ, as in the snow of Stomakhin et al. 2013, §5; where det F < 0 the least stretch is the one that has turned over. An F within the
/// limits stays as it is, to the bit.
pub(crate) struct StretchLimited<'a, const D: usize> {
    pub law: &'a dyn Law<D, State = Memory>,
    /// k > 1.
    pub limit: f64,
}

/// F with its stretches within [1/k, k]; F itself where they are, or where it is not finite.
#[allow(non_snake_case)]
fn limited<const D: usize>(F: &Matrix<D>, limit: f64) -> Matrix<D> {
    // No stretch is above |F|, and the product of all but the least is at most |F|^(D−1).
    let (norm, J) = (F.frobenius_norm(), F.determinant());
    if norm <= limit && J > 0.0 && J * limit >= norm.powi(D as i32 - 1) {
        return *F;
    }
    let Some(SingularValues { left, values, right }) = SingularValues::new(F) else {
        return *F;
    };
    let turned = D > 0 && left.determinant() * right.determinant() < 0.0;
    if !turned && values.iter().all(|&stretch| stretch <= limit && stretch * limit >= 1.0) {
        return *F;
    }
    let mut left = left;
    if turned {
        for row in &mut left.0 {
            row[D - 1] = -row[D - 1];
        }
    }
    let mut stretches = values;
    if turned {
        stretches[D - 1] = -stretches[D - 1];
    }
    let stretches = stretches.map(|stretch| stretch.clamp(limit.recip(), limit));
    left * Matrix::diagonal(&stretches) * right.transpose()
}

#[allow(non_snake_case)]
impl<const D: usize> Law<D> for StretchLimited<'_, D> {
    type State = Memory;

    fn rate_dependent(&self) -> bool {
        self.law.rate_dependent()
    }

    fn virgin(&self, reference_density: f64) -> Memory {
        self.law.virgin(reference_density)
    }

    fn advance(&self, trial: &Matrix<D>, memory: &mut Memory) -> Matrix<D> {
        self.law.advance(&limited(trial, self.limit), memory)
    }

    fn energy_density(&self, F: &Matrix<D>, memory: &Memory) -> f64 {
        self.law.energy_density(F, memory)
    }

    fn kirchhoff_stress(&self, F: &Matrix<D>, memory: &Memory, velocity_gradient: &Matrix<D>) -> Matrix<D> {
        self.law.kirchhoff_stress(F, memory, velocity_gradient)
    }

    fn wave_speed(&self, F: &Matrix<D>, memory: &Memory, reference_density: f64) -> f64 {
        self.law.wave_speed(F, memory, reference_density)
    }

    fn kirchhoff_stresses(
        &self,
        F: &[Matrix<D>],
        states: &[Memory],
        velocity_gradients: &[Matrix<D>],
        stresses: &mut [Matrix<D>],
    ) {
        self.law.kirchhoff_stresses(F, states, velocity_gradients, stresses);
    }

    fn wave_speeds(&self, F: &[Matrix<D>], states: &[Memory], reference_densities: &[f64], wave_speeds: &mut [f64]) {
        self.law.wave_speeds(F, states, reference_densities, wave_speeds);
    }

    fn check(&self, F: &Matrix<D>) -> Result<(), DeformationError> {
        self.law.check(F)
    }

    fn volume_ratio(&self, F: &Matrix<D>, memory: &Memory) -> f64 {
        self.law.volume_ratio(F, memory)
    }
}

#[cfg(test)]
#[allow(non_snake_case)]
mod tests {
    use super::*;

    #[test]
    fn what_is_within_the_limits_stays_to_the_bit() {
        for F in [
            Matrix([[1.0, 0.3], [-0.2, 0.5]]),
            Matrix([[9.0, 0.0], [0.0, 0.11]]),
            Matrix([[0.2, 0.0], [0.0, 0.2]]),
        ] {
            assert_eq!(limited(&F, 10.0), F);
        }
        let broken = Matrix([[f64::NAN, 0.0], [0.0, 1.0]]);
        assert!(limited(&broken, 10.0).0[0][0].is_nan());
    }

    #[test]
    fn stretches_end_at_the_limits_and_keep_their_axes() {
        let (c, s) = (0.6, 0.8);
        let (U, V) = (Matrix([[c, -s], [s, c]]), Matrix([[s, c], [-c, s]]));
        let of = |a: f64, b: f64| U * Matrix::diagonal(&[a, b]) * V.transpose();
        for (given, expected) in [
            ([100.0, 2.0], [10.0, 2.0]),
            ([5.0, 0.01], [5.0, 0.1]),
            ([100.0, 1e-30], [10.0, 0.1]),
            ([5.0, -0.5], [5.0, 0.1]),
            ([1e9, 1e9], [10.0, 10.0]),
            ([0.0, 0.0], [0.1, 0.1]),
        ] {
            let F = limited(&of(given[0], given[1]), 10.0);
            assert!(F.determinant() > 0.0, "{given:?}");
            let values = SingularValues::new(&F).expect("finite").values;
            assert!((values[0] - expected[0]).abs() < 1e-12 && (values[1] - expected[1]).abs() < 1e-12);
            if given != [0.0, 0.0] {
                let difference = F - of(expected[0], expected[1]);
                assert!(difference.frobenius_norm() < 1e-12, "{given:?}");
            }
        }
        let inverted = limited(&Matrix([[-3.0]]), 10.0);
        assert_eq!(inverted, Matrix([[0.1]]));
    }
}
