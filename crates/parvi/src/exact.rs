//! Exact draws and scrambled Sobol points: the yardsticks.

use parvi_targets::{CatalogueTarget, SobolSequence};
use rand::rngs::ChaCha8Rng;

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
    let count = run.particles_of("iid")?;
    Ok(Samples {
        positions: exact_draws("iid", target, &mut run.generator(0), count)?,
        ..Samples::default()
    })
}

/// `count` exact draws for a method that needs them, all finite.
pub(crate) fn exact_draws<const D: usize>(
    method: &'static str,
    target: &dyn CatalogueTarget<D>,
    generator: &mut ChaCha8Rng,
    count: usize,
) -> Result<Vec<[f64; D]>, SampleError> {
    let draws = target
        .exact_draws()
        .ok_or_else(|| unsupported(method, target.name(), "exact draws"))?;
    finite(
        std::iter::repeat_with(|| draws.draw(generator)).take(count).collect(),
        0,
    )
}

/// The first M points of a scrambled Sobol sequence through the target's map from the unit cube.
///
/// # Errors
/// [`SampleError::Unsupported`] for a target without such a map; [`SampleError::InvalidOption`] for fewer than two points.
pub fn sobol_points<const D: usize>(target: &dyn CatalogueTarget<D>, run: &Run) -> Result<Samples<D>, SampleError> {
    let count = run.particles_of("sobol")?;
    let lacking = || unsupported("sobol", target.name(), "a map from the unit cube");
    let transport = target.unit_cube_transport().ok_or_else(lacking)?;
    let sequence = SobolSequence::scrambled(transport.cube_dimension(), run.seed).map_err(|_| lacking())?;
    let mut u = vec![0.0; transport.cube_dimension()];
    let point = |index| {
        sequence.write(index, &mut u);
        transport.transport(&u)
    };
    Ok(Samples {
        positions: finite((0..count as u32).map(point).collect(), 0)?,
        ..Samples::default()
    })
}

fn unsupported(method: &'static str, target: &str, needs: &'static str) -> SampleError {
    SampleError::Unsupported {
        method,
        target: target.to_string(),
        needs,
    }
}
