//! The matrix of Gauss and Newton of the loss: its Hessian without the curvature of the network.

use faer::linalg::matmul::matmul;
use faer::{Accum, MatMut, MatRef, Par};
use rayon::prelude::*;

use super::loss::Weights;
use crate::manifold::Network;
use crate::manifold::network::{SeedAdjoint, SeedTarget, Tape};

/// Samples whose rows are held at a time.
const SAMPLES: usize = 128;
/// Columns that are summed by one thread.
const PANEL: usize = 128;

/// A sample (x̂, X).
pub(super) struct Site<'a, const D: usize> {
    pub latent: &'a [f64],
    pub reference: [f64; D],
}

/// 2 Σ share w ∇r ∇rᵀ over the residuals r of g̃ (w = 1/ℓ²) and ∇_X g̃ (w = λ_F) at the sites; the velocities' term is left out. Symmetric,
/// row-major, parameters × parameters, the same bits for any number of threads.
pub(super) fn normal_matrix<const D: usize>(
    network: &Network<D>,
    weights: &Weights,
    sites: &[Site<'_, D>],
) -> Vec<f64> {
    let size = network.parameters().len();
    let per_site = rows_per_site::<D>(weights);
    let mut matrix = vec![0.0; size * size];
    let mut rows = vec![0.0; SAMPLES * per_site * size];
    for sites in sites.chunks(SAMPLES) {
        let rows = &mut rows[..sites.len() * per_site * size];
        let tasks = rows.par_chunks_exact_mut(per_site * size).zip(sites);
        tasks.for_each_init(Tape::default, |tape, (rows, site)| {
            site_rows(network, weights, site, tape, rows)
        });
        let jacobian = MatRef::from_row_major_slice(rows, sites.len() * per_site, size);
        // Symmetric, so that columns and rows are the same: panel n holds columns n PANEL and on, from its own first row down.
        matrix
            .par_chunks_mut(PANEL * size)
            .enumerate()
            .for_each(|(panel, columns)| {
                let (first, width) = (panel * PANEL, columns.len() / size);
                let below = MatMut::from_column_major_slice_mut(columns, size, width).subrows_mut(first, size - first);
                let (left, right) = (jacobian.subcols(first, size - first), jacobian.subcols(first, width));
                matmul(below, Accum::Add, left.transpose(), right, 1.0, Par::Seq);
            });
    }
    for i in 0..size {
        for j in 0..i {
            matrix[i * size + j] = matrix[j * size + i];
        }
    }
    matrix
}

fn rows_per_site<const D: usize>(weights: &Weights) -> usize {
    if weights.gradient > 0.0 { D * (1 + D) } else { D }
}

/// √(2 share w) ∂r/∂parameters of one site, row by row.
fn site_rows<const D: usize>(
    network: &Network<D>,
    weights: &Weights,
    site: &Site<'_, D>,
    tape: &mut Tape,
    rows: &mut [f64],
) {
    let gradients = weights.gradient > 0.0;
    let (size, scaling) = (network.parameters().len(), network.scaling());
    let seed = network.seed(site.latent, gradients, std::iter::empty());
    let reference = [site.reference];
    network.forward(&reference, &seed, tape);
    let columns = if gradients { 1 + D } else { 1 };
    for (number, row) in rows.chunks_exact_mut(size).enumerate() {
        let (component, column) = (number / columns, number % columns);
        let weight = if column == 0 {
            scaling.length().powi(-2)
        } else {
            weights.gradient
        };
        tape.zero_output(D);
        tape.output_mut(component, column)[0] = (2.0 * weights.share * weight).sqrt() * scaling.deviation[component];
        row.fill(0.0);
        let mut adjoint = SeedAdjoint::zero(&seed);
        network.reverse(&reference, tape, row, &mut adjoint);
        let mut latent = vec![0.0; site.latent.len()];
        let mut target = SeedTarget {
            parameters: row,
            latent: &mut latent,
            direction: &mut [],
        };
        network.reverse_seed(&adjoint, gradients, site.latent, None, &mut target);
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand::rngs::ChaCha8Rng;

    use super::*;
    use crate::manifold::{Evaluation, Manifold, NetworkShape, Scaling, Wanted};

    /// All weighted residuals of a site, targets left out: they do not depend on the parameters.
    fn residuals(network: &Network<2>, weights: &Weights, site: &Site<'_, 2>) -> Vec<f64> {
        let wanted = Wanted {
            gradients: true,
            jacobians: false,
        };
        let mut out = Evaluation::default();
        network.evaluate(&[site.reference], site.latent, wanted, &mut out);
        let position = (2.0 * weights.share).sqrt() / network.scaling().length();
        let gradient = (2.0 * weights.share * weights.gradient).sqrt();
        let (x, f) = (out.positions[0], out.gradients[0].0);
        let of_gradient = f.into_iter().flatten().map(|entry| gradient * entry);
        x.into_iter().map(|entry| position * entry).chain(of_gradient).collect()
    }

    #[test]
    fn it_is_the_sum_of_products_of_central_differences() {
        let shape = NetworkShape {
            coordinates: 2,
            width: 4,
            depth: 2,
        };
        let scaling = Scaling {
            centre: vec![0.1, -0.1],
            factor: vec![0.9, 1.2],
            mean: vec![0.05, 0.1],
            deviation: vec![0.7, 1.1],
        };
        let mut network = Network::<2>::start(shape, scaling, &mut ChaCha8Rng::seed_from_u64(3)).expect("sound");
        let weights = Weights {
            gradient: 0.7,
            velocity: 0.0,
            interval: 1.0,
            share: 0.3,
        };
        let (first, second) = ([0.3, -0.2], [-0.5, 0.9]);
        let sites = [
            Site {
                latent: &first,
                reference: [0.4, 0.1],
            },
            Site {
                latent: &second,
                reference: [-0.7, 0.6],
            },
        ];
        let matrix = normal_matrix(&network, &weights, &sites);
        let (size, step) = (network.parameters().len(), 1e-5);
        let mut columns = Vec::new();
        for k in 0..size {
            let kept = network.parameters()[k];
            let mut at = |value: f64| -> Vec<f64> {
                network.parameters_mut()[k] = value;
                sites
                    .iter()
                    .flat_map(|site| residuals(&network, &weights, site))
                    .collect()
            };
            let (above, below) = (at(kept + step), at(kept - step));
            at(kept);
            columns.push(
                above
                    .iter()
                    .zip(&below)
                    .map(|(a, b)| 0.5 * (a - b) / step)
                    .collect::<Vec<f64>>(),
            );
        }
        for i in 0..size {
            for j in 0..size {
                let expected: f64 = columns[i].iter().zip(&columns[j]).map(|(a, b)| a * b).sum();
                let found = matrix[i * size + j];
                assert!((found - expected).abs() < 1e-8, "{i} {j}: {found} {expected}");
            }
        }
    }
}
