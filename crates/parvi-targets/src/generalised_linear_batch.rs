//! The log posterior of a regression and its score for many particles at once, as matrix products.
//!
//! Particles are taken in groups of [`GROUP`], rows of data in blocks of [`BLOCK`], so the predictors in flight fill
//! 64 KiB whatever the sizes of batch and data. With B the group's coefficients (GROUP × D) and X the signed rows of a
//! block: predictors T = B Xᵀ, slopes W = ℓ′(T), scores += W X. A group that is not full is padded: every matrix
//! product has the same shape for every particle, each entry is summed in the order of the rows, and so a particle's
//! result depends neither on its neighbours nor on the number of threads.

use faer::linalg::matmul::matmul;
use faer::{Accum, MatMut, MatRef, Par};
use rayon::prelude::*;

use crate::Link;
use crate::generalised_linear::Posterior;
use crate::link::PARTICLES_PER_GROUP as GROUP;

/// Rows in a block.
const BLOCK: usize = 128;

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
        matmul(
            MatMut::from_column_major_slice_mut(predictors, GROUP, rows.len()),
            Accum::Replace,
            MatRef::from_column_major_slice(&self.coefficients, GROUP, D),
            MatRef::from_column_major_slice(rows.as_flattened(), D, rows.len()),
            1.0,
            Par::Seq,
        );
        predictors
    }
}

/// `out[p]` = Σ_i b_i ℓ′(t_ip) x_i + Σ_i a_i x_i − precision ∘ β_p.
pub(crate) fn scores<L: Link, const D: usize>(posterior: &Posterior<L, D>, xs: &[[f64; D]], out: &mut [[f64; D]]) {
    let groups = xs.par_chunks(GROUP).zip(out.par_chunks_mut(GROUP));
    groups.for_each_init(Buffers::new::<D>, |buffers, (xs, out)| {
        buffers.load(xs);
        buffers.scores.fill(0.0);
        for rows in posterior.rows.chunks(BLOCK) {
            L::slopes(buffers.predictors_of(rows));
            matmul(
                MatMut::from_column_major_slice_mut(&mut buffers.scores, GROUP, D),
                Accum::Add,
                MatRef::from_column_major_slice(&buffers.predictors[..GROUP * rows.len()], GROUP, rows.len()),
                MatRef::from_row_major_slice(rows.as_flattened(), rows.len(), D),
                1.0,
                Par::Seq,
            );
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
    let groups = xs.par_chunks(GROUP).zip(out.par_chunks_mut(GROUP));
    groups.for_each_init(Buffers::new::<D>, |buffers, (xs, out)| {
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
