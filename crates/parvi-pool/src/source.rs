//! Values of the target: those that an earlier process left, then evaluated ones, of which an observer is told.

use std::time::{Duration, Instant};

use parvi_targets::Target;

use crate::options::{PoolError, Round};
use crate::report::{Observer, Report};

/// How long an observer waits for news, unless a batch takes longer.
const SILENCE: Duration = Duration::from_millis(100);

/// What is evaluated.
#[derive(Clone, Copy)]
enum Kind {
    Density,
    Score,
}

/// The target, the tape of all its values, and who is told of them.
pub(super) struct Source<'a, const D: usize> {
    target: &'a dyn Target<D>,
    /// Every value in the order of evaluation: what an earlier process left, then what this one adds.
    tape: Vec<f64>,
    /// Values of the tape that have been used.
    read: usize,
    /// Points at which anything was evaluated.
    evaluations: u64,
    /// How many there may be, which the observer is told.
    pub limit: u64,
    /// Rounds of which the observer has been told.
    rounds: usize,
    observer: Option<&'a mut Observer<'a>>,
    told: Instant,
    stopped: bool,
    /// How long a point took last, by all threads.
    point: Duration,
}

impl<'a, const D: usize> Source<'a, D> {
    pub fn new(target: &'a dyn Target<D>, tape: Vec<f64>, observer: Option<&'a mut Observer<'a>>) -> Self {
        Self {
            target,
            tape,
            read: 0,
            evaluations: 0,
            limit: 0,
            rounds: 0,
            observer,
            told: Instant::now(),
            stopped: false,
            point: Duration::ZERO,
        }
    }

    /// Whether the observer has stopped it. Nothing is evaluated any more then.
    pub fn is_stopped(&self) -> bool {
        self.stopped
    }

    /// An error where it has: what followed is of no worth.
    pub fn go_on(&self) -> Result<(), PoolError> {
        match self.stopped {
            true => Err(PoolError::Interrupted { round: self.rounds }),
            false => Ok(()),
        }
    }

    /// Tells the observer, of a round if one has ended.
    pub fn tell(&mut self, round: Option<&Round>) {
        self.rounds = round.map_or(self.rounds, |round| round.number);
        let report = Report {
            round,
            evaluations: self.evaluations,
            limit: self.limit,
            tape: &self.tape,
        };
        if let Some(observer) = &mut self.observer {
            self.stopped |= observer(&report).is_break();
        }
        self.told = Instant::now();
    }

    /// log p at all of `xs`; NaN from where it was stopped on.
    pub fn log_densities(&mut self, xs: &[[f64; D]]) -> Vec<f64> {
        self.values(xs, Kind::Density)
    }

    /// ∇ log p at all of `xs`; NaN from where it was stopped on.
    pub fn scores(&mut self, xs: &[[f64; D]]) -> Vec<[f64; D]> {
        self.values(xs, Kind::Score).as_chunks().0.to_vec()
    }

    /// The numbers of all points, one after the other.
    fn values(&mut self, xs: &[[f64; D]], kind: Kind) -> Vec<f64> {
        let width = match kind {
            Kind::Density => 1,
            Kind::Score => D,
        };
        let mut values = self.played(xs.len(), width);
        let mut known = values.len() / width;
        self.evaluations += known as u64;
        values.resize(xs.len() * width, f64::NAN);
        let batch = match kind {
            Kind::Score if self.target.scores_depend_on_calls() => xs.len(),
            _ => self.target.points_per_call().max(1),
        };
        while known < xs.len() && !self.stopped {
            let next = xs.len().min(known.saturating_add(self.stretch(batch)));
            let stretch = &mut values[width * known..width * next];
            self.evaluate(kind, &xs[known..next], stretch, batch);
            known = next;
        }
        values
    }

    /// Points until the observer is due, but for every thread a batch at least.
    fn stretch(&self, batch: usize) -> usize {
        let points = SILENCE.as_nanos() / self.point.as_nanos().max(1);
        let points = usize::try_from(points).unwrap_or(usize::MAX);
        points.max(batch.saturating_mul(mpm_parallel::threads()))
    }

    /// Evaluates a stretch of points, batches side by side, puts it on the tape, and tells of it if it is time.
    fn evaluate(&mut self, kind: Kind, xs: &[[f64; D]], values: &mut [f64], batch: usize) {
        let (target, width, begin) = (self.target, values.len() / xs.len(), Instant::now());
        let tasks = values.chunks_mut(width * batch).zip(xs.chunks(batch));
        mpm_parallel::each(tasks, &|(values, xs): (&mut [f64], &[[f64; D]])| match kind {
            Kind::Density => target.log_densities(xs, values),
            Kind::Score => target.scores(xs, values.as_chunks_mut().0),
        });
        self.point = begin.elapsed() / u32::try_from(xs.len()).unwrap_or(u32::MAX);
        self.tape.extend_from_slice(values);
        self.read += values.len();
        self.evaluations += xs.len() as u64;
        if self.told.elapsed() >= SILENCE {
            self.tell(None);
        }
    }

    /// The next values of the tape, in whole points of `width` values, at most `count` points.
    fn played(&mut self, count: usize, width: usize) -> Vec<f64> {
        let left = (self.tape.len() - self.read) / width;
        let start = self.read;
        self.read += width * count.min(left);
        if left < count {
            // The end of the tape: what is left of it belongs to no whole point.
            self.tape.truncate(self.read);
        }
        self.tape[start..self.read].to_vec()
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Mutex;

    use super::*;

    /// Notes how many points every call for scores has: 100 at most, or all where calls count.
    struct Calls(Mutex<Vec<usize>>, bool);

    impl Target<1> for Calls {
        fn log_density(&self, x: &[f64; 1]) -> f64 {
            -0.5 * x[0] * x[0]
        }
        fn score(&self, x: &[f64; 1]) -> [f64; 1] {
            [-x[0]]
        }
        fn points_per_call(&self) -> usize {
            100
        }
        fn scores_depend_on_calls(&self) -> bool {
            self.1
        }
        fn scores(&self, xs: &[[f64; 1]], out: &mut [[f64; 1]]) {
            if let Ok(mut calls) = self.0.lock() {
                calls.push(xs.len());
            }
            for (x, score) in xs.iter().zip(out) {
                *score = self.score(x);
            }
        }
    }

    #[test]
    fn calls_have_as_many_points_as_the_target_asks_for() {
        let points: Vec<[f64; 1]> = (0..300).map(|n| [f64::from(n)]).collect();
        let calls = |depends| {
            let target = Calls(Mutex::default(), depends);
            let scores = Source::new(&target, Vec::new(), None).scores(&points);
            assert!(scores.iter().zip(&points).all(|(score, x)| score[0] == -x[0]));
            target.0.into_inner().unwrap_or_default()
        };
        assert_eq!((calls(true), calls(false)), (vec![300], vec![100; 3]));
    }
}
