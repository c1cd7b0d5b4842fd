//! The masses of separated modes, by importance sampling from Gaussians fitted to each.

use mpm_tensor::{Matrix, SymmetricEigen, vector};

use super::density::Density;
use super::gaussian_fit::GaussianFit;

/// The proposals' standard deviations over those of the fits.
const INFLATION: f64 = 1.25;

/// Times that masses and shares are made consistent.
const ITERATIONS: usize = 10;

/// What the importance sample says.
pub(super) struct Masses<const D: usize> {
    /// The mass of each piece; they sum to one.
    pub values: Vec<f64>,
    /// Their standard errors, as if the points were independent: (Σ_p ω_p² (r_k(x_p) − mass_k)²)^½ with ω_p the normalised weights.
    pub errors: Vec<f64>,
    /// Mean and covariance of all pieces together.
    pub whole: GaussianFit<D>,
}

/// The masses of the pieces p r_k of the target, where r_k ∝ mass_k N_k is the share of the fit N_k in the mixture of all fits.
///
/// Points x = m_k + 1.25 L_k u of every fit k, u in `nodes`, with weights p(x) / Σ_k q_k(x) (the balance heuristic: E. Veach,
/// L. J. Guibas, SIGGRAPH 1995, Eq. 15), q_k the density of its points. Masses and shares depend on each other and are iterated, as in the EM algorithm: for a mixture of the
/// fits themselves they are exact.
pub(super) fn masses<const D: usize>(
    density: &mut Density<'_, D>,
    fits: &[GaussianFit<D>],
    nodes: &[[f64; D]],
) -> Option<Masses<D>> {
    let proposals: Vec<Proposal<D>> = fits
        .iter()
        .map(|fit| Proposal::new(fit, INFLATION))
        .collect::<Option<_>>()?;
    let members: Vec<Proposal<D>> = fits.iter().map(|fit| Proposal::new(fit, 1.0)).collect::<Option<_>>()?;
    let mut points = Vec::with_capacity(fits.len() * nodes.len());
    for fit in fits {
        for u in nodes {
            let z = vector::add_scaled(&fit.mean, INFLATION, &fit.root.apply(u));
            let logs: Vec<f64> = proposals.iter().map(|proposal| proposal.log_density(&z)).collect();
            points.push((density.log_density(&z) - log_sum(&logs), z));
        }
    }
    let largest = points.iter().map(|&(log, _)| log).fold(f64::NEG_INFINITY, f64::max);
    let total: f64 = points.iter().map(|(log, _)| (log - largest).exp()).sum();
    if !(total > 0.0 && total.is_finite()) {
        return None;
    }
    let weighted: Vec<(f64, [f64; D])> = points
        .into_iter()
        .map(|(log, z)| ((log - largest).exp() / total, z))
        .collect();
    let mut values = vec![1.0 / fits.len() as f64; fits.len()];
    let mut errors = vec![0.0; fits.len()];
    for _ in 0..ITERATIONS {
        let shares: Vec<Vec<f64>> = weighted.iter().map(|(_, z)| shares_at(z, &members, &values)).collect();
        for (k, (value, error)) in values.iter_mut().zip(&mut errors).enumerate() {
            let pairs = || {
                weighted
                    .iter()
                    .zip(&shares)
                    .map(move |((weight, _), share)| (weight, share[k]))
            };
            *value = pairs().map(|(weight, share)| weight * share).sum();
            let square: f64 = pairs().map(|(weight, share)| (weight * (share - *value)).powi(2)).sum();
            *error = square.sqrt();
        }
    }
    let mut mean = [0.0; D];
    for (weight, z) in &weighted {
        vector::accumulate(&mut mean, *weight, z);
    }
    let covariance = weighted.iter().fold(Matrix::<D>::ZERO, |sum, (weight, z)| {
        let z = vector::subtract(z, &mean);
        sum + Matrix::outer(&z, &z) * *weight
    });
    let root = SymmetricEigen::new(&covariance)?.map(|value| value.max(0.0).sqrt());
    Some(Masses {
        values,
        errors,
        whole: GaussianFit { mean, root },
    })
}

/// mass_k N_k(z) / Σ_j mass_j N_j(z) for all k.
fn shares_at<const D: usize>(z: &[f64; D], members: &[Proposal<D>], masses: &[f64]) -> Vec<f64> {
    let members = members.iter().zip(masses);
    let logs: Vec<f64> = members
        .map(|(member, mass)| mass.ln() + member.log_density(z))
        .collect();
    let sum = log_sum(&logs);
    logs.into_iter().map(|log| (log - sum).exp()).collect()
}

/// log Σ exp of numbers, of which one at least is above −∞.
fn log_sum(logs: &[f64]) -> f64 {
    let largest = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    largest + logs.iter().map(|log| (log - largest).exp()).sum::<f64>().ln()
}

struct Proposal<const D: usize> {
    mean: [f64; D],
    inverse_root: Matrix<D>,
    log_normalisation: f64,
}

impl<const D: usize> Proposal<D> {
    /// The fit, wider by a factor.
    fn new(fit: &GaussianFit<D>, inflation: f64) -> Option<Self> {
        let root = fit.root * inflation;
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
