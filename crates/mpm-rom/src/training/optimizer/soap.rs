//! SOAP (N. Vyas et al. 2024, arXiv 2409.11321, Algorithms 3 and 4): Adam in the eigenvectors of Shampoo's preconditioners.

use mpm_dense::{DenseMatrix, SymmetricEigen};

use crate::manifold::network::Layer;

const FIRST_DECAY: f64 = 0.9;
const SECOND_DECAY: f64 = 0.95;
const COVARIANCE_DECAY: f64 = 0.95;
const SMALLEST: f64 = 1e-12;
/// Steps between two updates of the eigenvectors.
const INTERVAL: u64 = 10;

/// For each layer, whose weights and, as a last column, biases are a matrix Θ (m × n) with the gradient G:
///
/// * L ← β₃ L + (1 − β₃) G Gᵀ, R ← β₃ R + (1 − β₃) Gᵀ G; Q_L and Q_R, their eigenvectors, follow by one step of orthogonal iteration, Q ← qr(L Q),
///   at every tenth step;
/// * G' = Q_Lᵀ G Q_R, M ← β₁ M + (1 − β₁) G', S ← β₂ S + (1 − β₂) G'², Θ ← Θ − rate · Q_L [M̂ / (√Ŝ + ε)] Q_Rᵀ, entry by entry, M̂ and Ŝ as in Adam.
///
/// β₁ = 0.9, β₂ = β₃ = 0.95, ε = 1e-12 (ours, by the loss of a training of §5.2). M is turned with the eigenvectors, S is not. A step costs
/// 4 products of m × n with a square matrix and G Gᵀ and Gᵀ G, and at every tenth 6 products more and two factorisations.
#[derive(Clone, Debug)]
pub(in crate::training) struct Soap {
    layers: Vec<Eigenbasis>,
}

/// A layer, and the moments of its gradients.
#[derive(Clone, Debug)]
struct Eigenbasis {
    layer: Layer,
    /// L, R.
    covariances: [DenseMatrix; 2],
    /// Q_L, Q_R.
    vectors: [DenseMatrix; 2],
    /// M.
    first: DenseMatrix,
    /// S.
    second: DenseMatrix,
}

impl Soap {
    /// For parameters that are those of the network, then those of the encoder.
    pub fn new(network: &[Layer], encoder: &[Layer]) -> Self {
        let end = network.last().map_or(0, |layer| layer.bias.end);
        let encoder = encoder
            .iter()
            .map(|layer| Layer::at(end + layer.weights.start, layer.inputs, layer.outputs));
        Self {
            layers: network.iter().cloned().chain(encoder).map(Eigenbasis::new).collect(),
        }
    }

    /// What to add to the parameters in step t, counted from 1.
    pub fn change(&mut self, gradient: &[f64], rate: f64, step: u64) -> Vec<f64> {
        let mut change = vec![0.0; gradient.len()];
        for layer in &mut self.layers {
            layer.step(gradient, rate, step, &mut change);
        }
        change
    }

    /// L, R, Q_L, Q_R, M and S of every layer.
    pub fn numbers(&mut self) -> impl Iterator<Item = &mut f64> {
        let matrices = self.layers.iter_mut().flat_map(|layer| {
            let ([left, right], [left_vectors, right_vectors]) = (&mut layer.covariances, &mut layer.vectors);
            let moments = [&mut layer.first, &mut layer.second];
            [left, right, left_vectors, right_vectors].into_iter().chain(moments)
        });
        matrices.flat_map(DenseMatrix::entries_mut)
    }
}

impl Eigenbasis {
    fn new(layer: Layer) -> Self {
        let (m, n) = (layer.outputs, layer.inputs + 1);
        Self {
            layer,
            covariances: [DenseMatrix::zeros(m, m), DenseMatrix::zeros(n, n)],
            vectors: [DenseMatrix::identity(m), DenseMatrix::identity(n)],
            first: DenseMatrix::zeros(m, n),
            second: DenseMatrix::zeros(m, n),
        }
    }

    /// Where entry (i, j) of Θ stands among the parameters.
    fn position(layer: &Layer, i: usize, j: usize) -> usize {
        if j < layer.inputs {
            layer.weights.start + i * layer.inputs + j
        } else {
            layer.bias.start + i
        }
    }

    fn step(&mut self, gradient: &[f64], rate: f64, step: u64, change: &mut [f64]) {
        let gradient = DenseMatrix::from_fn(self.first.rows(), self.first.columns(), |i, j| {
            gradient[Self::position(&self.layer, i, j)]
        });
        let direction = self.direction(&gradient, step);
        for j in 0..direction.columns() {
            for i in 0..direction.rows() {
                change[Self::position(&self.layer, i, j)] = -rate * direction[(i, j)];
            }
        }
        let products = [
            gradient.times_transposed(&gradient),
            gradient.transposed_times(&gradient),
        ];
        for (covariance, product) in self.covariances.iter_mut().zip(products) {
            for (entry, new) in covariance.entries_mut().zip(product.entries()) {
                *entry = COVARIANCE_DECAY * *entry + (1.0 - COVARIANCE_DECAY) * new;
            }
        }
        if step % INTERVAL == 1 {
            self.turn(step == 1);
        }
    }

    /// Q_L [M̂ / (√Ŝ + ε)] Q_Rᵀ with this gradient in the moments.
    fn direction(&mut self, gradient: &DenseMatrix, step: u64) -> DenseMatrix {
        let [left, right] = &self.vectors;
        let gradient = &left.transposed_times(gradient) * right;
        let power = step as f64;
        let first_scale = 1.0 / (1.0 - FIRST_DECAY.powf(power));
        let second_scale = 1.0 / (1.0 - SECOND_DECAY.powf(power));
        let within = DenseMatrix::from_fn(gradient.rows(), gradient.columns(), |i, j| {
            let (gradient, first, second) = (gradient[(i, j)], &mut self.first[(i, j)], &mut self.second[(i, j)]);
            *first = FIRST_DECAY * *first + (1.0 - FIRST_DECAY) * gradient;
            *second = SECOND_DECAY * *second + (1.0 - SECOND_DECAY) * gradient * gradient;
            (*first * first_scale) / ((*second * second_scale).sqrt() + SMALLEST)
        });
        (left * &within).times_transposed(right)
    }

    /// The eigenvectors follow the covariances: all at once at the beginning, later by a step of orthogonal iteration, which keeps their order.
    fn turn(&mut self, begins: bool) {
        let [left, right] = &self.vectors;
        let first = (left * &self.first).times_transposed(right);
        for (vectors, covariance) in self.vectors.iter_mut().zip(&self.covariances) {
            let found = if begins {
                SymmetricEigen::new(covariance).map(|found| found.vectors)
            } else {
                Some((covariance * vectors).orthonormal_columns())
            };
            // None where the gradient is not finite, which the loss will tell.
            if let Some(found) = found {
                *vectors = found;
            }
        }
        let [left, right] = &self.vectors;
        self.first = &left.transposed_times(&first) * right;
    }
}

#[cfg(test)]
mod tests;
