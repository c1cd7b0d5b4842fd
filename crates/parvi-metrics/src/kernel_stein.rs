//! The kernel Stein discrepancy: how far a cloud is from a density of which only the score is known.

use parvi_targets::{Target, scores_in_calls};

use crate::error::{finite, parameter};
use crate::lanes::{LANES, Lanes};
use crate::pair_sum::{Packed, PackedWeights, PairFunction, symmetric_sum};
use crate::summation::sum;
use crate::{Cloud, MetricError};

const NAME: &str = "the kernel Stein discrepancy";

/// The inverse multiquadric kernel k(x, y) = (c² + |x − y|²)^β, c > 0, −1 < β < 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InverseMultiquadric {
    offset: f64,
    exponent: f64,
}

impl Default for InverseMultiquadric {
    /// c = 1, β = −½, for targets of unit scale.
    fn default() -> Self {
        Self {
            offset: 1.0,
            exponent: -0.5,
        }
    }
}

impl InverseMultiquadric {
    /// The kernel with offset c (a length) and exponent β.
    ///
    /// # Errors
    /// [`MetricError::InvalidParameter`] unless 1e-150 < c < 1e150 and −1 < β < 0, where the discrepancy detects
    /// non-convergence (Gorham & Mackey 2017, Theorem 8).
    pub fn new(offset: f64, exponent: f64) -> Result<Self, MetricError> {
        let is_usable = offset > 1e-150 && offset < 1e150;
        parameter(
            "the offset of the kernel",
            offset,
            is_usable,
            "between 1e-150 and 1e150",
        )?;
        let detects = exponent > -1.0 && exponent < 0.0;
        parameter("the exponent of the kernel", exponent, detects, "between -1 and 0")?;
        Ok(Self { offset, exponent })
    }

    /// (q^β, 1/q) for q = c² + |x − y|².
    #[inline]
    fn power<const HALF: bool>(&self, q: f64) -> (f64, f64) {
        if HALF {
            let root = 1.0 / q.sqrt();
            (root, root * root)
        } else {
            (q.powf(self.exponent), 1.0 / q)
        }
    }
}

/// The squared kernel Stein discrepancy as V- and as U-statistic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteinDiscrepancy {
    /// Σ_ij w_i w_j u(x_i, x_j) ≥ 0: the squared discrepancy of the cloud as a measure of its own.
    pub squared: f64,
    /// Σ_{i≠j} w_i w_j u(x_i, x_j) / (1 − Σ w_i²): unbiased with mean 0 for independent draws from the target, so it
    /// may be negative. `None` if only one point has weight.
    pub unbiased_squared: Option<f64>,
}

impl SteinDiscrepancy {
    /// The discrepancy itself, the root of [`squared`](Self::squared).
    pub fn discrepancy(&self) -> f64 {
        self.squared.max(0.0).sqrt()
    }
}

/// What is compiled for a dimension.
struct Compiled<const D: usize> {
    /// The squared kernel Stein discrepancy.
    stein: fn(&Cloud<'_, D>, &[[f64; D]], &InverseMultiquadric) -> f64,
}

impl<const D: usize> Compiled<D> {
    const HERE: Self = Self { stein };
}

mpm_parallel::compiled_ahead!(Compiled);

/// The kernel Stein discrepancy of a cloud with the inverse multiquadric kernel, from the scores s_i = ∇ log p(x_i):
///
/// KSD² = Σ_ij w_i w_j u(x_i, x_j),
/// u(x, y) = k s_x·s_y + s_x·∇_y k + s_y·∇_x k + tr ∇_x ∇_yᵀ k
///         = k ( s_x·s_y + 2β/q [ (s_y − s_x)·(x − y) − d − 2(β − 1) |x − y|²/q ] ), q = c² + |x − y|².
///
/// `scores` has one score per point. The unit is that of s² k: choose coordinates in which the target has unit scale
/// ([`Standardiser`](crate::Standardiser)). O(M²), in parallel and independent of the number of threads.
///
/// Source: J. Gorham, L. Mackey, *Measuring sample quality with kernels*, ICML 2017, §3–4; Q. Liu, J. Lee,
/// M. Jordan, *A kernelized Stein discrepancy for goodness-of-fit tests*, ICML 2016, Theorem 3.6.
///
/// # Errors
/// [`MetricError::LengthMismatch`] unless there is one score per point, [`MetricError::NonFiniteScore`] for a NaN or
/// infinite score, [`MetricError::Overflow`] if a term exceeds the range of `f64`.
pub fn kernel_stein_discrepancy<const D: usize>(
    cloud: &Cloud<'_, D>,
    scores: &[[f64; D]],
    kernel: &InverseMultiquadric,
) -> Result<SteinDiscrepancy, MetricError> {
    if scores.len() != cloud.len() {
        return Err(MetricError::LengthMismatch {
            name: "scores",
            points: cloud.len(),
            given: scores.len(),
        });
    }
    for (index, score) in scores.iter().enumerate() {
        for (axis, &value) in score.iter().enumerate() {
            if !value.is_finite() {
                return Err(MetricError::NonFiniteScore { index, axis, value });
            }
        }
    }
    let squared = finite(NAME, (Compiled::of().stein)(cloud, scores, kernel))?;
    let (power, inverse) = kernel.power::<false>(kernel.offset * kernel.offset);
    let diagonal = sum(scores.iter().enumerate().map(|(index, score)| {
        let value = power * (mpm_tensor::vector::norm_squared(score) - 2.0 * kernel.exponent * D as f64 * inverse);
        cloud.weight(index) * cloud.weight(index) * value
    }));
    let unbiased_squared = cloud
        .distinct_pair_share(NAME)
        .ok()
        .map(|share| (squared - diagonal) / share);
    Ok(SteinDiscrepancy {
        squared,
        unbiased_squared,
    })
}

/// [`kernel_stein_discrepancy`] with the scores of a target.
///
/// # Errors
/// Those of [`kernel_stein_discrepancy`].
pub fn target_stein_discrepancy<const D: usize>(
    cloud: &Cloud<'_, D>,
    target: &(impl Target<D> + ?Sized),
    kernel: &InverseMultiquadric,
) -> Result<SteinDiscrepancy, MetricError> {
    let mut scores = vec![[0.0; D]; cloud.len()];
    scores_in_calls(target, cloud.points(), &mut scores);
    kernel_stein_discrepancy(cloud, &scores, kernel)
}

/// The squared discrepancy, with a root in place of the power where the exponent is −½.
fn stein<const D: usize>(cloud: &Cloud<'_, D>, scores: &[[f64; D]], kernel: &InverseMultiquadric) -> f64 {
    if kernel.exponent == -0.5 {
        stein_sum::<D, true>(cloud, scores, kernel)
    } else {
        stein_sum::<D, false>(cloud, scores, kernel)
    }
}

fn stein_sum<const D: usize, const HALF: bool>(
    cloud: &Cloud<'_, D>,
    scores: &[[f64; D]],
    kernel: &InverseMultiquadric,
) -> f64 {
    let function = SteinKernel::<D, HALF> {
        kernel: *kernel,
        points: cloud.points(),
        scores,
        packed_points: Packed::new(cloud.points()),
        packed_scores: Packed::new(scores),
    };
    symmetric_sum(&function, &PackedWeights::new(cloud))
}

/// u(x_i, x_j); `HALF` if β = −½, which needs a root instead of a power.
struct SteinKernel<'a, const D: usize, const HALF: bool> {
    kernel: InverseMultiquadric,
    points: &'a [[f64; D]],
    scores: &'a [[f64; D]],
    packed_points: Packed<D>,
    packed_scores: Packed<D>,
}

impl<const D: usize, const HALF: bool> PairFunction for SteinKernel<'_, D, HALF> {
    type Row = ([f64; D], [f64; D]);

    #[inline]
    fn row(&self, index: usize) -> Self::Row {
        (self.points[index], self.scores[index])
    }

    #[inline]
    fn evaluate(&self, (x, score): &Self::Row, group: usize) -> Lanes {
        let (points, scores) = (self.packed_points.group(group), self.packed_scores.group(group));
        let (mut squares, mut products, mut mixed) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
        for axis in 0..D {
            for lane in 0..LANES {
                let difference = x[axis] - points[axis][lane];
                squares[lane] += difference * difference;
                products[lane] += score[axis] * scores[axis][lane];
                mixed[lane] += (scores[axis][lane] - score[axis]) * difference;
            }
        }
        let beta = self.kernel.exponent;
        let offset = self.kernel.offset * self.kernel.offset;
        let mut values = [0.0; LANES];
        for lane in 0..LANES {
            let (power, inverse) = self.kernel.power::<HALF>(offset + squares[lane]);
            let bracket = mixed[lane] - D as f64 - 2.0 * (beta - 1.0) * squares[lane] * inverse;
            values[lane] = power * (products[lane] + 2.0 * beta * inverse * bracket);
        }
        values
    }
}
