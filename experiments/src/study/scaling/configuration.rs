//! The configuration of the study `scaling`.

use serde::Deserialize;

use super::{Case, Sweep};
use crate::CommandError;
use crate::options::{Bounded, Dimension, MethodSpecification, ParticleCount, StepCount, TargetSpecification};

/// Sizes to measure.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Scaling {
    #[serde(rename = "kind")]
    _kind: String,
    /// Seed of every case.
    pub seed: u64,
    /// Threads; absent: as many as the environment gives.
    pub threads: Option<Bounded<1, 1024>>,
    /// A target of the catalogue that exists in every dimension of the sweeps.
    pub target: String,
    /// Steps of a run.
    pub steps: StepCount,
    /// Runs on the clock per case.
    pub repeats: Bounded<1, 1000>,
    /// The sampler.
    pub method: MethodSpecification,
    /// The sweep over d and M.
    pub particles_sweep: ParticlesSweep,
    /// The sweep over k.
    pub nodes_sweep: NodesSweep,
}

/// All pairs of d and M whose work M · 3ᵈ is within the budget.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct ParticlesSweep {
    /// d.
    pub dims: Vec<Dimension>,
    /// M.
    pub particles: Vec<ParticleCount>,
    /// The largest M · 3ᵈ, the number of particle–node pairs of a quadratic B-spline, that is run.
    pub largest_work: f64,
    /// Fits use the sizes from here on, so that the fixed cost of a step at small M does not bend them.
    pub fit_from: ParticleCount,
}

/// All pairs of d and k.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct NodesSweep {
    /// d.
    pub dims: Vec<Dimension>,
    /// M.
    pub particles: ParticleCount,
    /// k.
    pub nodes_per_axis: Vec<Bounded<2, 1_000_000>>,
    /// A second fit uses the k from here on.
    pub fit_from: Bounded<2, 1_000_000>,
    /// The interval per axis, in frame units, that k nodes divide: h = width / k.
    #[serde(rename = "box")]
    pub interval: [f64; 2],
}

impl Scaling {
    /// The cases of both sweeps, cheap ones first within each dimension.
    pub fn all_cases(&self) -> Result<Vec<Case>, CommandError> {
        let refuse = |field: &str, message: String| {
            Err(CommandError::ConfigField {
                file: String::new(),
                field: field.to_owned(),
                message,
            })
        };
        let [low, high] = self.nodes_sweep.interval;
        if !(low < high && (high - low).is_finite()) {
            return refuse("nodes-sweep.box", format!("[{low}, {high}] is no interval"));
        }
        let sweep = &self.particles_sweep;
        if sweep.largest_work.is_nan() || sweep.largest_work <= 0.0 {
            return refuse(
                "particles-sweep.largest-work",
                format!("{} must be above 0", sweep.largest_work),
            );
        }
        for &dim in sweep.dims.iter().chain(&self.nodes_sweep.dims) {
            TargetSpecification::plain(&self.target, Some(dim)).dimension()?;
        }
        let mut cases = Vec::new();
        for &dim in &sweep.dims {
            for &particles in &sweep.particles {
                let work = particles.get() as f64 * 3f64.powi(dim.get() as i32);
                if work <= sweep.largest_work {
                    let particles = particles.get();
                    cases.push(Case {
                        sweep: Sweep::Particles,
                        dim,
                        particles,
                        nodes_per_axis: None,
                        spacing: None,
                    });
                }
            }
        }
        for &dim in &self.nodes_sweep.dims {
            for &nodes in &self.nodes_sweep.nodes_per_axis {
                cases.push(Case {
                    sweep: Sweep::Nodes,
                    dim,
                    particles: self.nodes_sweep.particles.get(),
                    nodes_per_axis: Some(nodes.get()),
                    spacing: Some((high - low) / nodes.get() as f64),
                });
            }
        }
        Ok(cases)
    }
}
