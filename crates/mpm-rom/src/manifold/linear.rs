use faer::Mat;
use faer::linalg::solvers::Solve;
use mpm_tensor::{Matrix, vector};
use rayon::prelude::*;

use super::{Evaluation, LinearError, Manifold, Pod, Wanted};

/// A linear manifold everywhere in the body: g̃(X, x̂) = X + Σ_k x̂_k u_k(X), the modes of [`Pod`] carried from the material points to any X.
///
/// One dense layer from x̂ to the positions of all material points, trained on the positions alone, has its optimum in the modes of [`Pod`]; what it lacks is a
/// value between the points. Ours: interpolation by cubic radial functions and a linear polynomial,
/// u_k(X) = Σ_q w_qk |X − X_q|³ + c_0k + C_k X with Σ_q w_qk = 0, Σ_q w_qk X_q = 0, which is twice differentiable; ∇_X g̃ is the derivative of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Linear<const D: usize> {
    coordinates: usize,
    reference: Vec<[f64; D]>,
    /// w_qk, then c_0k, then the columns of C_k: row-major, (P + 1 + D) × r vectors.
    weights: Vec<[f64; D]>,
}

impl<const D: usize> Linear<D> {
    /// Interpolates the modes. Costs an elimination of (P + 1 + D)².
    ///
    /// # Errors
    /// [`LinearError::Singular`].
    pub fn new(pod: &Pod<D>) -> Result<Self, LinearError> {
        let (reference, r) = (pod.reference(), pod.coordinates());
        let points = reference.len();
        let size = points + 1 + D;
        let polynomial = |point: usize, term: usize| if term == 0 { 1.0 } else { reference[point][term - 1] };
        let matrix = Mat::from_fn(size, size, |row, column| match (row < points, column < points) {
            (true, true) => vector::distance(&reference[row], &reference[column]).powi(3),
            (true, false) => polynomial(row, column - points),
            (false, true) => polynomial(column, row - points),
            (false, false) => 0.0,
        });
        let modes = pod.modes();
        let values = Mat::from_fn(size, r * D, |row, column| {
            if row < points {
                modes[row * r + column / D][column % D]
            } else {
                0.0
            }
        });
        let weights = matrix.partial_piv_lu().solve(&values);
        let entry = |n: usize| std::array::from_fn(|c| weights[(n / r, n % r * D + c)]);
        let weights: Vec<[f64; D]> = (0..size * r).map(entry).collect();
        if weights.iter().all(vector::is_finite) {
            Ok(Self {
                coordinates: r,
                reference: reference.to_vec(),
                weights,
            })
        } else {
            Err(LinearError::Singular("interpolation between material points"))
        }
    }

    /// Σ_k x̂_k of the weights: one vector for each radial function, then the polynomial's.
    fn at(&self, latent: &[f64]) -> Vec<[f64; D]> {
        let rows = self.weights.chunks_exact(self.coordinates);
        rows.map(|row| {
            let mut sum = [0.0; D];
            for (weight, x) in row.iter().zip(latent) {
                vector::accumulate(&mut sum, *x, weight);
            }
            sum
        })
        .collect()
    }

    /// Σ_q w_q |X − X_q|³ + c_0 + C X and its gradient, for weights of [`Self::at`].
    fn displacement(&self, weights: &[[f64; D]], position: &[f64; D]) -> ([f64; D], Matrix<D>) {
        let (radial, polynomial) = weights.split_at(self.reference.len());
        let (mut value, mut gradient) = ([0.0; D], Matrix::ZERO);
        for (weight, other) in radial.iter().zip(&self.reference) {
            let difference = vector::subtract(position, other);
            let distance = vector::norm(&difference);
            vector::accumulate(&mut value, distance.powi(3), weight);
            gradient += Matrix::outer(weight, &difference) * (3.0 * distance);
        }
        for (term, weight) in polynomial.iter().enumerate() {
            let factor = if term == 0 { 1.0 } else { position[term - 1] };
            vector::accumulate(&mut value, factor, weight);
            for c in 0..D {
                if term > 0 {
                    gradient.0[c][term - 1] += weight[c];
                }
            }
        }
        (value, gradient)
    }
}

impl<const D: usize> Manifold<D> for Linear<D> {
    fn coordinates(&self) -> usize {
        self.coordinates
    }

    fn evaluate(&self, reference: &[[f64; D]], latent: &[f64], wanted: Wanted, out: &mut Evaluation<D>) {
        let r = self.coordinates;
        let weights = self.at(latent);
        let moved = reference.par_iter().map(|position| {
            let (value, gradient) = self.displacement(&weights, position);
            (vector::add(position, &value), Matrix::IDENTITY + gradient)
        });
        (out.positions, out.gradients) = moved.unzip();
        if !wanted.gradients {
            out.gradients.clear();
        }
        out.jacobians.clear();
        if wanted.jacobians {
            let unit = |k: usize| (0..r).map(|j| f64::from(u8::from(j == k))).collect::<Vec<f64>>();
            let modes: Vec<_> = (0..r).map(|k| self.at(&unit(k))).collect();
            let columns = reference
                .par_iter()
                .flat_map_iter(|position| modes.iter().map(move |mode| self.displacement(mode, position).0));
            out.jacobians = columns.collect();
        }
    }
}
