//! Unbiased scores from a random part of the data.

use std::sync::atomic::{AtomicU64, Ordering};

use mpm_tensor::vector;
use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;

use crate::error::{finite, within};
use crate::{SumTarget, Target, TargetError};

/// A target whose score is estimated from b of the n terms of a sum, drawn anew, without replacement, at every call:
/// ŝ(x) = ∇ℓ₀(x) + n/b Σ_{i∈S} ∇ℓ_i(x), whose mean over S is the score.
///
/// With a [control variate](Self::with_control_variate) at a centre c,
/// ŝ(x) = ∇ℓ₀(x) + Σ_i ∇ℓ_i(c) + n/b Σ_{i∈S} \[∇ℓ_i(x) − ∇ℓ_i(c)\]: the noise then falls with |x − c| and vanishes at c.
/// Take c near the mode.
///
/// All points of one call of [`scores`](Target::scores) share one S, so the noise moves a cloud as a whole: without a control
/// variate its mean can end standard deviations away from the target's. S depends on the
/// seed and on the number of calls made before: as long as calls follow each other (a sampler's do) a run has the same bits
/// on any number of threads. [`restart`](Self::restart) before a second run with the same target.
/// [`score`](Target::score) is a call with one point. Log densities use all terms.
///
/// Source: J. Baker, P. Fearnhead, E. B. Fox & C. Nemeth, *Control variates for stochastic gradient MCMC*, Stat. Comput. 29 (2019),
/// doi 10.1007/s11222-018-9826-2.
///
/// ```
/// use parvi_targets::{LogisticRegression, MinibatchScore, RegressionData, Target};
///
/// let data = RegressionData::synthetic(&[0.5, -1.0], 10_000, 1)?;
/// let posterior = LogisticRegression::<2>::with_prior("synthetic", data, 10.0)?;
/// let frame = *posterior.laplace().frame();
/// let x = frame.to_target(&[1.0, -1.0]); // a standard deviation from the mode on either axis
///
/// let plain = MinibatchScore::new(&posterior, 100, 7)?;
/// let controlled = MinibatchScore::new(&posterior, 100, 7)?.with_control_variate(*frame.centre())?;
/// let exact = posterior.score(&x);
/// let error = |estimate: [f64; 2]| (estimate[0] - exact[0]).hypot(estimate[1] - exact[1]);
/// assert!(error(controlled.score(&x)) < 0.1 * error(plain.score(&x)));
/// # Ok::<(), parvi_targets::TargetError>(())
/// ```
#[derive(Debug)]
pub struct MinibatchScore<T, const D: usize> {
    target: T,
    batch: usize,
    seed: u64,
    calls: AtomicU64,
    control: Option<ControlVariate<D>>,
}

#[derive(Clone, Copy, Debug)]
struct ControlVariate<const D: usize> {
    centre: [f64; D],
    /// Σ_i ∇ℓ_i(c) over all terms.
    sum: [f64; D],
}

impl<T: SumTarget<D>, const D: usize> MinibatchScore<T, D> {
    /// Scores from `batch` terms of `target` at a time, drawn with `seed`.
    ///
    /// # Errors
    /// [`TargetError::OutOfRange`] unless `batch` is from 1 to the number of terms.
    pub fn new(target: T, batch: usize, seed: u64) -> Result<Self, TargetError> {
        let fits = (1..=target.terms()).contains(&batch);
        within(
            "the size of a minibatch",
            batch as f64,
            fits,
            "from 1 to the number of terms",
        )?;
        Ok(Self {
            target,
            batch,
            seed,
            calls: AtomicU64::new(0),
            control: None,
        })
    }

    /// The same with a control variate at `centre`; costs one full score.
    ///
    /// # Errors
    /// [`TargetError::NotFinite`] for the centre or the score there.
    pub fn with_control_variate(mut self, centre: [f64; D]) -> Result<Self, TargetError> {
        for (axis, &value) in (1..).zip(&centre) {
            finite(&format!("x{axis} of the centre"), value)?;
        }
        let all: Vec<usize> = (0..self.target.terms()).collect();
        let sum = self.sum_at(&all, &centre);
        for (axis, &value) in (1..).zip(&sum) {
            finite(&format!("the score at the centre along x{axis}"), value)?;
        }
        self.control = Some(ControlVariate { centre, sum });
        Ok(self)
    }

    /// The sum behind it.
    pub fn target(&self) -> &T {
        &self.target
    }

    /// Calls made so far.
    pub fn calls(&self) -> u64 {
        self.calls.load(Ordering::Relaxed)
    }

    /// Begins again with the minibatch of the first call.
    pub fn restart(&self) {
        self.calls.store(0, Ordering::Relaxed);
    }

    /// The terms that the call with a number uses, counted from 0, in increasing order.
    pub fn terms_of_call(&self, call: u64) -> Vec<usize> {
        let terms = self.target.terms();
        if self.batch == terms {
            return (0..terms).collect();
        }
        let mut generator = ChaCha8Rng::seed_from_u64(self.seed);
        generator.set_stream(call);
        let mut drawn = rand::seq::index::sample(&mut generator, terms, self.batch).into_vec();
        drawn.sort_unstable();
        drawn
    }

    /// `out[p]` = ŝ(xs\[p\]) of the call with a number; does not count as a call.
    pub fn scores_of_call(&self, call: u64, xs: &[[f64; D]], out: &mut [[f64; D]]) {
        let terms = self.terms_of_call(call);
        self.target.sums_of_term_scores(&terms, xs, out);
        let scale = self.target.terms() as f64 / self.batch as f64;
        let (sum, at_centre) = match &self.control {
            Some(control) => (control.sum, self.sum_at(&terms, &control.centre)),
            None => ([0.0; D], [0.0; D]),
        };
        for (x, out) in xs.iter().zip(out) {
            let prior = self.target.prior_score(x);
            let difference = vector::subtract(out, &at_centre);
            *out = vector::add(&prior, &vector::add_scaled(&sum, scale, &difference));
        }
    }

    fn sum_at(&self, terms: &[usize], x: &[f64; D]) -> [f64; D] {
        let mut sum = [[0.0; D]];
        self.target.sums_of_term_scores(terms, &[*x], &mut sum);
        sum[0]
    }
}

impl<T: SumTarget<D>, const D: usize> Target<D> for MinibatchScore<T, D> {
    fn log_density(&self, x: &[f64; D]) -> f64 {
        self.target.full_log_density(x)
    }

    fn scores_depend_on_calls(&self) -> bool {
        true
    }

    /// A call with one point.
    fn score(&self, x: &[f64; D]) -> [f64; D] {
        let mut score = [[0.0; D]];
        self.scores(&[*x], &mut score);
        score[0]
    }

    fn scores(&self, xs: &[[f64; D]], out: &mut [[f64; D]]) {
        let call = self.calls.fetch_add(1, Ordering::Relaxed);
        self.scores_of_call(call, xs, out);
    }

    /// In parallel over the points.
    fn log_densities(&self, xs: &[[f64; D]], out: &mut [f64]) {
        mpm_parallel::write(xs, out, &|x| self.log_density(x));
    }
}
