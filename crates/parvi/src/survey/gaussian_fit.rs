//! The Gaussian nearest to the target, by Stein–Newton steps on a few quadrature points.

use mpm_tensor::{Matrix, SymmetricEigen, vector};

use super::density::{Density, Valued};
use crate::SampleError;
use crate::start::quasi_random_normal;

/// A Gaussian N(mean, root rootᵀ).
#[derive(Clone, Copy, Debug)]
pub(super) struct GaussianFit<const D: usize> {
    pub mean: [f64; D],
    /// A square root of the covariance, of any shape.
    pub root: Matrix<D>,
}

/// Steps at most.
const STEPS: usize = 40;

/// A step stretches a standard deviation by no more than this.
const STRETCH: f64 = 4.0;

/// The search ends after a step shorter than this, in standard deviations.
const REST: f64 = 0.02;

/// The minimum of KL(N(m, L Lᵀ) ‖ p) over m and L, the expectation taken over the points m + L u, u in `nodes`.
///
/// With the scores pulled back by L, g = E\[s\] and Q = −sym E\[s uᵀ\], the optimum has g = 0 and Q = I, Stein's identities
/// (docs/theory.md, (12)). A step m ← m + L Q⁻¹ g, L ← L Q^{−½} is Newton's; Q's eigenvalues are kept above 1/[`STRETCH`]², and
/// the step is shortened until the objective −E log p − log det L falls. `nodes` have mean zero and covariance I.
pub(super) fn fit<const D: usize>(
    density: &mut Density<'_, D>,
    mut mean: [f64; D],
    mut root: Matrix<D>,
    nodes: &[[f64; D]],
) -> Option<GaussianFit<D>> {
    let mut here = evaluate(density, &mean, &root, nodes)?;
    for _ in 0..STEPS {
        let (gradient, curvature) = stein(&here, &root, nodes);
        let eigen = SymmetricEigen::new(&curvature)?;
        let kept = |q: f64| q.max(1.0 / (STRETCH * STRETCH));
        let shift = eigen.map(|q| kept(q).recip()).apply(&gradient);
        let size =
            vector::norm(&shift).max((eigen.map(|q| kept(q).sqrt().recip()) - Matrix::IDENTITY).frobenius_norm());
        let before = objective(&here, 0.0);
        let next = (0..30).map(|k| 0.5_f64.powi(k)).find_map(|fraction| {
            let stretch = eigen.map(|q| kept(q).powf(-0.5 * fraction));
            let log_stretch: f64 = (-0.5 * fraction) * eigen.values.iter().map(|&q| kept(q).ln()).sum::<f64>();
            let trial_mean = vector::add_scaled(&mean, fraction, &root.apply(&shift));
            let trial_root = root * stretch;
            let there = evaluate(density, &trial_mean, &trial_root, nodes)?;
            let rounding = 1e-12 * before.abs();
            (objective(&there, log_stretch) <= before + rounding).then_some((trial_mean, trial_root, there))
        });
        let Some((next_mean, next_root, there)) = next else {
            break;
        };
        (mean, root, here) = (next_mean, next_root, there);
        if size < REST {
            return Some(GaussianFit { mean, root });
        }
    }
    Some(GaussianFit { mean, root })
}

fn evaluate<const D: usize>(
    density: &mut Density<'_, D>,
    mean: &[f64; D],
    root: &Matrix<D>,
    nodes: &[[f64; D]],
) -> Option<Vec<Valued<D>>> {
    let points: Vec<[f64; D]> = nodes.iter().map(|u| vector::add(mean, &root.apply(u))).collect();
    density.values(&points)
}

/// E\[s\] and −sym E\[s uᵀ\] of the scores pulled back by the root.
fn stein<const D: usize>(values: &[Valued<D>], root: &Matrix<D>, nodes: &[[f64; D]]) -> ([f64; D], Matrix<D>) {
    let share = 1.0 / nodes.len() as f64;
    let (mut gradient, mut product) = ([0.0; D], Matrix::<D>::ZERO);
    for (value, u) in values.iter().zip(nodes) {
        let score = root.apply_transposed(&value.score);
        vector::accumulate(&mut gradient, share, &score);
        product -= Matrix::outer(&score, u) * share;
    }
    (gradient, product.symmetric_part())
}

/// −E log p − log det L, up to the constant log det of the root before the stretch.
fn objective<const D: usize>(values: &[Valued<D>], log_stretch: f64) -> f64 {
    -values.iter().map(|value| value.log_density).sum::<f64>() / values.len() as f64 - log_stretch
}

/// The nodes of the fit.
pub(super) fn quadrature_nodes<const D: usize>(seed: u64) -> Result<Vec<[f64; D]>, SampleError> {
    balanced_nodes((2 * D).max(8), seed.wrapping_add(2))
}

/// `count` pairs of points ±u with mean zero and covariance I.
pub(super) fn balanced_nodes<const D: usize>(count: usize, seed: u64) -> Result<Vec<[f64; D]>, SampleError> {
    let mut nodes: Vec<[f64; D]> = quasi_random_normal(count, seed)?;
    nodes.extend_from_within(..);
    for u in &mut nodes[count..] {
        *u = u.map(|c| -c);
    }
    let share = 1.0 / nodes.len() as f64;
    let covariance = nodes
        .iter()
        .fold(Matrix::<D>::ZERO, |sum, u| sum + Matrix::outer(u, u) * share);
    if let Some(eigen) = SymmetricEigen::new(&covariance) {
        let whiten = eigen.map(|value| value.max(1e-9).sqrt().recip());
        for u in &mut nodes {
            *u = whiten.apply(u);
        }
    }
    Ok(nodes)
}

#[cfg(test)]
mod tests {
    use parvi_targets::{Frame, Gaussian, StudentT};

    use super::*;

    #[test]
    fn a_gaussian_is_fitted_exactly_from_afar_and_in_any_units() {
        let covariance = Matrix([[1e4, 30.0, 0.0], [30.0, 1.0, 5e-4], [0.0, 5e-4, 1e-6]]);
        let target = Gaussian::new([50.0, -2.0, 0.3], covariance).unwrap();
        let frame = Frame::identity();
        let nodes = quadrature_nodes::<3>(1).unwrap();
        let mut density = Density::new(&target, &frame);
        let found = fit(&mut density, [0.0; 3], Matrix::IDENTITY, &nodes).unwrap();
        let fitted = found.root * found.root.transpose();
        for i in 0..3 {
            assert!((found.mean[i] - [50.0, -2.0, 0.3][i]).abs() < 0.01 * covariance.0[i][i].sqrt());
            for j in 0..3 {
                let scale = (covariance.0[i][i] * covariance.0[j][j]).sqrt();
                assert!((fitted.0[i][j] - covariance.0[i][j]).abs() < 0.01 * scale, "{fitted:?}");
            }
        }
    }

    #[test]
    fn heavy_tails_are_reached_from_far_out() {
        let target = StudentT::<2>::new(3.0).unwrap();
        let frame = Frame::identity();
        let nodes = quadrature_nodes::<2>(1).unwrap();
        let found = fit(
            &mut Density::new(&target, &frame),
            [30.0, 10.0],
            Matrix::IDENTITY,
            &nodes,
        )
        .unwrap();
        assert!(vector::norm(&found.mean) < 0.2, "{found:?}");
    }
}
