//! placeholder

pub mod defaults;
mod drive;
mod exact;
mod framed_score;
mod kronecker;
mod method;
mod moment_correction;
mod mpm;
mod residual;
mod run;
mod start;

pub use exact::independent_draws;
pub use method::*;
pub use residual::{Residual, galerkin_stein_residual};
pub use run::*;

use parvi_targets::CatalogueTarget;

/// Sample a catalogue target with any method, in the target's own frame.
pub fn sample<const D: usize>(
    target: &(dyn CatalogueTarget<D> + Sync),
    method: &Method,
    run: &Run,
    observer: &mut dyn Observer,
) -> Result<Samples<D>, SampleError> {
    let frame = target.frame();
    match method {
        Method::Mpm(options) => options.sample(target, &frame, run, observer),
        Method::Iid => independent_draws(target, run),
        _ => Err(SampleError::Unsupported { method: "any", target: target.name().to_string(), needs: "an implementation" })
    }
}
