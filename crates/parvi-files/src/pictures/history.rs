//! A cloud in the plane as a run saw it, at moments that are spread over all of its steps.

use std::ops::ControlFlow;

use parvi::{Observer, ParticleView};
use parvi_plot::moments;

/// Moments kept, at most; beyond, every second one is dropped.
const MOST: usize = 128;
/// Particles kept of a moment, at most.
const PARTICLES: usize = 4_000;

/// The particles after some steps.
#[derive(Clone, Debug, PartialEq)]
pub struct Moment {
    /// Steps of the run.
    pub step: usize,
    /// Where the particles are.
    pub points: Vec<Vec<f64>>,
}

/// Keeps moments of a run in two dimensions; of others it looks at no particle.
#[derive(Clone, Debug)]
pub struct History {
    moments: Vec<Moment>,
    every: usize,
    /// Bodies that moved one after the other, in any dimension.
    pub rounds: usize,
}

impl Default for History {
    fn default() -> Self {
        Self {
            moments: Vec::new(),
            every: 1,
            rounds: 0,
        }
    }
}

impl History {
    /// So many moments from the first step to the last one, closer together at the beginning.
    pub fn selected(&self, count: usize) -> Vec<&Moment> {
        let steps: Vec<usize> = self.moments.iter().map(|moment| moment.step).collect();
        let places = moments(&steps, count).into_iter();
        places.map(|place| &self.moments[place]).collect()
    }
}

impl Observer for History {
    fn see(&mut self, view: &ParticleView<'_>) -> ControlFlow<()> {
        let step = view.earlier_steps + view.step;
        self.rounds = self.rounds.max(view.body + 1);
        if view.dimension() != 2 || (view.body > 0 && view.step == 0) {
            return ControlFlow::Continue(());
        }
        self.moments.retain(|moment| moment.step < step);
        if step.is_multiple_of(self.every) {
            let positions = view.positions();
            let stride = view.particles().div_ceil(PARTICLES).max(1);
            let points = positions.chunks_exact(2).step_by(stride).map(<[f64]>::to_vec).collect();
            self.moments.push(Moment { step, points });
            if self.moments.len() > MOST {
                self.every *= 2;
                let every = self.every;
                self.moments.retain(|moment| moment.step.is_multiple_of(every));
            }
        }
        ControlFlow::Continue(())
    }
}
