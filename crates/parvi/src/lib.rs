#![doc = include_str!("../README.md")]

mod basis_choice;
mod bodies;
pub mod defaults;
mod drive;
mod exact;
mod framed_score;
mod kronecker;
mod method;
mod moment_correction;
mod mpm;
mod paper;
mod residual;
mod rotation;
mod run;
mod start;
mod stiffness;
mod survey;
mod svgd;

pub use exact::{independent_draws, sobol_points};
pub use method::*;
pub use residual::{Residual, galerkin_stein_residual};
pub use run::*;

use parvi_targets::CatalogueTarget;

/// Sample a catalogue target with any method, in the target's own frame.
///
/// # Errors
/// [`SampleError`].
pub fn sample<const D: usize>(
    target: &dyn CatalogueTarget<D>,
    method: &Method,
    run: &Run,
    observer: &mut dyn Observer,
) -> Result<Samples<D>, SampleError> {
    let frame = target.frame();
    match method {
        Method::Mpm(options) => options.sample(target, &frame, run, observer),
        Method::Paper(options) => options.sample(target, &frame, run, observer),
        Method::Svgd(options) => options.sample(target, &frame, run, observer),
        Method::Iid => independent_draws(target, run),
        Method::Sobol => sobol_points(target, run),
    }
}

/// Runs the code of the workspace's README as a doc test.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct WorkspaceReadme;
