//! The log posterior of a regression and its score for many particles at once, as matrix products.
//!
//! Particles are taken in groups of [`GROUP`], rows of data in blocks of [`BLOCK`], so the predictors in flight fill
//! 64 KiB whatever the sizes of batch and data. With B the group's coefficients (GROUP × D) and X the signed rows of a
//! block: predictors T = B Xᵀ, slopes W = ℓ′(T), scores += W X. A group that is not full is padded: products are those
//! of every particle, each entry is summed in the order of the rows, and so a particle's result depends neither on its neighbours nor on the number of threads.

use mpm_parallel::each;

use crate::Link;
use crate::exponential::with_widest_vectors;
use crate::link::{PARTICLES_PER_GROUP as GROUP, slopes};
use crate::posterior::Posterior;

/// Rows in a block.
const BLOCK: usize = 128;

/// Particles of a group whose coefficients stay in registers while rows go by.
const LANE: usize = 8;

/// Rows that are summed before their sum is added to the others': fewer in D = 1, where a sum of thousands of terms of one sign is all
/// there is.
pub(crate) const fn summed_together<const D: usize>() -> usize {
    if D == 1 { 16 } else { BLOCK }
}

/// What a thread needs for one group.
struct Buffers {
    /// GROUP × D, column by column.
    coefficients: Vec<f64>,
    /// GROUP × BLOCK, column by column: the predictors, then functions of them.
    predictors: Vec<f64>,
    /// GROUP × D, column by column.
    scores: Vec<f64>,
}

impl Buffers {
    fn new<const D: usize>() -> Self {
        Self {
            coefficients: vec![0.0; GROUP * D],
            predictors: vec![0.0; GROUP * BLOCK],
            scores: vec![0.0; GROUP * D],
        }
    }

    /// The group's coefficients, zeros where it is not full.
    fn load<const D: usize>(&mut self, xs: &[[f64; D]]) {
        self.coefficients.fill(0.0);
        for (particle, x) in xs.iter().enumerate() {
            for axis in 0..D {
                self.coefficients[axis * GROUP + particle] = x[axis];
            }
        }
    }

    /// The predictors of a block of rows: GROUP × rows, column by column.
    fn predictors_of<const D: usize>(&mut self, rows: &[[f64; D]]) -> &mut [f64] {
        let predictors = &mut self.predictors[..GROUP * rows.len()];
        let coefficients = &self.coefficients;
        with_widest_vectors(
            #[inline(always)]
            || {
                for first in (0..GROUP).step_by(LANE) {
                    let own: [[f64; LANE]; D] =
                        std::array::from_fn(|axis| std::array::from_fn(|l| coefficients[axis * GROUP + first + l]));
                    for (row, predictors) in rows.iter().zip(predictors.chunks_exact_mut(GROUP)) {
                        let mut sum = own[0].map(|c| c * row[0]);
                        for axis in 1..D {
                            for l in 0..LANE {
                                sum[l] = own[axis][l].mul_add(row[axis], sum[l]);
                            }
                        }
                        predictors[first..first + LANE].copy_from_slice(&sum);
                    }
                }
            },
        );
        predictors
    }

    /// scores += W X, where W are the slopes that stand in the place of the predictors.
    fn add_scores<const D: usize>(&mut self, rows: &[[f64; D]]) {
        let (slopes, scores) = (&self.predictors, &mut self.scores);
        with_widest_vectors(
            #[inline(always)]
            || {
                for first in (0..GROUP).step_by(LANE) {
                    let pieces = rows.chunks(summed_together::<D>());
                    for (rows, slopes) in pieces.zip(slopes.chunks(GROUP * summed_together::<D>())) {
                        let mut sums = [[0.0; LANE]; D];
                        for (row, slopes) in rows.iter().zip(slopes.chunks_exact(GROUP)) {
                            let slopes = &slopes[first..first + LANE];
                            for axis in 0..D {
                                for l in 0..LANE {
                                    sums[axis][l] = slopes[l].mul_add(row[axis], sums[axis][l]);
                                }
                            }
                        }
                        for axis in 0..D {
                            for l in 0..LANE {
                                scores[axis * GROUP + first + l] += sums[axis][l];
                            }
                        }
                    }
                }
            },
        );
    }
}

/// `out[p]` = Σ_i b_i ℓ′(t_ip) x_i + Σ_i a_i x_i − precision ∘ β_p.
pub(crate) fn scores<L: Link, const D: usize>(posterior: &Posterior<L, D>, xs: &[[f64; D]], out: &mut [[f64; D]]) {
    let groups = xs.chunks(GROUP).zip(out.chunks_mut(GROUP));
    each(groups, &|(xs, out): (&[[f64; D]], &mut [[f64; D]])| {
        let mut buffers = Buffers::new::<D>();
        buffers.load(xs);
        for rows in posterior.rows.chunks(BLOCK) {
            slopes::<L>(buffers.predictors_of(rows));
            buffers.add_scores(rows);
        }
        for (particle, (x, score)) in xs.iter().zip(out).enumerate() {
            for axis in 0..D {
                let pull = posterior.linear[axis] - posterior.precision[axis] * x[axis];
                score[axis] = buffers.scores[axis * GROUP + particle] + pull;
            }
        }
    });
}

/// `out[p]` = Σ_i ℓ(t_ip) + (what does not need the rows).
pub(crate) fn log_densities<L: Link, const D: usize>(posterior: &Posterior<L, D>, xs: &[[f64; D]], out: &mut [f64]) {
    let groups = xs.chunks(GROUP).zip(out.chunks_mut(GROUP));
    each(groups, &|(xs, out): (&[[f64; D]], &mut [f64])| {
        let mut buffers = Buffers::new::<D>();
        buffers.load(xs);
        let mut sums = [0.0; GROUP];
        for rows in posterior.rows.chunks(BLOCK) {
            let predictors: &[f64] = buffers.predictors_of(rows);
            L::add_log_likelihoods(predictors.as_chunks::<GROUP>().0, &mut sums);
        }
        for ((x, out), sum) in xs.iter().zip(out).zip(sums) {
            *out = sum + posterior.without_rows(x);
        }
    });
}
