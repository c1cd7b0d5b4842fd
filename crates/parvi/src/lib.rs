//! placeholder

mod method;
mod run;

pub use method::*;
pub use run::*;

use parvi_targets::CatalogueTarget;

/// Sample a catalogue target with any method, in the target's own frame.
pub fn sample<const D: usize>(
    target: &(dyn CatalogueTarget<D> + Sync),
    method: &Method,
    run: &Run,
    observer: &mut dyn Observer,
) -> Result<Samples<D>, SampleError> {
    let _ = (method, run, observer);
    Err(SampleError::Unsupported { method: "any", target: target.name().to_string(), needs: "an implementation" })
}
