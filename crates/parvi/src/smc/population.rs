//! One population on its way from the first law to the target.

use mpm_tensor::vector;
use parvi_targets::{Frame, Target};
use rand::RngExt;
use rand::rngs::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::curve::resampled;
use crate::Start;

/// Standard deviation of the first law over that of the start.
const WIDENING: f64 = 3.0;

/// Effective size of the increments of a temperature over the number of states.
const EFFECTIVE: f64 = 0.5;

/// Proposals' step ε = scale · e^{σ ξ}, ξ ~ N(0, 1): ridges want small steps, tails large ones.
const SPREAD: f64 = 1.2;

/// Share of accepted moves that the scale is led to.
const ACCEPTANCE: f64 = 0.45;

/// How fast: change of ln scale over the difference of acceptance.
const GAIN: f64 = 2.0;

/// Largest drift of a move, in steps ε.
const LARGEST_DRIFT: f64 = 2.0;

/// A state with what the target says of it, in coordinates z of the frame.
#[derive(Clone, Copy)]
pub(super) struct State<const D: usize> {
    /// Where it is.
    pub z: [f64; D],
    /// log p(x(z)), finite or −∞.
    log_density: f64,
    /// Lᵀ ∇ log p(x(z)), finite.
    score: [f64; D],
}

/// States on the path q₀^{1−β} p^β.
pub(super) struct Population<'a, const D: usize> {
    target: &'a dyn Target<D>,
    frame: &'a Frame<D>,
    /// Mean and standard deviation of q₀ on every axis.
    first: [f64; 2],
    states: Vec<State<D>>,
    beta: f64,
    /// log ∫ q₀^{1−β} p^β dz.
    pub log_evidence: f64,
    /// Evaluations of the log density, and of the score.
    pub evaluations: u64,
    /// Coordinates in which moves are made.
    whitening: Frame<D>,
    scale: f64,
    generator: ChaCha8Rng,
}

impl<'a, const D: usize> Population<'a, D> {
    /// States of q₀ = N(m, (3 s)² I), made of draws from N(0, I).
    pub fn new(
        target: &'a dyn Target<D>,
        frame: &'a Frame<D>,
        start: &Start,
        standard: &[[f64; D]],
        generator: ChaCha8Rng,
    ) -> Self {
        let first = [start.mean, WIDENING * start.standard_deviation];
        let state = |u: &[f64; D]| evaluated(target, frame, u.map(|c| first[0] + first[1] * c));
        Self {
            target,
            frame,
            first,
            states: standard.iter().map(state).collect(),
            beta: 0.0,
            log_evidence: 0.0,
            evaluations: standard.len() as u64,
            whitening: Frame::identity(),
            // Roberts & Rosenthal 1998: the best step of Langevin moves goes with D^{−1/6}.
            scale: 1.65 * (D as f64).powf(-1.0 / 6.0),
            generator,
        }
    }

    /// Whether β is below 1.
    pub fn is_on_its_way(&self) -> bool {
        self.beta < 1.0
    }

    /// The states.
    pub fn states(&self) -> &[State<D>] {
        &self.states
    }

    /// The next temperature, with chains from so many ancestors; nothing where the population has arrived.
    pub fn advance(&mut self, ancestors: usize) {
        if !self.is_on_its_way() {
            return;
        }
        let logs: Vec<f64> = self.states.iter().map(|state| self.log_ratio(state)).collect();
        let largest = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        if largest == f64::NEG_INFINITY {
            (self.beta, self.log_evidence) = (1.0, f64::NEG_INFINITY);
            return;
        }
        let step = next_step(&logs, largest, 1.0 - self.beta);
        let mut weights: Vec<f64> = logs.iter().map(|log| (step * (log - largest)).exp()).collect();
        let sum: f64 = weights.iter().sum();
        for weight in &mut weights {
            *weight /= sum;
        }
        self.log_evidence += step * largest + (sum / logs.len() as f64).ln();
        self.beta = if step < 1.0 - self.beta { self.beta + step } else { 1.0 };
        let points: Vec<[f64; D]> = self.states.iter().map(|state| state.z).collect();
        if let Ok(whitening) = Frame::of_points(&points, Some(&weights)) {
            self.whitening = whitening;
        }
        let chosen = resampled(&points, &weights, ancestors, self.generator.random());
        self.walk(&chosen);
    }

    /// Chains from the chosen states, whose states are the new population.
    fn walk(&mut self, chosen: &[usize]) {
        let length = self.states.len() / chosen.len();
        let mut visited = Vec::with_capacity(self.states.len());
        let mut accepted = 0usize;
        for &ancestor in chosen {
            let mut state = self.states[ancestor];
            visited.push(state);
            for _ in 1..length {
                if let Some(moved) = self.moved(&state) {
                    state = moved;
                    accepted += 1;
                }
                visited.push(state);
            }
        }
        let acceptance = accepted as f64 / (visited.len() - chosen.len()) as f64;
        self.scale *= (GAIN * (acceptance - ACCEPTANCE)).exp();
        self.states = visited;
    }

    /// A Metropolis-adjusted Langevin move that leaves q₀^{1−β} p^β invariant, in coordinates u of z = c + L u: u' = u + d(u) + ε ξ, d = ½ ε² Lᵀ ∇ log π, no longer than two ε. `None`: refused.
    fn moved(&mut self, state: &State<D>) -> Option<State<D>> {
        let lognormal: f64 = StandardNormal.sample(&mut self.generator);
        let noise: [f64; D] = std::array::from_fn(|_| StandardNormal.sample(&mut self.generator));
        let level: f64 = self.generator.random();
        let epsilon = self.scale * (SPREAD * lognormal).exp();
        let forth = vector::add_scaled(&self.drift(state, epsilon), epsilon, &noise);
        let z = vector::add(&state.z, &self.whitening.factor().apply(&forth));
        if !vector::is_finite(&z) {
            return None;
        }
        let proposal = evaluated(self.target, self.frame, z);
        self.evaluations += 1;
        if proposal.log_density == f64::NEG_INFINITY {
            return None;
        }
        // −forth = d(u') + ε ξ'.
        let back = vector::add(&forth, &self.drift(&proposal, epsilon));
        let noises = vector::norm_squared(&noise) - vector::norm_squared(&back) / (epsilon * epsilon);
        let ratio = self.log_density(&proposal) - self.log_density(state) + 0.5 * noises;
        (level.ln() < ratio).then_some(proposal)
    }

    /// d(u).
    fn drift(&self, state: &State<D>, epsilon: f64) -> [f64; D] {
        let [mean, deviation] = self.first;
        let score = std::array::from_fn(|a| {
            self.beta * state.score[a] - (1.0 - self.beta) * (state.z[a] - mean) / (deviation * deviation)
        });
        let drift = vector::scale(&self.whitening.pull_back_score(&score), 0.5 * epsilon * epsilon);
        if !vector::is_finite(&drift) {
            return [0.0; D];
        }
        let length = vector::norm(&drift);
        vector::scale(
            &drift,
            (LARGEST_DRIFT * epsilon / length.max(f64::MIN_POSITIVE)).min(1.0),
        )
    }

    /// log q₀(z)^{1−β} p(z)^β.
    fn log_density(&self, state: &State<D>) -> f64 {
        self.beta * state.log_density + (1.0 - self.beta) * self.first_log_density(&state.z)
    }

    /// log p(z)/q₀(z).
    fn log_ratio(&self, state: &State<D>) -> f64 {
        state.log_density - self.first_log_density(&state.z)
    }

    /// log q₀(z).
    fn first_log_density(&self, z: &[f64; D]) -> f64 {
        let [mean, deviation] = self.first;
        let per_axis =
            |c: &f64| -0.5 * (((c - mean) / deviation).powi(2) + std::f64::consts::TAU.ln()) - deviation.ln();
        z.iter().map(per_axis).sum()
    }
}

/// What the target says at z; a log density that is NaN or +∞ counts as −∞, a score that is not finite as 0.
fn evaluated<const D: usize>(target: &dyn Target<D>, frame: &Frame<D>, z: [f64; D]) -> State<D> {
    let x = frame.to_target(&z);
    let log_density = target.log_density(&x);
    let score = frame.pull_back_score(&target.score(&x));
    State {
        z,
        log_density: if log_density < f64::INFINITY {
            log_density
        } else {
            f64::NEG_INFINITY
        },
        score: if vector::is_finite(&score) { score } else { [0.0; D] },
    }
}

/// The largest Δβ ≤ `rest` at which the effective size of e^{Δβ log} is half the number of states that have a density.
fn next_step(logs: &[f64], largest: f64, rest: f64) -> f64 {
    let wanted = EFFECTIVE * logs.iter().filter(|log| log.is_finite()).count() as f64;
    let suffices = |step: f64| {
        let [sum, squares] = logs.iter().fold([0.0, 0.0], |[sum, squares], log| {
            let weight = (step * (log - largest)).exp();
            [sum + weight, squares + weight * weight]
        });
        sum * sum >= wanted * squares
    };
    if suffices(rest) {
        return rest;
    }
    // Halving the logarithm: log densities of 1e300 take as long as others.
    let (mut enough, mut too_far) = (rest * 1e-305, rest);
    for _ in 0..60 {
        let between = enough.sqrt() * too_far.sqrt();
        if suffices(between) {
            enough = between;
        } else {
            too_far = between;
        }
    }
    enough
}
