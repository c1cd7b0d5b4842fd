//! A cloud in the plane as a run saw it, at moments that are spread over all of its steps.

use std::ops::ControlFlow;

use parvi::{Observer, ParticleView, Progress};

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
    /// Bodies seen, in any dimension.
    rounds: usize,
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
    /// Bodies that moved one after the other.
    pub fn rounds(&self) -> usize {
        self.rounds
    }

    /// So many moments from the first step to the last one, closer together at the beginning, where most happens: nearest to s + (N − s) (k / n)², k = 0 … n − 1; all, if there are not more.
    pub fn selected(&self, count: usize) -> Vec<&Moment> {
        let (Some(first), Some(last)) = (self.moments.first(), self.moments.last()) else {
            return Vec::new();
        };
        if self.moments.len() <= count {
            return self.moments.iter().collect();
        }
        let (first, last) = (first.step as f64, last.step as f64);
        let mut from = 0;
        let mut chosen = Vec::with_capacity(count);
        for k in 0..count {
            let goal = first + (last - first) * (k as f64 / count as f64).powi(2);
            // Later ones need a moment each.
            let until = self.moments.len() - (count - 1 - k);
            let nearest = (from..until).min_by(|&a, &b| {
                let away = |index: usize| (self.moments[index].step as f64 - goal).abs();
                away(a).total_cmp(&away(b))
            });
            let Some(index) = nearest else { break };
            chosen.push(&self.moments[index]);
            from = index + 1;
        }
        chosen
    }
}

impl Observer for History {
    fn after_step(&mut self, _: Progress) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

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

#[cfg(test)]
mod tests {
    use super::*;

    fn of_steps(steps: impl Iterator<Item = usize>) -> History {
        let moments = steps.map(|step| Moment {
            step,
            points: Vec::new(),
        });
        History {
            moments: moments.collect(),
            ..History::default()
        }
    }

    fn steps(history: &History) -> Vec<usize> {
        history.selected(5).iter().map(|moment| moment.step).collect()
    }

    #[test]
    fn selected_moments_are_different_and_in_order() {
        assert_eq!(steps(&of_steps(0..101)), [0, 4, 16, 36, 64]);
        assert_eq!(steps(&of_steps(0..6)), [0, 1, 2, 3, 4]);
        assert_eq!(steps(&of_steps(3..6)), [3, 4, 5]);
        assert_eq!(steps(&of_steps(0..0)), [0; 0]);
    }
}
