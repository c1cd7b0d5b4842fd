//! Stein variational gradient descent (Liu & Wang 2016), the O(M²) baseline.

use mpm_tensor::vector;
use parvi_body::FramedScore;
use parvi_targets::log_densities_in_calls;
use rand::seq::index;

use crate::drive::finite;
use crate::start::{positive, steps};
use crate::task::{Task, sampler};
use crate::view::Moment;
use crate::{Certificate, Progress, SampleError, Samples, SvgdOptions, TracePoint, defaults};

/// The median of pairwise distances is taken over at most this many particles.
const MEDIAN_SAMPLE: usize = 512;

sampler! {
    /// Move particles by φ(x) = M⁻¹ Σ_j [k(x_j, x) s(x_j) + ∇_{x_j} k(x_j, x)], k(x, y) = exp(−|x − y|² / b), with Adam steps
    /// (Kingma & Ba 2015), in the coordinates of `frame`.
    ///
    /// At the end log p is evaluated at the particles, where it is known: if it is not finite at some of them, [`Samples::certificate`] says so, and there is none otherwise.
    ///
    /// # Errors
    /// [`SampleError`]: an option out of range, a score or positions that are not finite, or the observer's stop.
    SvgdOptions => Self::run
}

impl SvgdOptions {
    fn run<const D: usize>(&self, task: Task<'_, D>) -> Result<Samples<D>, SampleError> {
        let (target, frame, run, observer) = task.parts();
        let steps = steps(self.steps, defaults::SVGD_STEPS)?;
        let rate = positive("step size", Some(self.step_size), 0.0)?;
        if let Some(bandwidth) = self.bandwidth {
            positive("bandwidth", Some(bandwidth), 0.0)?;
        }
        run.given.check_taken("svgd", true)?;
        let mut positions = run.begin(frame)?;
        let mut score = FramedScore::new(target, frame);
        let mut scores = vec![[0.0; D]; positions.len()];
        let mut adam = Adam::new(positions.len(), rate);
        let mut trace = Vec::new();
        let sample: Vec<usize> = {
            let mut generator = run.generator(2);
            index::sample(&mut generator, positions.len(), positions.len().min(MEDIAN_SAMPLE)).into_vec()
        };
        let to_target = |z: &[f64; D]| frame.to_target(z);
        let in_target = |positions: &[[f64; D]], step| finite(positions.iter().map(to_target).collect(), step);
        let seen_after = |step: usize| Moment {
            step,
            steps,
            time: step as f64 * rate,
            ..Moment::default()
        };
        seen_after(0).show_points(&positions, &to_target, observer)?;
        for step in 1..=steps {
            score
                .evaluate(&positions, &mut scores)
                .map_err(|error| SampleError::in_step(step, error))?;
            let bandwidth = self.bandwidth.unwrap_or_else(|| median_bandwidth(&positions, &sample));
            let directions = stein_directions(&positions, &scores, bandwidth);
            let moved = adam.step(&mut positions, &directions);
            // Where there is no place there is no score either, which is not the target's fault.
            in_target(&positions, step)?;
            if self.trace_every > 0 && (step % self.trace_every == 0 || step == 1) {
                trace.push(TracePoint {
                    step,
                    time: step as f64 * rate,
                    residual: None,
                    kinetic_energy: 0.0,
                    internal_energy: None,
                    potential_energy: score.potential_energy(&positions),
                    displacement: moved,
                });
            }
            seen_after(step).show_points(&positions, &to_target, observer)?;
            if observer.after_step(Progress { step, steps }).is_break() {
                return Err(SampleError::Interrupted { step });
            }
        }
        let positions = in_target(&positions, steps)?;
        let (certificate, density_evaluations) = if target.has_log_density() {
            let mut log_densities = vec![0.0; positions.len()];
            log_densities_in_calls(target, &positions, &mut log_densities);
            (Certificate::of_outside(&log_densities), positions.len() as u64)
        } else {
            (None, 0)
        };
        Ok(Samples {
            positions,
            steps,
            score_evaluations: score.evaluations,
            density_evaluations,
            certificate,
            trace,
            ..Samples::default()
        })
    }
}

/// φ at every particle; each sum is taken in the order of the particles, whatever the number of threads.
fn stein_directions<const D: usize>(positions: &[[f64; D]], scores: &[[f64; D]], bandwidth: f64) -> Vec<[f64; D]> {
    let (inverse, share) = (1.0 / bandwidth, 1.0 / positions.len() as f64);
    let direction = |p: usize| {
        let x = &positions[p];
        let mut sum = [0.0; D];
        for (y, score) in positions.iter().zip(scores) {
            let apart = vector::subtract(x, y);
            let kernel = (-inverse * vector::norm_squared(&apart)).exp();
            for a in 0..D {
                sum[a] += kernel * (score[a] + 2.0 * inverse * apart[a]);
            }
        }
        sum.map(|c| share * c)
    };
    mpm_parallel::collect(positions.len(), 1, &direction)
}

/// The median heuristic b = median|x_i − x_j|² / ln M (Liu & Wang 2016, §5), over the pairs of `sample`.
fn median_bandwidth<const D: usize>(positions: &[[f64; D]], sample: &[usize]) -> f64 {
    let mut squares = Vec::with_capacity(sample.len() * sample.len() / 2);
    for (k, &i) in sample.iter().enumerate() {
        for &j in &sample[..k] {
            squares.push(vector::distance_squared(&positions[i], &positions[j]));
        }
    }
    let middle = squares.len() / 2;
    let (_, median, _) = squares.select_nth_unstable_by(middle, f64::total_cmp);
    (*median / (positions.len() as f64).ln()).max(f64::MIN_POSITIVE.sqrt())
}

/// Adam with its usual constants; ascends.
struct Adam<const D: usize> {
    rate: f64,
    first: Vec<[f64; D]>,
    second: Vec<[f64; D]>,
    steps: i32,
}

impl<const D: usize> Adam<D> {
    const DECAY: [f64; 2] = [0.9, 0.999];

    fn new(count: usize, rate: f64) -> Self {
        Self {
            rate,
            first: vec![[0.0; D]; count],
            second: vec![[0.0; D]; count],
            steps: 0,
        }
    }

    /// Move `positions` along `directions`; returns the largest move along an axis.
    fn step(&mut self, positions: &mut [[f64; D]], directions: &[[f64; D]]) -> f64 {
        self.steps = self.steps.saturating_add(1);
        let [decay_first, decay_second] = Self::DECAY;
        let unbias = Self::DECAY.map(|decay| 1.0 / (1.0 - decay.powi(self.steps)));
        let mut largest = 0.0f64;
        for (p, x) in positions.iter_mut().enumerate() {
            for a in 0..D {
                let g = directions[p][a];
                let (first, second) = (&mut self.first[p][a], &mut self.second[p][a]);
                *first = decay_first * *first + (1.0 - decay_first) * g;
                *second = decay_second * *second + (1.0 - decay_second) * g * g;
                let change = self.rate * *first * unbias[0] / ((*second * unbias[1]).sqrt() + 1e-8);
                largest = largest.max(change.abs());
                x[a] += change;
            }
        }
        largest
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn direction_is_the_sum_over_pairs() {
        let positions = [[0.0, 0.0], [1.0, 0.0], [0.0, 2.0]];
        let scores = positions.map(|x: [f64; 2]| [-x[0], -x[1]]);
        let b = 1.7;
        let directions = stein_directions(&positions, &scores, b);
        for (i, x) in positions.iter().enumerate() {
            let mut expected = [0.0; 2];
            for (y, s) in positions.iter().zip(&scores) {
                let k = (-((x[0] - y[0]).powi(2) + (x[1] - y[1]).powi(2)) / b).exp();
                for a in 0..2 {
                    // ∇_y k(y, x) = 2 (x − y) k / b
                    expected[a] += (k * s[a] + 2.0 * (x[a] - y[a]) * k / b) / 3.0;
                }
            }
            for a in 0..2 {
                assert!((directions[i][a] - expected[a]).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn median_heuristic() {
        let positions = [[0.0], [1.0], [3.0]];
        // |differences|² = 1, 9, 4: median 4.
        assert!((median_bandwidth(&positions, &[0, 1, 2]) - 4.0 / 3f64.ln()).abs() < 1e-15);
    }
}
