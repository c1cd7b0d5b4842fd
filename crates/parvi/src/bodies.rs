//! A target in several pieces: a body for each, of as many particles as its mass asks for.

use std::ops::ControlFlow;

use crate::survey::Site;
use crate::{Observer, Progress, Samples, TracePoint};

/// Particles for each site by the largest remainder of M times its mass; sites with fewer than two are left out.
pub(crate) fn apportion<const D: usize>(particles: usize, sites: &[Site<D>]) -> Vec<(Site<D>, usize)> {
    let mut sites = sites.to_vec();
    sites.sort_by(|a, b| b.mass.total_cmp(&a.mass));
    loop {
        let total: f64 = sites.iter().map(|site| site.mass).sum();
        let quotas: Vec<f64> = sites.iter().map(|site| particles as f64 * site.mass / total).collect();
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

/// All particles together. Energies and the square of the residual are means over the bodies, weighted by their particles.
pub(crate) fn union<const D: usize>(mut parts: Vec<Samples<D>>) -> Samples<D> {
    let bodies = parts.len();
    if bodies == 1
        && let Some(only) = parts.pop()
    {
        return only;
    }
    let total: usize = parts.iter().map(|part| part.positions.len()).sum();
    let share = |part: &Samples<D>| part.positions.len() as f64 / total as f64;
    let mean = |of: &dyn Fn(&Samples<D>) -> Option<f64>| -> Option<f64> {
        parts.iter().map(|part| of(part).map(|value| share(part) * value)).sum()
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
        weights: None,
        divergences: None,
        steps: parts.iter().map(|part| part.steps).max().unwrap_or(0),
        score_evaluations: parts.iter().map(|part| part.score_evaluations).sum(),
        residual: root_mean_square(&|part| part.residual),
        spacing: parts.first().and_then(|part| part.spacing),
        active_nodes: parts.iter().map(|part| part.active_nodes).sum(),
        bodies: Some(bodies),
        storage_bytes: parts.iter().map(|part| part.storage_bytes).max().flatten(),
        trace,
        positions: parts.into_iter().flat_map(|part| part.positions).collect(),
    }
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
            let shared = apportion(particles, &sites(&[0.2, 0.5, 0.3]));
            let counts: Vec<usize> = shared.iter().map(|(_, count)| *count).collect();
            assert_eq!(counts.iter().sum::<usize>(), particles, "{counts:?}");
            assert!(counts.iter().all(|&count| count >= 2), "{counts:?}");
            if particles >= 7 {
                for (site, count) in shared {
                    assert!((count as f64 - particles as f64 * site.mass).abs() < 1.0);
                }
            }
        }
    }
}
