//! A target in several pieces: a body for each, of as many particles as its mass asks for, and what they are together.

use std::ops::ControlFlow;

use crate::certificate::{Certificate, Circumstances, Evidence};
use crate::drive::Driven;
use crate::extent::Extent;
use crate::survey::Site;
use crate::{Observer, Progress, Samples, TracePoint};

/// Particles for each site by the largest remainder of M times its mass, or `evenly` many for all; sites with fewer than two are left out.
pub(crate) fn apportion<const D: usize>(particles: usize, sites: &[Site<D>], evenly: bool) -> Vec<(Site<D>, usize)> {
    let mut sites = sites.to_vec();
    sites.sort_by(|a, b| b.mass.total_cmp(&a.mass));
    let claim = |site: &Site<D>| if evenly { 1.0 } else { site.mass };
    loop {
        let total: f64 = sites.iter().map(claim).sum();
        let quotas: Vec<f64> = sites
            .iter()
            .map(|site| particles as f64 * claim(site) / total)
            .collect();
        let mut counts: Vec<usize> = quotas.iter().map(|quota| *quota as usize).collect();
        let mut order: Vec<usize> = (0..sites.len()).collect();
        order.sort_by(|&a, &b| quotas[b].fract().total_cmp(&quotas[a].fract()));
        let left = particles.saturating_sub(counts.iter().sum());
        for &site in order.iter().cycle().take(left) {
            counts[site] += 1;
        }
        if sites.len() == 1 || counts.iter().all(|&count| count >= 2) {
            return sites.into_iter().zip(counts).collect();
        }
        sites.pop();
    }
}

/// All particles together. Energies and the square of the residual are means over the bodies, weighted by their shares.
fn union<const D: usize>(mut parts: Vec<Samples<D>>, shares: &[f64]) -> Samples<D> {
    let bodies = parts.len();
    if bodies == 1
        && let Some(only) = parts.pop()
    {
        return only;
    }
    let mean = |of: &dyn Fn(&Samples<D>) -> Option<f64>| -> Option<f64> {
        let parts = parts.iter().zip(shares);
        parts.map(|(part, share)| of(part).map(|value| share * value)).sum()
    };
    let root_mean_square =
        |of: &dyn Fn(&Samples<D>) -> Option<f64>| mean(&|part| of(part).map(|value| value * value)).map(f64::sqrt);
    let trace = (0..parts.iter().map(|part| part.trace.len()).min().unwrap_or(0))
        .map(|entry| TracePoint {
            step: parts[0].trace[entry].step,
            time: parts[0].trace[entry].time,
            residual: root_mean_square(&|part| part.trace[entry].residual),
            kinetic_energy: mean(&|part| Some(part.trace[entry].kinetic_energy)).unwrap_or(0.0),
            potential_energy: mean(&|part| part.trace[entry].potential_energy),
            displacement: parts
                .iter()
                .map(|part| part.trace[entry].displacement)
                .fold(0.0, f64::max),
        })
        .collect();
    Samples {
        steps: parts.iter().map(|part| part.steps).max().unwrap_or(0),
        score_evaluations: parts.iter().map(|part| part.score_evaluations).sum(),
        residual: root_mean_square(&|part| part.residual),
        spacing: parts.first().and_then(|part| part.spacing),
        active_nodes: parts.iter().map(|part| part.active_nodes).sum(),
        bodies: Some(bodies),
        storage_bytes: parts.iter().map(|part| part.storage_bytes).max().flatten(),
        trace,
        scores_replaced: parts.iter().map(|part| part.scores_replaced).sum(),
        positions: parts.into_iter().flat_map(|part| part.positions).collect(),
        ..Samples::default()
    }
}

/// What is known of a target besides its bodies.
pub(crate) struct Knowledge {
    /// The bodies' masses, where their particles are weighted; else a body weighs what its share of the particles is.
    pub masses: Option<Vec<f64>>,
    /// The standard errors of the masses.
    pub mass_errors: Vec<f64>,
    /// The mass of sites that are left out.
    pub mass_left_out: f64,
    /// The power of the target that the particles stand for.
    pub alpha: f64,
    /// Whether a certificate is asked for.
    pub certificate: bool,
    /// Whether it was searched for separate pieces.
    pub surveyed: bool,
}

/// The particles of all bodies, with weights and a certificate as far as they are asked for.
pub(crate) fn judged<const D: usize>(bodies: Vec<Driven<D>>, knowledge: &Knowledge) -> Samples<D> {
    let counts: Vec<usize> = bodies.iter().map(|body| body.positions.len()).collect();
    let particles: usize = counts.iter().sum();
    let shares: Vec<f64> = match &knowledge.masses {
        Some(masses) => masses.iter().map(|mass| mass / masses.iter().sum::<f64>()).collect(),
        None => counts.iter().map(|&count| count as f64 / particles as f64).collect(),
    };
    let certificate = knowledge.certificate.then(|| {
        let evidence: Vec<_> = bodies
            .iter()
            .zip(&shares)
            .map(|(body, &share)| {
                let seen = &body.samples.positions;
                Evidence::new(&body.positions, &body.scores, seen, share)
            })
            .collect();
        let mean = |of: &dyn Fn(&Driven<D>) -> f64| {
            bodies
                .iter()
                .zip(&shares)
                .map(|(body, share)| share * of(body))
                .sum::<f64>()
        };
        let circumstances = Circumstances {
            particles,
            residual: mean(&|body| body.samples.residual.map_or(0.0, |ratio| ratio * ratio)).sqrt(),
            drift: bodies.iter().map(|body| body.drift).fold(0.0, f64::max),
            kinetic_energy: mean(&|body| body.kinetic_energy),
            mass_error: error_from_masses(&bodies, &shares, &knowledge.mass_errors),
            mass_left_out: knowledge.mass_left_out,
            surveyed: knowledge.surveyed,
            alpha: knowledge.alpha,
        };
        Certificate::of(&evidence, circumstances)
    });
    let mut samples = union(bodies.into_iter().map(|body| body.samples).collect(), &shares);
    if knowledge.masses.is_some() && counts.len() > 1 {
        let each = counts.iter().zip(&shares);
        samples.weights = Some(
            each.flat_map(|(&count, share)| vec![share / count as f64; count])
                .collect(),
        );
    }
    samples.certificate = certificate;
    samples
}

/// The standard error that those of the masses bring into a mean, in standard deviations: the largest over the axes of
/// (Σ_k se_k² (m_k − m)²)^½ / σ; `None` for one body.
fn error_from_masses<const D: usize>(bodies: &[Driven<D>], shares: &[f64], mass_errors: &[f64]) -> Option<f64> {
    if bodies.len() < 2 {
        return None;
    }
    let extents: Vec<Extent<D>> = bodies.iter().map(|body| Extent::of(&body.samples.positions)).collect();
    let of_axis = |a: usize| {
        let mean: f64 = extents
            .iter()
            .zip(shares)
            .map(|(body, share)| share * body.mean[a])
            .sum();
        let (mut variance, mut square) = (0.0, 0.0);
        for ((body, share), error) in extents.iter().zip(shares).zip(mass_errors) {
            let offset = body.mean[a] - mean;
            variance += share * (body.deviation[a].powi(2) + offset * offset);
            square += (error * offset).powi(2);
        }
        (square / variance).sqrt()
    };
    Some((0..D).map(of_axis).fold(0.0, f64::max))
}

/// Reports the steps of one body among several.
pub(crate) struct InTurn<'a> {
    pub number: usize,
    pub of: usize,
    pub observer: &'a mut dyn Observer,
}

impl Observer for InTurn<'_> {
    fn after_step(&mut self, progress: Progress) -> ControlFlow<()> {
        self.observer.after_step(Progress {
            step: self.number * progress.steps + progress.step,
            steps: self.of * progress.steps,
        })
    }
}

#[cfg(test)]
mod tests {
    use parvi_targets::Frame;

    use super::*;

    fn sites(masses: &[f64]) -> Vec<Site<1>> {
        masses.iter().map(|&mass| Site::new(Frame::identity(), mass)).collect()
    }

    #[test]
    fn particles_follow_the_masses_to_the_last_one() {
        for particles in [2, 3, 7, 100, 1001] {
            let shared = apportion(particles, &sites(&[0.2, 0.5, 0.3]), false);
            let counts: Vec<usize> = shared.iter().map(|(_, count)| *count).collect();
            assert_eq!(counts.iter().sum::<usize>(), particles, "{counts:?}");
            assert!(counts.iter().all(|&count| count >= 2), "{counts:?}");
            if particles >= 7 {
                for (site, count) in shared {
                    assert!((count as f64 - particles as f64 * site.mass).abs() < 1.0);
                }
                let even = apportion(particles, &sites(&[0.2, 0.5, 0.3]), true);
                assert!(even.iter().all(|&(_, count)| (3 * count).abs_diff(particles) < 3));
            }
        }
    }
}
