//! Values of the target: those that an earlier process left, of which some are evaluated again, then new ones, of which an observer is told.

use std::time::{Duration, Instant};

use parvi_targets::{Target, log_densities_in_calls, scores_in_calls};

use crate::options::{PoolError, Round};
use crate::report::{Observer, Report};

/// How long an observer waits for news, unless a batch takes longer.
const SILENCE: Duration = Duration::from_millis(100);

/// Points of the tape that are evaluated again, of each kind and at most.
const PROVED: usize = 32;

/// What is evaluated.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Density,
    Score,
}

impl Kind {
    /// Numbers at a point.
    fn width<const D: usize>(self) -> usize {
        match self {
            Self::Density => 1,
            Self::Score => D,
        }
    }
}

/// The target, the tape of all its values, and who is told of them.
pub(super) struct Source<'a, const D: usize> {
    target: &'a dyn Target<D>,
    /// Every value in the order of evaluation: what an earlier process left, then what this one adds.
    tape: Vec<f64>,
    /// Values of the tape that have been used.
    read: usize,
    /// Points whose densities, and scores, an earlier process left, and where these begin on the tape; none once they are proved.
    played: [Vec<([f64; D], usize)>; 2],
    /// The tape is of another target.
    is_of_another: bool,
    /// Points at which anything was evaluated.
    evaluations: u64,
    /// How many there may be, which the observer is told.
    pub limit: u64,
    /// Rounds of which the observer has been told.
    rounds: usize,
    observer: Option<&'a mut Observer<'a>>,
    told: Instant,
    stopped: bool,
    /// How long a point took last, by all threads; before the first one, long.
    point: Duration,
}

impl<'a, const D: usize> Source<'a, D> {
    pub fn new(target: &'a dyn Target<D>, tape: Vec<f64>, observer: Option<&'a mut Observer<'a>>) -> Self {
        Self {
            target,
            tape,
            read: 0,
            played: [Vec::new(), Vec::new()],
            is_of_another: false,
            evaluations: 0,
            limit: 0,
            rounds: 0,
            observer,
            told: Instant::now(),
            stopped: false,
            point: SILENCE,
        }
    }

    /// Whether the observer has stopped it. Nothing is evaluated any more then.
    pub fn is_stopped(&self) -> bool {
        self.stopped
    }

    /// An error where it has, or where the tape is of another target: what followed is of no worth.
    pub fn go_on(&self) -> Result<(), PoolError> {
        match (self.is_of_another, self.stopped) {
            (true, _) => Err(PoolError::AnotherTape),
            (_, true) => Err(PoolError::Interrupted { round: self.rounds }),
            _ => Ok(()),
        }
    }

    /// Evaluates some of the points again whose values were on the tape, spread over all of them, and stops where any differs. They count as no evaluations.
    pub fn prove_tape(&mut self) {
        for (kind, played) in [Kind::Density, Kind::Score]
            .into_iter()
            .zip(std::mem::take(&mut self.played))
        {
            let stride = played.len().div_ceil(PROVED).max(1);
            let (xs, places): (Vec<[f64; D]>, Vec<usize>) = played.into_iter().step_by(stride).unzip();
            let width = kind.width::<D>();
            let kept: Vec<f64> = places
                .iter()
                .flat_map(|&place| self.tape[place..place + width].to_vec())
                .collect();
            if self.stopped || kind == Kind::Score && self.target.scores_depend_on_calls() {
                continue;
            }
            let mut fresh = || self.evaluated(kind, &xs, false);
            let found = fresh();
            // Scores that another call changes are estimates.
            let differs = !are_same(&found, &kept) && (kind == Kind::Density || are_same(&found, &fresh()));
            if differs && !self.stopped {
                (self.is_of_another, self.stopped) = (true, true);
            }
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
        let mut values = self.replayed(xs, kind);
        let fresh = &xs[values.len() / kind.width::<D>()..];
        self.evaluations += (xs.len() - fresh.len()) as u64;
        if !fresh.is_empty() {
            self.prove_tape();
            let known = self.tape.len();
            values.extend(self.evaluated(kind, fresh, true));
            self.read += self.tape.len() - known;
        }
        values
    }

    /// The target's numbers at points, stretch by stretch, on the tape and counted where they are new.
    fn evaluated(&mut self, kind: Kind, xs: &[[f64; D]], are_new: bool) -> Vec<f64> {
        let width = kind.width::<D>();
        let batch = match kind {
            Kind::Score if self.target.scores_depend_on_calls() => xs.len(),
            _ => self.target.points_per_call().max(1),
        };
        let (mut values, mut known) = (vec![f64::NAN; xs.len() * width], 0);
        while known < xs.len() && !self.stopped {
            let next = xs.len().min(known.saturating_add(self.stretch(batch)));
            let stretch = &mut values[width * known..width * next];
            self.evaluate(kind, &xs[known..next], stretch);
            if are_new {
                self.tape.extend_from_slice(stretch);
                self.evaluations += (next - known) as u64;
            }
            if self.told.elapsed() >= SILENCE {
                self.tell(None);
            }
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

    /// Evaluates a stretch of points, batches side by side.
    fn evaluate(&mut self, kind: Kind, xs: &[[f64; D]], values: &mut [f64]) {
        let begin = Instant::now();
        match kind {
            Kind::Density => log_densities_in_calls(self.target, xs, values),
            Kind::Score => scores_in_calls(self.target, xs, values.as_chunks_mut().0),
        }
        self.point = begin.elapsed() / u32::try_from(xs.len()).unwrap_or(u32::MAX);
    }

    /// The next values of the tape, in whole points, for as many of `xs` as it has.
    fn replayed(&mut self, xs: &[[f64; D]], kind: Kind) -> Vec<f64> {
        let (width, start) = (kind.width::<D>(), self.read);
        let left = (self.tape.len() - start) / width;
        self.read += width * xs.len().min(left);
        let places = (start..self.read).step_by(width);
        self.played[kind as usize].extend(xs.iter().copied().zip(places));
        if left < xs.len() {
            // The end of the tape: what is left of it belongs to no whole point.
            self.tape.truncate(self.read);
        }
        self.tape[start..self.read].to_vec()
    }
}

/// Whether numbers are the same to the bit; NaN is NaN.
fn are_same(some: &[f64], others: &[f64]) -> bool {
    let is_same = |(a, b): (&f64, &f64)| a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan();
    some.iter().zip(others).all(is_same)
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
