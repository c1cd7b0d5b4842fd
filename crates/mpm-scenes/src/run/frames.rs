//! A run that only hands out its frames.

use std::time::{Duration, Instant};

use super::body::Body;
use super::{SimulationError, snapshot};
use crate::{Scene, SceneFault, Snapshot};

/// What a run in memory took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Effort {
    /// Steps.
    pub steps: u64,
    /// Wall time of the steps, without beginning, frames and visits.
    pub time: Duration,
}

/// Runs a scene in memory: `visit` gets all frames, that of t = 0 first, and nothing is written. The particles go through the
/// same states as in [`simulate`](super::simulate) where rows and checkpoints are written with the frames.
///
/// # Errors
/// [`SimulationError`], as in [`simulate`](super::simulate), but for files.
pub fn frames(scene: &Scene, visit: &mut dyn FnMut(Snapshot)) -> Result<Effort, SimulationError> {
    match scene.dimension {
        1 => frames_in::<1>(scene, visit),
        2 => frames_in::<2>(scene, visit),
        3 => frames_in::<3>(scene, visit),
        other => Err(scene.error(SceneFault::value("dimension", other, "1, 2 or 3")).into()),
    }
}

fn frames_in<const D: usize>(scene: &Scene, visit: &mut dyn FnMut(Snapshot)) -> Result<Effort, SimulationError> {
    let mut body = Body::<D>::begin(scene)?;
    visit(snapshot::snapshot(&*body.motion, &body.start));
    let mut time = Duration::ZERO;
    while body.motion.time() < scene.time.end {
        let start = Instant::now();
        body.advance()?;
        time += start.elapsed();
        if body.frames.at(body.motion.time()).is_some() {
            visit(snapshot::snapshot(&*body.motion, &body.start));
        }
    }
    Ok(Effort { steps: body.step, time })
}
