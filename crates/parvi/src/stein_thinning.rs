//! Stein thinning: the few of many draws that represent a density best, by a greedy choice.

use mpm_tensor::{Matrix, vector};
use parvi_targets::Frame;

use crate::PointSetError;
use crate::point_set_error::check_finite;

/// Candidates that one task scores at a time.
const CHUNK: usize = 1024;

/// Choose `count` of n draws x_i with scores s_i = ∇ log p(x_i), one after the other, each so that the kernel Stein discrepancy of those
/// chosen becomes least:
///
/// i_m = argmin_i ½ k₀(x_i, x_i) + Σ_{l<m} k₀(x_{i_l}, x_i).
///
/// k₀ is the Stein kernel of the inverse multiquadric k(x, y) = (1 + (x − y)ᵀ Γ⁻¹ (x − y))^{−1/2}, Γ the covariance of the draws, all in
/// coordinates in which every axis of the draws has variance 1:
///
/// k₀(x, y) = ∇_x·∇_y k + s(x)·∇_y k + s(y)·∇_x k + k s(x)·s(y).
///
/// Returned are the indices in the order of their choice; an index may appear more than once, which gives its draw more weight. The draws
/// may be biased or dependent, as those of a Markov chain. O(n · count · D), in parallel; the same indices on any number of threads, and the
/// lowest of several equally good ones.
///
/// Source: M. Riabiz, W. Y. Chen, J. Cockayne, P. Swietach, S. A. Niederer, L. Mackey, C. J. Oates, *Optimal thinning of MCMC output*, J. R.
/// Stat. Soc. B 84, 2022, Algorithm 1, with the sample covariance as preconditioner (§2.3).
///
/// # Errors
/// [`PointSetError`]: no draws, another number of scores than of positions, numbers that are not finite, or draws whose covariance is
/// singular (n ≤ D among them).
pub fn stein_thinning<const D: usize>(
    positions: &[[f64; D]],
    scores: &[[f64; D]],
    count: usize,
) -> Result<Vec<usize>, PointSetError> {
    let mut choice = GreedyChoice::new(positions, scores)?;
    Ok((0..count).map(|_| choice.next_index()).collect())
}

/// The greedy choice, one index at a time.
pub(crate) struct GreedyChoice<const D: usize> {
    kernel: SteinKernel,
    candidates: Vec<Candidate<D>>,
    /// ½ k₀(x_i, x_i) + Σ k₀(x_{i_l}, x_i) over those chosen.
    objective: Vec<f64>,
    /// The least objective and where it is.
    best: (f64, usize),
}

impl<const D: usize> GreedyChoice<D> {
    /// Nothing chosen yet.
    pub fn new(positions: &[[f64; D]], scores: &[[f64; D]]) -> Result<Self, PointSetError> {
        let (kernel, candidates) = prepare(positions, scores)?;
        let objective: Vec<f64> = candidates.iter().map(|c| 0.5 * kernel.value(c, c)).collect();
        let best = least(&objective, 0);
        Ok(Self {
            kernel,
            candidates,
            objective,
            best,
        })
    }

    /// Choose one more.
    pub fn next_index(&mut self) -> usize {
        let chosen = self.best.1;
        let (latest, kernel) = (self.candidates[chosen], self.kernel);
        let values = self.objective.chunks_mut(CHUNK);
        let chunks = values.zip(self.candidates.chunks(CHUNK)).enumerate();
        let minima = mpm_parallel::map(chunks, &|(chunk, (values, candidates)): (usize, (&mut [f64], &[_]))| {
            for (value, candidate) in values.iter_mut().zip(candidates) {
                *value += kernel.value(&latest, candidate);
            }
            least(values, chunk * CHUNK)
        });
        self.best = minima.into_iter().fold((f64::INFINITY, chosen), smaller);
        chosen
    }
}

/// A draw in coordinates of unit variances.
#[derive(Clone, Copy)]
pub(crate) struct Candidate<const D: usize> {
    /// L⁻¹ z with L Lᵀ = Γ.
    whitened: [f64; D],
    /// Γ⁻¹ z.
    weighted: [f64; D],
    /// ∇_z log p.
    score: [f64; D],
}

impl<const D: usize> Candidate<D> {
    /// For Γ = I.
    pub(crate) fn isotropic(x: &[f64; D], score: &[f64; D]) -> Self {
        Self {
            whitened: *x,
            weighted: *x,
            score: *score,
        }
    }
}

/// The Stein kernel of the preconditioned inverse multiquadric.
#[derive(Clone, Copy)]
pub(crate) struct SteinKernel {
    /// tr Γ⁻¹.
    trace: f64,
}

impl SteinKernel {
    /// The one with Γ = I.
    pub(crate) fn isotropic<const D: usize>() -> Self {
        Self { trace: D as f64 }
    }

    /// k₀ = −3 |Γ⁻¹ r|² q^{−5/2} + (tr Γ⁻¹ + (s_x − s_y)·Γ⁻¹ r) q^{−3/2} + s_x·s_y q^{−1/2}, r = x − y, q = 1 + rᵀ Γ⁻¹ r.
    #[inline]
    pub(crate) fn value<const D: usize>(&self, x: &Candidate<D>, y: &Candidate<D>) -> f64 {
        let (mut square, mut weighted_square, mut mixed, mut product) = (0.0, 0.0, self.trace, 0.0);
        for a in 0..D {
            let apart = x.whitened[a] - y.whitened[a];
            let weighted = x.weighted[a] - y.weighted[a];
            square += apart * apart;
            weighted_square += weighted * weighted;
            mixed += (x.score[a] - y.score[a]) * weighted;
            product += x.score[a] * y.score[a];
        }
        let inverse = 1.0 / (1.0 + square);
        inverse.sqrt() * (product + inverse * (mixed - 3.0 * weighted_square * inverse))
    }
}

/// The kernel of a sample and its draws in the form that the kernel needs.
fn prepare<const D: usize>(
    positions: &[[f64; D]],
    scores: &[[f64; D]],
) -> Result<(SteinKernel, Vec<Candidate<D>>), PointSetError> {
    if positions.is_empty() {
        return Err(PointSetError::Empty { field: "the sample" });
    }
    if positions.len() != scores.len() {
        return Err(PointSetError::LengthMismatch {
            positions: positions.len(),
            scores: scores.len(),
        });
    }
    check_finite("position", positions)?;
    check_finite("score", scores)?;
    let (mean, covariance) = moments(positions);
    // An axis without variance makes the covariance singular in any unit.
    let unit = |variance: f64| if variance > 0.0 { variance.sqrt() } else { 1.0 };
    let scales: [f64; D] = std::array::from_fn(|a| unit(covariance.0[a][a]));
    let correlation = std::array::from_fn(|a| std::array::from_fn(|b| covariance.0[a][b] / scales[a] / scales[b]));
    let frame = Frame::new([0.0; D], Matrix(correlation)).map_err(PointSetError::Covariance)?;
    let candidate = |(x, score): (&[f64; D], &[f64; D])| {
        let whitened = frame.to_reference(&std::array::from_fn(|a| (x[a] - mean[a]) / scales[a]));
        Candidate {
            whitened,
            weighted: frame.push_forward_score(&whitened),
            score: std::array::from_fn(|a| score[a] * scales[a]),
        }
    };
    let axis = |a: usize| frame.to_reference(&std::array::from_fn(|b| f64::from(u8::from(a == b))));
    let trace = (0..D).map(|a| vector::norm_squared(&axis(a))).sum();
    let candidates: Vec<Candidate<D>> = positions.iter().zip(scores).map(candidate).collect();
    check_finite("scaled score", &candidates.iter().map(|c| c.score).collect::<Vec<_>>())?;
    Ok((SteinKernel { trace }, candidates))
}

/// Mean and covariance (divisor n) of points.
fn moments<const D: usize>(points: &[[f64; D]]) -> ([f64; D], Matrix<D>) {
    let share = 1.0 / points.len() as f64;
    let mut mean = [0.0; D];
    for x in points {
        vector::accumulate(&mut mean, share, x);
    }
    let mut covariance = [[0.0; D]; D];
    for x in points {
        let apart = vector::subtract(x, &mean);
        for a in 0..D {
            vector::accumulate(&mut covariance[a], share * apart[a], &apart);
        }
    }
    for a in 0..D {
        for b in 0..a {
            covariance[b][a] = covariance[a][b];
        }
    }
    (mean, Matrix(covariance))
}

/// The least of `values` and its index, the first one at `offset`.
fn least(values: &[f64], offset: usize) -> (f64, usize) {
    let indexed = values.iter().enumerate().map(|(index, &value)| (value, offset + index));
    indexed.fold((f64::INFINITY, offset), smaller)
}

/// The pair with the smaller value; the first of two equal ones.
fn smaller(first: (f64, usize), second: (f64, usize)) -> (f64, usize) {
    if second.0 < first.0 { second } else { first }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_kernel_is_the_stein_operator_applied_twice() {
        // By central differences of k in coordinates of unit variances, for Γ = ((1, r), (r, 1)).
        let r = 0.6;
        let by_inverse = |v: [f64; 2]| [(v[0] - r * v[1]) / (1.0 - r * r), (v[1] - r * v[0]) / (1.0 - r * r)];
        let frame = Frame::new([0.0; 2], Matrix([[1.0, r], [r, 1.0]])).expect("a frame");
        let candidate = |z: [f64; 2], score: [f64; 2]| Candidate {
            whitened: frame.to_reference(&z),
            weighted: by_inverse(z),
            score,
        };
        let kernel = |x: &[f64; 2], y: &[f64; 2]| {
            let apart = vector::subtract(x, y);
            (1.0 + vector::dot(&apart, &by_inverse(apart))).powf(-0.5)
        };
        let (x, y) = (([0.3, -0.7], [0.5, 1.1]), ([-0.4, 0.9], [-1.3, 0.2]));
        let h = 1e-4;
        let moved = |p: &[f64; 2], a: usize, by: f64| {
            let mut p = *p;
            p[a] += by;
            p
        };
        let mut expected = kernel(&x.0, &y.0) * vector::dot(&x.1, &y.1);
        for a in 0..2 {
            let by_x = (kernel(&moved(&x.0, a, h), &y.0) - kernel(&moved(&x.0, a, -h), &y.0)) / (2.0 * h);
            let by_y = (kernel(&x.0, &moved(&y.0, a, h)) - kernel(&x.0, &moved(&y.0, a, -h))) / (2.0 * h);
            let corner = |u: f64, v: f64| kernel(&moved(&x.0, a, u), &moved(&y.0, a, v));
            let by_both = (corner(h, h) - corner(h, -h) - corner(-h, h) + corner(-h, -h)) / (4.0 * h * h);
            expected += by_both + x.1[a] * by_y + y.1[a] * by_x;
        }
        let trace = 2.0 / (1.0 - r * r);
        let value = SteinKernel { trace }.value(&candidate(x.0, x.1), &candidate(y.0, y.1));
        assert!((value - expected).abs() < 1e-6, "{value} for {expected}");
    }

    #[test]
    fn the_first_of_equally_good_ones_is_chosen() {
        assert_eq!(least(&[3.0, 1.0, 1.0, f64::NAN], 5), (1.0, 6));
        assert_eq!(least(&[f64::NAN], 2).1, 2);
    }
}
