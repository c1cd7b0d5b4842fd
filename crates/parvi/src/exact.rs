//! Exact draws and scrambled Sobol points: the yardsticks.

use parvi_targets::CatalogueTarget;

use crate::start::check;
use crate::{Run, SampleError, Samples};

/// Independent exact draws.
///
/// # Errors
/// [`SampleError::Unsupported`] for a target without exact draws.
pub fn independent_draws<const D: usize>(
    target: &dyn CatalogueTarget<D>,
    run: &Run,
) -> Result<Samples<D>, SampleError> {
    check("particles", run.particles as f64, run.particles >= 2, "at least 2")?;
    let draws = target.exact_draws().ok_or_else(|| SampleError::Unsupported {
        method: "iid",
        target: target.name().to_string(),
        needs: "exact draws",
    })?;
    let mut generator = run.generator(0);
    let positions = (0..run.particles).map(|_| draws.draw(&mut generator)).collect();
    Ok(without_steps(positions))
}

fn without_steps<const D: usize>(positions: Vec<[f64; D]>) -> Samples<D> {
    Samples {
        positions,
        weights: None,
        steps: 0,
        score_evaluations: 0,
        residual: None,
        spacing: None,
        active_nodes: None,
        storage_bytes: None,
        trace: Vec::new(),
    }
}
