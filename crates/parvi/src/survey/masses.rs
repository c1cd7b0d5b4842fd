//! The masses of separated modes, by importance sampling from Gaussians fitted to each.

use mpm_tensor::{Matrix, SymmetricEigen, vector};

use super::density::Density;
use super::gaussian_fit::GaussianFit;

/// The proposals' standard deviations over those of the fits.
const INFLATION: f64 = 1.25;

/// What the importance sample says.
pub(super) struct Masses<const D: usize> {
    /// The mass of each piece; they sum to one.
    pub values: Vec<f64>,
    /// Their standard errors, as if the points were independent: (Σ_p ω_p² (1\[p nearest to k\] − mass_k)²)^½ with ω_p the normalised weights.
    pub errors: Vec<f64>,
    /// Mean and covariance of all pieces together.
    pub whole: GaussianFit<D>,
}

/// The mass of the part of the target that is nearest to each of the fits (in its own metric).
///
/// Points x = m_k + 1.25 L_k u of every fit k, u in `nodes`, with weights p(x) / Σ_k q_k(x) (the balance heuristic: E. Veach,
/// L. J. Guibas, SIGGRAPH 1995, Eq. 15).
pub(super) fn masses<const D: usize>(
    density: &mut Density<'_, D>,
    fits: &[GaussianFit<D>],
    nodes: &[[f64; D]],
) -> Option<Masses<D>> {
    let proposals: Vec<Proposal<D>> = fits.iter().map(Proposal::new).collect::<Option<_>>()?;
    let mut points = Vec::with_capacity(fits.len() * nodes.len());
    for fit in fits {
        for u in nodes {
            let z = vector::add_scaled(&fit.mean, INFLATION, &fit.root.apply(u));
            let logs: Vec<f64> = proposals.iter().map(|proposal| proposal.log_density(&z)).collect();
            let largest = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let mixture = largest + logs.iter().map(|l| (l - largest).exp()).sum::<f64>().ln();
            let nearest = (0..logs.len()).max_by(|&a, &b| logs[a].total_cmp(&logs[b]))?;
            points.push((nearest, density.log_density(&z) - mixture, z));
        }
    }
    let largest = points.iter().map(|&(_, log, _)| log).fold(f64::NEG_INFINITY, f64::max);
    let mut values = vec![0.0; fits.len()];
    let mut total = 0.0;
    let mut mean = [0.0; D];
    for (nearest, log, z) in &points {
        let weight = (log - largest).exp();
        values[*nearest] += weight;
        total += weight;
        vector::accumulate(&mut mean, weight, z);
    }
    if !(total > 0.0 && total.is_finite()) {
        return None;
    }
    for value in &mut values {
        *value /= total;
    }
    let mut errors = vec![0.0; fits.len()];
    for (nearest, log, _) in &points {
        let weight = (log - largest).exp() / total;
        for (k, error) in errors.iter_mut().enumerate() {
            let inside = if k == *nearest { 1.0 } else { 0.0 };
            *error += (weight * (inside - values[k])).powi(2);
        }
    }
    let mean = vector::scale(&mean, 1.0 / total);
    let covariance = points.iter().fold(Matrix::<D>::ZERO, |sum, (_, log, z)| {
        let z = vector::subtract(z, &mean);
        sum + Matrix::outer(&z, &z) * ((log - largest).exp() / total)
    });
    let root = SymmetricEigen::new(&covariance)?.map(|value| value.max(0.0).sqrt());
    Some(Masses {
        values,
        errors: errors.into_iter().map(f64::sqrt).collect(),
        whole: GaussianFit { mean, root },
    })
}

struct Proposal<const D: usize> {
    mean: [f64; D],
    inverse_root: Matrix<D>,
    log_normalisation: f64,
}

impl<const D: usize> Proposal<D> {
    fn new(fit: &GaussianFit<D>) -> Option<Self> {
        let root = fit.root * INFLATION;
        let inverse_root = root.inverse()?;
        Some(Self {
            mean: fit.mean,
            inverse_root,
            log_normalisation: root.determinant().abs().ln(),
        })
    }

    /// Up to the constant −½ D log 2π.
    fn log_density(&self, z: &[f64; D]) -> f64 {
        let u = self.inverse_root.apply(&vector::subtract(z, &self.mean));
        -0.5 * vector::norm_squared(&u) - self.log_normalisation
    }
}

#[cfg(test)]
mod tests {
    use parvi_targets::{CatalogueTarget, Frame, GaussianMixture};

    use super::*;
    use crate::start::quasi_random_normal;

    #[test]
    fn fits_that_are_off_still_give_the_masses() {
        let mixture = GaussianMixture::<3>::three_far().unwrap();
        let frame = Frame::identity();
        let fits: Vec<GaussianFit<3>> = mixture
            .modes()
            .iter()
            .map(|mode| GaussianFit {
                mean: mode.centre.map(|c| c + 0.2 * mode.width),
                root: Matrix::IDENTITY * (0.9 * mode.width),
            })
            .collect();
        let nodes = quasi_random_normal::<3>(512, 7).unwrap();
        let found = masses(&mut Density::new(&mixture, &frame), &fits, &nodes).unwrap();
        for (mass, mode) in found.values.iter().zip(mixture.modes()) {
            assert!((mass - mode.mass).abs() < 0.005, "{:?}", found.values);
        }
        let variance = (found.whole.root * found.whole.root.transpose()).0[0][0];
        assert!((variance / mixture.moments().unwrap().covariance.0[0][0] - 1.0).abs() < 0.01);
    }
}
