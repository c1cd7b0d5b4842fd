//! Exchanges of sample points that make training runs better.

use std::collections::HashSet;

use super::ExperimentError;
use super::chosen::Best;
use super::sampling::Sampling;
use super::trials::Trials;
use crate::online::ReducedBody;

impl<const D: usize> Sampling<'_, D> {
    /// Tries `exchanges` of `[run]` on training runs, the most promising first ([`rank_exchanges`](crate::online::rank_exchanges)), each once, and keeps those that lower the error of these runs together.
    /// Points are chosen by the errors of steps from states of the training; runs go to states of their own, and what is nearly as good for a step may be much better for a run.
    pub(super) fn exchange(&self, best: &mut Best<D>, trials: &mut Trials) -> Result<(), ExperimentError> {
        let (most, r) = (self.experiment.run.exchanges, self.manifold.coordinates());
        if most == 0 {
            return Ok(());
        }
        let body = ReducedBody::of(&self.scene(trials.0[0])?)?;
        let (mut ranked, mut tried) = (best.ranked(r, &body)?, HashSet::new());
        for _ in 0..most {
            let Some(&(from, to)) = ranked.iter().find(|pair| !tried.contains(*pair)) else {
                break;
            };
            tried.insert((from, to));
            best.exchange((from, to));
            let error = self.error_of(best, best.error, trials)?;
            if error < best.error {
                best.error = error;
                tried.insert((to, from));
                ranked = best.ranked(r, &body)?;
            } else {
                best.restore();
            }
        }
        Ok(())
    }
}
