//! Scores that are evaluated at the nodes of a grid, each once, and interpolated from there.

use std::collections::{BTreeMap, HashMap};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use mpm_tensor::vector;
use parvi_targets::{Frame, Target, log_densities_in_calls};

use crate::defaults;
use crate::extent::Extent;
use crate::score_check::{are_same, scores_of};
use crate::score_grid::{Cell, ScoreGrid};
use crate::start::check;
use crate::{NonFiniteScores, SampleError};

/// Dimensions, at most.
const LARGEST_DIMENSION: usize = 5;

/// Evaluations of an earlier process that are made again, at most.
const PROVED: usize = 32;

/// Places of evaluations and what they gave, one after the other: what a checkpoint keeps of a target.
pub(crate) type Tape = Arc<Mutex<Vec<f64>>>;

/// A target whose score is interpolated; it is evaluated only where a node has to be known, and where the interpolant is tested.
pub(crate) struct CachedScores<'a, const D: usize> {
    target: &'a dyn Target<D>,
    /// The grid's coordinates.
    frame: Frame<D>,
    state: Mutex<State<D>>,
    tape: Tape,
    /// A node without a finite score gets that of N(0, I) in the frame.
    pulls_back: bool,
}

struct State<const D: usize> {
    grid: ScoreGrid<D>,
    /// Errors found where cells were tested.
    tested: BTreeMap<Cell<D>, [f64; D]>,
    /// What an earlier process evaluated, by the bits of the place.
    replayed: HashMap<[u64; D], [f64; D]>,
}

/// What fresh scores at some particles say of interpolated ones.
pub(crate) struct Tested {
    /// Root of the mean of |s − s_cached|², in units of one over the particles' standard deviation.
    pub disagreement: f64,
    /// Cells were halved: scores are better from here.
    pub refined: bool,
}

impl<'a, const D: usize> CachedScores<'a, D> {
    /// A grid in the coordinates of `frame`; `tape` is what an earlier process left.
    pub fn new(
        target: &'a dyn Target<D>,
        frame: &Frame<D>,
        policy: NonFiniteScores,
        tape: &[f64],
    ) -> Result<Self, SampleError> {
        check(
            "dimensions of cached scores",
            D as f64,
            D <= LARGEST_DIMENSION,
            "at most 5: more have more nodes than particles need scores",
        )?;
        let (vectors, _) = tape.as_chunks::<D>();
        let pairs = vectors.as_chunks::<2>().0.iter();
        let state = State {
            grid: ScoreGrid::new(defaults::CACHE_SPACING),
            tested: BTreeMap::new(),
            replayed: pairs.map(|[x, score]| (x.map(f64::to_bits), *score)).collect(),
        };
        Ok(Self {
            target,
            frame: *frame,
            state: Mutex::new(state),
            tape: Arc::new(Mutex::new(tape.to_vec())),
            pulls_back: policy == NonFiniteScores::PullBack,
        })
    }

    /// Whether the target still gives some of the scores that an earlier process left, spread over all of them; they count as no evaluations. Scores that another call changes are not compared.
    pub fn is_of_its_target(&self) -> bool {
        if self.target.scores_depend_on_calls() {
            return true;
        }
        let tape = locked(&self.tape);
        let pairs = tape.as_chunks::<D>().0.as_chunks::<2>().0;
        let stride = pairs.len().div_ceil(PROVED).max(1);
        let (places, left): (Vec<[f64; D]>, Vec<[f64; D]>) =
            pairs.iter().step_by(stride).map(|&[x, score]| (x, score)).unzip();
        let fresh = scores_of(self.target, &places);
        are_same(&fresh, &left) || !are_same(&fresh, &scores_of(self.target, &places))
    }

    /// Evaluations so far, those of an earlier process included.
    pub fn evaluations(&self) -> u64 {
        (locked(&self.tape).len() / (2 * D)) as u64
    }

    /// Evaluations so far that gave no finite score where the grid has another in its place, those of an earlier process included.
    pub fn replaced(&self) -> u64 {
        let tape = locked(&self.tape);
        let pairs = tape.as_chunks::<D>().0.as_chunks::<2>().0.iter();
        let is_none = |score: &[f64; D]| !vector::is_finite(&self.frame.pull_back_score(score));
        pairs.filter(|[_, score]| self.pulls_back && is_none(score)).count() as u64
    }

    /// What is evaluated, for a checkpoint.
    pub fn tape(&self) -> Tape {
        self.tape.clone()
    }

    /// Compares with one fresh score in every cell that holds [`CACHE_TESTED_SHARE`](defaults::CACHE_TESTED_SHARE) of the particles or more, and where the mean exceeds what is
    /// tolerated halves the cells where it is exceeded, unless `allowed` evaluations have been made.
    pub fn test(&self, particles: &[[f64; D]], allowed: u64) -> Tested {
        let state = &mut *self.state();
        let zs: Vec<[f64; D]> = particles.iter().map(|x| self.frame.to_reference(x)).collect();
        self.know(state, &zs);
        let held = state.cells_of(&zs);
        let fresh = held.iter().filter(|held| !state.tested.contains_key(&held.cell));
        let points: Vec<[f64; D]> = fresh.clone().map(|held| particles[held.particle]).collect();
        let cells: Vec<Held<D>> = fresh.copied().collect();
        for (held, score) in cells.iter().zip(self.evaluate(state, &points)) {
            let cached = state.grid.interpolate(&zs[held.particle]);
            let error = vector::subtract(&self.frame.pull_back_score(&score), &cached);
            state.tested.insert(held.cell, error);
        }
        let deviation = Extent::of(&zs).deviation;
        let squared = |held: &Held<D>| {
            let error = state.tested[&held.cell];
            (0..D).map(|a| (deviation[a] * error[a]).powi(2)).sum::<f64>()
        };
        let count: usize = held.iter().map(|held| held.count).sum();
        let sum: f64 = held.iter().map(|held| held.count as f64 * squared(held)).sum();
        let disagreement = (sum / count as f64).sqrt();
        let mut refined = false;
        if exceeds(disagreement, defaults::CACHE_TOLERANCE) && self.evaluations() < allowed {
            let too_coarse = |held: &&Held<D>| exceeds(squared(held).sqrt(), defaults::CACHE_TOLERANCE);
            for cell in held.iter().filter(too_coarse).map(|held| held.cell).collect::<Vec<_>>() {
                refined |= state.grid.halve(cell);
            }
        }
        Tested { disagreement, refined }
    }

    /// Evaluates the nodes about points that are not known yet.
    fn know(&self, state: &mut State<D>, zs: &[[f64; D]]) {
        let nodes = state.grid.unknown(zs);
        let places: Vec<[f64; D]> = (nodes.iter())
            .map(|node| self.frame.to_target(&state.grid.place(node)))
            .collect();
        for (node, score) in nodes.into_iter().zip(self.evaluate(state, &places)) {
            let pulled = self.frame.pull_back_score(&score);
            let value = if self.pulls_back && !vector::is_finite(&pulled) {
                state.grid.place(&node).map(|c| -c)
            } else {
                pulled
            };
            state.grid.learn(node, value);
        }
    }

    /// Scores of the target, in its own coordinates.
    fn evaluate(&self, state: &mut State<D>, xs: &[[f64; D]]) -> Vec<[f64; D]> {
        let replayed = |x: &[f64; D]| state.replayed.get(&x.map(f64::to_bits)).copied();
        let fresh: Vec<[f64; D]> = xs.iter().filter(|x| replayed(x).is_none()).copied().collect();
        let scores = scores_of(self.target, &fresh);
        locked(&self.tape).extend(fresh.iter().zip(&scores).flat_map(|(x, score)| [*x, *score]).flatten());
        let mut scores = scores.into_iter();
        (xs.iter())
            .map(|x| replayed(x).or_else(|| scores.next()).unwrap_or([f64::NAN; D]))
            .collect()
    }

    fn state(&self) -> MutexGuard<'_, State<D>> {
        locked(&self.state)
    }
}

fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A cell with particles.
#[derive(Clone, Copy)]
struct Held<const D: usize> {
    cell: Cell<D>,
    /// The first of them.
    particle: usize,
    count: usize,
}

impl<const D: usize> State<D> {
    /// The cells that hold enough of the particles to be tested.
    fn cells_of(&self, zs: &[[f64; D]]) -> Vec<Held<D>> {
        let mut counts: BTreeMap<Cell<D>, (usize, usize)> = BTreeMap::new();
        for (particle, z) in zs.iter().enumerate() {
            if let Some(cell) = self.grid.cell(z) {
                counts.entry(cell).or_insert((particle, 0)).1 += 1;
            }
        }
        // Where none holds that many, the fullest ones.
        let most = counts.values().map(|&(_, count)| count).max().unwrap_or(0);
        let least = (zs.len() as f64 * defaults::CACHE_TESTED_SHARE).min(most as f64);
        let held = counts
            .into_iter()
            .map(|(cell, (particle, count))| Held { cell, particle, count });
        held.filter(|held| held.count as f64 >= least).collect()
    }
}

/// Also of what is not a number.
fn exceeds(value: f64, limit: f64) -> bool {
    value.is_nan() || value > limit
}

impl<const D: usize> Target<D> for CachedScores<'_, D> {
    fn log_density(&self, x: &[f64; D]) -> f64 {
        self.target.log_density(x)
    }

    fn score(&self, x: &[f64; D]) -> [f64; D] {
        let mut score = [[0.0; D]];
        self.scores(&[*x], &mut score);
        score[0]
    }

    fn has_log_density(&self) -> bool {
        self.target.has_log_density()
    }

    /// One call has all points, for the nodes about them are learnt in their order.
    fn points_per_call(&self) -> usize {
        usize::MAX
    }

    fn scores(&self, xs: &[[f64; D]], out: &mut [[f64; D]]) {
        let state = &mut *self.state();
        let zs: Vec<[f64; D]> = xs.iter().map(|x| self.frame.to_reference(x)).collect();
        self.know(state, &zs);
        for (z, out) in zs.iter().zip(out) {
            *out = self.frame.push_forward_score(&state.grid.interpolate(z));
        }
    }

    fn log_densities(&self, xs: &[[f64; D]], out: &mut [f64]) {
        log_densities_in_calls(self.target, xs, out);
    }
}

#[cfg(test)]
mod tests {
    use parvi_targets::Gaussian;

    use super::*;

    #[test]
    fn where_no_cell_holds_many_particles_every_cell_is_tested() {
        let target = Gaussian::<3>::standard();
        let cached = CachedScores::new(&target, &Frame::identity(), NonFiniteScores::PullBack, &[]).unwrap();
        let far = 2.0 * defaults::CACHE_SPACING;
        let particles: Vec<[f64; 3]> = (0..512)
            .map(|i| [i % 8, i / 8 % 8, i / 64].map(|c| far * (f64::from(c) - 3.5)))
            .collect();
        let before = {
            cached.scores(&particles, &mut vec![[0.0; 3]; 512]);
            cached.evaluations()
        };
        let tested = cached.test(&particles, u64::MAX);
        // A score that is linear is interpolated as it is.
        assert!(
            tested.disagreement < 1e-12 && !tested.refined,
            "{}",
            tested.disagreement
        );
        assert_eq!(cached.evaluations() - before, 512);
    }
}
