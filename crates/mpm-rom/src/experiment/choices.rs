//! All combinations of what reduced runs are asked for.

use super::beside::Choice;
use super::{Experiment, ManifoldName, SampleCount};

/// The families of maps with the numbers of their networks.
pub(super) fn maps(experiment: &Experiment, networks: usize) -> Vec<(ManifoldName, usize)> {
    let names = experiment.run.manifold.iter();
    let each = names.flat_map(|&name| {
        let count = if name == ManifoldName::Network { networks } else { 1 };
        (0..count).map(move |network| (name, network))
    });
    each.collect()
}

/// All combinations of what is asked for.
pub(super) fn choices(experiment: &Experiment, networks: usize) -> Vec<Choice> {
    let (run, mut all) = (&experiment.run, Vec::new());
    for (manifold, network) in maps(experiment, networks) {
        for &samples in &run.samples {
            for &quadrature in &run.quadrature {
                for &update in &run.update {
                    for &step_factor in &run.step_factor {
                        // There is one way to take all points.
                        let ways = match samples {
                            SampleCount::All => &run.choice[..1],
                            SampleCount::Drawn(_) => &run.choice,
                        };
                        all.extend(ways.iter().map(|&chosen| Choice {
                            manifold,
                            network,
                            samples,
                            chosen,
                            quadrature,
                            update,
                            step_factor,
                        }));
                    }
                }
            }
        }
    }
    all
}
