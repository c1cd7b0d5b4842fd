//! E‖Z‖ for a Gaussian Z by one integral that many means share.

use crate::lanes::{LANES, Lanes, one_minus_negative_exponential, reduce};

/// Step of the trapezoidal rule in u = log t. The integrand is analytic and bounded for |Im u| < π/2, so the rule is
/// wrong by e^{−π²/h} = 1e-16.
const STEP: f64 = 0.27;

/// The left end has t · E‖Z‖² = e^{−11}: three terms of the series there leave 1e-17.
const LEFT_MARGIN: f64 = 11.0;

/// What φ may contribute beyond the right end, relative to the result.
const RIGHT_TAIL: f64 = 1e-17;

/// The longest table: eigenvalues 1e-300 and means 1e+150 apart still fit.
const MAXIMUM_NODES: usize = 1 << 13;

/// E‖Z‖ for Z ~ N(a, diag λ), for one λ and any number of means a with |a|² up to a bound, given as squares a_i².
///
/// With φ(t) = E e^{−t‖Z‖²} = Π_i (1 + 2tλ_i)^{−1/2} exp(−t a_i² / (1 + 2tλ_i)),
///
/// E‖Z‖ = 1/(2√π) ∫₀^∞ (1 − φ(t)) t^{−3/2} dt = 1/(2√π) ∫ (1 − φ(e^u)) e^{−u/2} du,
///
/// by the trapezoidal rule in u, which converges exponentially in 1/h. Its sums beyond the two ends are geometric
/// series: at the left of 1 − φ = c₁t − c₂t² + c₃t³, at the right of 1 − φ = 1. The nodes and everything that
/// depends on λ alone are tabulated; a mean costs one exponential per node (70 to 260), four at a time.
pub(crate) struct NormExpectation<const D: usize> {
    eigenvalues: [f64; D],
    nodes: Vec<Node<D>>,
    /// The largest E‖Z‖².
    bound: f64,
    /// Σ over the nodes at the left, of e^{u/2}, e^{3u/2} and e^{5u/2}, in units of the first three powers of 1 / `bound`.
    left: [f64; 3],
    /// Σ over the nodes at the right, of e^{−u/2}.
    right: f64,
}

/// Four nodes: h e^{−u/2} / 2√π, ½ Σ_i log(1 + 2tλ_i) and t / (1 + 2tλ_i).
struct Node<const D: usize> {
    weight: Lanes,
    logarithm: Lanes,
    slope: [Lanes; D],
}

impl<const D: usize> NormExpectation<D> {
    /// The table for eigenvalues λ_i > 0 and means of squared length at most `largest_square`.
    ///
    /// `None` if the range is empty or too long, which takes values that are not finite or not positive.
    pub(crate) fn new(eigenvalues: [f64; D], largest_square: f64) -> Option<Self> {
        let largest = eigenvalues.iter().fold(0.0, |a: f64, b| a.max(*b));
        let bound = largest_square + eigenvalues.iter().sum::<f64>();
        let start = -bound.ln() - LEFT_MARGIN;
        if !start.is_finite() || !eigenvalues.iter().all(|value| *value > 0.0) {
            return None;
        }
        let scale = STEP / (2.0 * std::f64::consts::PI.sqrt());
        let half_logarithm = |t: f64| 0.5 * eigenvalues.iter().map(|value| (2.0 * t * value).ln_1p()).sum::<f64>();
        let tolerance = (RIGHT_TAIL * largest.sqrt()).ln();
        let position = |node: usize| start + node as f64 * STEP;
        let is_last = |node: &usize| -half_logarithm(position(*node).exp()) - 0.5 * position(*node) < tolerance;
        let count = (1..MAXIMUM_NODES).find(is_last)?.next_multiple_of(LANES);
        let nodes = (0..count / LANES)
            .map(|group| {
                let u: Lanes = std::array::from_fn(|lane| position(group * LANES + lane));
                let t = u.map(f64::exp);
                Node {
                    weight: u.map(|u| scale * (-0.5 * u).exp()),
                    logarithm: t.map(half_logarithm),
                    slope: std::array::from_fn(|axis| t.map(|t| t / (1.0 + 2.0 * t * eigenvalues[axis]))),
                }
            })
            .collect();
        // Σ_{k ≥ 1} e^{p (u₀ − k h)} = e^{p u₀} / (e^{p h} − 1).
        let left = [1.0, 2.0, 3.0]
            .map(|order: f64| scale * (-0.5 * start - order * LEFT_MARGIN).exp() / ((order - 0.5) * STEP).exp_m1());
        let right = scale * (-0.5 * position(count - 1)).exp() / (0.5 * STEP).exp_m1();
        Some(Self {
            eigenvalues,
            nodes,
            bound,
            left,
            right,
        })
    }

    /// E‖Z‖ for the mean whose squared components in the eigenbasis are `squares`; at most 1e-15 or so off, relatively.
    pub(crate) fn evaluate(&self, squares: &[f64; D]) -> f64 {
        let mut total = [0.0; LANES];
        for node in &self.nodes {
            let mut exponent = node.logarithm;
            for axis in 0..D {
                for lane in 0..LANES {
                    exponent[lane] += squares[axis] * node.slope[axis][lane];
                }
            }
            let complement = one_minus_negative_exponential(&exponent);
            for lane in 0..LANES {
                total[lane] += node.weight[lane] * complement[lane];
            }
        }
        // −log φ = k₁t − k₂t² + k₃t³ − …, t in units of 1 / `bound`: cubes of large variances would overflow.
        let (mut k1, mut k2, mut k3) = (0.0, 0.0, 0.0);
        for (value, square) in self.eigenvalues.iter().zip(squares) {
            let (value, square) = (value / self.bound, square / self.bound);
            k1 += value + square;
            k2 += value * (value + 2.0 * square);
            k3 += value * value * (4.0 / 3.0 * value + 4.0 * square);
        }
        let series = [k1, -(k2 + 0.5 * k1 * k1), k3 + k1 * k2 + k1 * k1 * k1 / 6.0];
        let left = self.left[2] * series[2] + self.left[1] * series[1] + self.left[0] * series[0];
        reduce(&total) + (left + self.right)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_1_SQRT_2, FRAC_2_SQRT_PI, PI};

    /// erf(x), x ≥ 0, to rounding: the series of positive terms 2/√π e^{−x²} Σ_n 2ⁿ x^{2n+1} / (2n+1)!!.
    fn erf(x: f64) -> f64 {
        if x > 6.0 {
            return 1.0;
        }
        let (mut term, mut sum) = (x, x);
        for n in 1..200 {
            term *= 2.0 * x * x / (2.0 * f64::from(n) + 1.0);
            sum += term;
        }
        FRAC_2_SQRT_PI * (-x * x).exp() * sum
    }

    /// E|N(m, s²)|, the mean of the folded normal distribution (Leone, Nelson, Nottingham 1961).
    fn folded(m: f64, s: f64) -> f64 {
        s * (2.0 / PI).sqrt() * (-0.5 * (m / s).powi(2)).exp() + m * erf(m / s * FRAC_1_SQRT_2)
    }

    #[test]
    fn one_dimension_is_the_folded_normal() {
        for scale in [1e-140, 1e-6, 0.3, 1.0, 1e4, 1e140] {
            for bound in [1.0, 30.0, 1e6] {
                let table = NormExpectation::new([scale * scale], (bound * scale) * (bound * scale)).unwrap();
                for m in [0.0, 1e-8, 0.1, 0.5, 1.0, 2.0, 3.5, 6.0, 10.0, 29.0, 1e3, 9e5] {
                    if m <= bound {
                        let value = table.evaluate(&[(m * scale) * (m * scale)]);
                        let expected = folded(m * scale, scale);
                        assert!(
                            (value / expected - 1.0).abs() < 4e-15,
                            "{scale} {bound} {m}: {value} {expected}"
                        );
                    }
                }
            }
        }
    }

    /// E‖N(0, I)‖ = √2 Γ((d+1)/2) / Γ(d/2), by its recurrence from d to d + 2.
    fn isotropic<const D: usize>() {
        let start = if !D.is_multiple_of(2) {
            (2.0 / PI).sqrt()
        } else {
            (PI / 2.0).sqrt()
        };
        let expected = (1..D)
            .filter(|d| (D - d).is_multiple_of(2))
            .fold(start, |value, d| value * (d as f64 + 1.0) / d as f64);
        for bound in [0.0, 10.0, 1e8] {
            let table = NormExpectation::new([1.0; D], bound).unwrap();
            let value = table.evaluate(&[0.0; D]);
            assert!((value / expected - 1.0).abs() < 4e-15, "{D}: {value} {expected}");
            let nodes = LANES * table.nodes.len();
            assert!((70..=260).contains(&nodes), "{D}: {nodes}");
        }
    }

    #[test]
    fn isotropic_gaussians_have_the_mean_of_the_chi_distribution() {
        mpm_tensor::in_dimensions!(isotropic(), 1, 2, 3, 4, 6, 8);
    }

    /// In three dimensions E‖N(a, I)‖ = √(2/π) e^{−r²/2} + (r + 1/r) erf(r/√2), r = ‖a‖.
    #[test]
    fn a_shifted_gaussian_in_space() {
        let table = NormExpectation::new([1.0; 3], 1e4).unwrap();
        for r in [0.01_f64, 0.3, 1.0, 2.5, 7.0, 40.0, 99.0] {
            let expected = (2.0 / PI).sqrt() * (-0.5 * r * r).exp() + (r + 1.0 / r) * erf(r * FRAC_1_SQRT_2);
            let value = table.evaluate(&[0.36 * r * r, 0.0, 0.64 * r * r]);
            assert!((value / expected - 1.0).abs() < 1e-14, "{r}: {value} {expected}");
        }
    }

    /// Eigenvalues twelve orders apart: the small one may be left out up to its own size.
    #[test]
    fn a_nearly_singular_covariance() {
        for small in [1e-12, 1e-30, 1e-300] {
            let table = NormExpectation::new([small, 1.0], 25.0).unwrap();
            for m in [0.0, 1.0, 4.0] {
                let value = table.evaluate(&[0.0, m * m]);
                assert!(
                    (value / folded(m, 1.0) - 1.0).abs() < 50.0 * small + 4e-15,
                    "{small} {m} {value}"
                );
            }
        }
    }

    /// The same integral with a finer step and a larger range: the tails and the step are chosen well.
    #[test]
    fn a_finer_rule_agrees() {
        let eigenvalues: [f64; 4] = [0.01, 0.5, 2.0, 30.0];
        let squares: [f64; 4] = [4.0, 0.0, 100.0, 2.5];
        let (step, mut expected) = (0.05, 0.0);
        for k in -1700..1700 {
            let t = (f64::from(k) * step).exp();
            let exponent: f64 = (0..4)
                .map(|i| 0.5 * (2.0 * t * eigenvalues[i]).ln_1p() + t * squares[i] / (1.0 + 2.0 * t * eigenvalues[i]))
                .sum();
            expected += -(-exponent).exp_m1() / t.sqrt() * step / (2.0 * PI.sqrt());
        }
        for bound in [106.5, 1e5] {
            let value = NormExpectation::new(eigenvalues, bound).unwrap().evaluate(&squares);
            assert!((value / expected - 1.0).abs() < 4e-15, "{value} {expected}");
        }
    }

    #[test]
    fn impossible_spectra_are_refused() {
        assert!(NormExpectation::new([0.0, 1.0], 1.0).is_none());
        assert!(NormExpectation::new([f64::NAN], 1.0).is_none());
        assert!(NormExpectation::new([1.0], f64::INFINITY).is_none());
    }
}
