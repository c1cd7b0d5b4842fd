//! Exact draws and scrambled Sobol points: the yardsticks.

use parvi_targets::{CatalogueTarget, SobolSequence};

use crate::drive::finite;
use crate::{Run, SampleError, Samples};

/// Independent exact draws.
///
/// # Errors
/// [`SampleError::Unsupported`] for a target without exact draws; [`SampleError::InvalidOption`] for fewer than two.
pub fn independent_draws<const D: usize>(
    target: &dyn CatalogueTarget<D>,
    run: &Run,
) -> Result<Samples<D>, SampleError> {
    let count = run.checked_particles()?;
    let draws = target
        .exact_draws()
        .ok_or_else(|| unsupported("iid", target.name(), "exact draws"))?;
    let mut generator = run.generator(0);
    of(std::iter::repeat_with(|| draws.draw(&mut generator))
        .take(count)
        .collect())
}

/// The first M points of a scrambled Sobol sequence through the target's map from the unit cube.
///
/// # Errors
/// [`SampleError::Unsupported`] for a target without such a map; [`SampleError::InvalidOption`] for fewer than two points.
pub fn sobol_points<const D: usize>(target: &dyn CatalogueTarget<D>, run: &Run) -> Result<Samples<D>, SampleError> {
    let count = run.checked_particles()?;
    let lacking = || unsupported("sobol", target.name(), "a map from the unit cube");
    let transport = target.unit_cube_transport().ok_or_else(lacking)?;
    let sequence = SobolSequence::scrambled(transport.cube_dimension(), run.seed).map_err(|_| lacking())?;
    let mut u = vec![0.0; transport.cube_dimension()];
    let point = |index| {
        sequence.write(index, &mut u);
        transport.transport(&u)
    };
    of((0..count as u32).map(point).collect())
}

fn unsupported(method: &'static str, target: &str, needs: &'static str) -> SampleError {
    SampleError::Unsupported {
        method,
        target: target.to_string(),
        needs,
    }
}

fn of<const D: usize>(positions: Vec<[f64; D]>) -> Result<Samples<D>, SampleError> {
    Ok(Samples {
        positions: finite(positions, 0)?,
        ..Samples::default()
    })
}
