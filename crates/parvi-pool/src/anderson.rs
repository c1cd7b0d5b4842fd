//! Fixed points faster: Anderson's acceleration.

use mpm_tensor::{Cholesky, Matrix};

/// Earlier iterates that are remembered.
const DEPTH: usize = 5;

/// Relative weight of a penalty on the coefficients.
const PENALTY: f64 = 1e-8;

/// Iterates x ← G(x) mixed so that the residual f = G(x) − x would be least if G were affine:
/// x⁺ = x + f − Σ_j γ_j (Δx_j + Δf_j), γ = argmin |f − Σ_j γ_j Δf_j|.
///
/// D. G. Anderson, *Iterative procedures for nonlinear integral equations*, J. ACM 12, 1965; H. F. Walker, P. Ni, *Anderson acceleration for fixed-point
/// iterations*, SIAM J. Numer. Anal. 49, 2011, Eq. (2.2).
#[derive(Default)]
pub(crate) struct Anderson {
    last: Option<(Vec<f64>, Vec<f64>)>,
    /// Δx and Δf, the oldest first.
    differences: Vec<(Vec<f64>, Vec<f64>)>,
}

impl Anderson {
    /// The next iterate after x with G(x).
    pub fn next(&mut self, x: Vec<f64>, image: &[f64]) -> Vec<f64> {
        let residual: Vec<f64> = image.iter().zip(&x).map(|(g, x)| g - x).collect();
        if let Some((last_x, last_residual)) = &self.last {
            if dot(&residual, &residual) > 4.0 * dot(last_residual, last_residual) {
                self.differences.clear();
            }
            self.differences
                .push((minus(&x, last_x), minus(&residual, last_residual)));
        }
        let excess = self.differences.len().saturating_sub(DEPTH);
        self.differences.drain(..excess);
        let mut next = image.to_vec();
        for (coefficient, (dx, df)) in self.coefficients(&residual).iter().zip(&self.differences) {
            for ((next, dx), df) in next.iter_mut().zip(dx).zip(df) {
                *next -= coefficient * (dx + df);
            }
        }
        self.last = Some((x, residual));
        next
    }

    /// γ by the normal equations; zero where they are singular.
    fn coefficients(&self, residual: &[f64]) -> [f64; DEPTH] {
        let mut normal = Matrix::<DEPTH>::IDENTITY;
        let mut right = [0.0; DEPTH];
        for (i, (_, a)) in self.differences.iter().enumerate() {
            for (j, (_, b)) in self.differences.iter().enumerate() {
                normal.0[i][j] = dot(a, b);
            }
            right[i] = dot(a, residual);
        }
        for i in 0..DEPTH {
            normal.0[i][i] *= 1.0 + PENALTY;
        }
        let solved = Cholesky::new(&normal).map(|factor| factor.solve(&right));
        solved
            .ok()
            .filter(|gamma| gamma.iter().all(|g| g.is_finite()))
            .unwrap_or([0.0; DEPTH])
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn minus(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_affine_map_of_six_dimensions_is_solved_in_seven_steps() {
        let rates = [0.99, 0.9, 0.5, -0.3, 0.95];
        let map = |x: &[f64]| -> Vec<f64> { x.iter().zip(rates).map(|(x, rate)| rate * x + 1.0).collect() };
        let (mut anderson, mut x) = (Anderson::default(), vec![0.0; 5]);
        for _ in 0..7 {
            let image = map(&x);
            x = anderson.next(x, &image);
        }
        for (x, rate) in x.iter().zip(rates) {
            assert!((x * (1.0 - rate) - 1.0).abs() < 1e-4, "{x} {rate}");
        }
    }
}
