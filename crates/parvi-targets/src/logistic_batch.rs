//! The log posterior of a logistic regression and its score for many particles at once, as matrix products.
//!
//! Particles are taken in groups of [`GROUP`], rows of data in blocks of [`BLOCK`], so the margins in flight fill
//! 64 KiB whatever the sizes of batch and data. With B the group's coefficients (GROUP × D) and X the signed rows of a
//! block: margins T = B Xᵀ, misses W = 1 / (1 + e^T), scores += W X. A group that is not full is padded: every matrix
//! product has the same shape for every particle, each entry is summed in the order of the rows, and so a particle's
//! result depends neither on its neighbours nor on the number of threads.

use faer::linalg::matmul::matmul;
use faer::{Accum, MatMut, MatRef, Par};
use rayon::prelude::*;

use crate::exponential::{exponential, with_widest_vectors};

/// Particles in a group.
pub(crate) const GROUP: usize = 64;

/// Rows in a block. A product of as many factors in (1, 2] is below 2¹²⁸.
const BLOCK: usize = 128;

/// What a thread needs for one group.
struct Buffers {
    /// GROUP × D, column by column.
    coefficients: Vec<f64>,
    /// GROUP × BLOCK, column by column: the margins, then functions of them.
    margins: Vec<f64>,
    /// GROUP × D, column by column.
    scores: Vec<f64>,
}

impl Buffers {
    fn new<const D: usize>() -> Self {
        Self {
            coefficients: vec![0.0; GROUP * D],
            margins: vec![0.0; GROUP * BLOCK],
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

    /// The margins of a block of rows: GROUP × rows, column by column.
    fn margins_of<const D: usize>(&mut self, rows: &[[f64; D]]) -> &mut [f64] {
        let margins = &mut self.margins[..GROUP * rows.len()];
        matmul(
            MatMut::from_column_major_slice_mut(margins, GROUP, rows.len()),
            Accum::Replace,
            MatRef::from_column_major_slice(&self.coefficients, GROUP, D),
            MatRef::from_column_major_slice(rows.as_flattened(), D, rows.len()),
            1.0,
            Par::Seq,
        );
        margins
    }
}

/// `out[p]` = Σ_i (2y_i − 1) x_i σ(−t_ip) − precision ∘ x_p.
pub(crate) fn scores<const D: usize>(
    signed_rows: &[[f64; D]],
    precision: &[f64; D],
    xs: &[[f64; D]],
    out: &mut [[f64; D]],
) {
    let groups = xs.par_chunks(GROUP).zip(out.par_chunks_mut(GROUP));
    groups.for_each_init(Buffers::new::<D>, |buffers, (xs, out)| {
        buffers.load(xs);
        buffers.scores.fill(0.0);
        for rows in signed_rows.chunks(BLOCK) {
            misses(buffers.margins_of(rows));
            matmul(
                MatMut::from_column_major_slice_mut(&mut buffers.scores, GROUP, D),
                Accum::Add,
                MatRef::from_column_major_slice(&buffers.margins[..GROUP * rows.len()], GROUP, rows.len()),
                MatRef::from_row_major_slice(rows.as_flattened(), rows.len(), D),
                1.0,
                Par::Seq,
            );
        }
        for (particle, (x, score)) in xs.iter().zip(out).enumerate() {
            for axis in 0..D {
                score[axis] = buffers.scores[axis * GROUP + particle] - precision[axis] * x[axis];
            }
        }
    });
}

/// `out[p]` = −Σ_i log(1 + e^−t_ip) − ½ Σ_k precision_k x_pk².
///
/// log(1 + e^−t) = max(−t, 0) + log(1 + e^−|t|), and the logarithm is taken once per block, of the product.
pub(crate) fn log_densities<const D: usize>(
    signed_rows: &[[f64; D]],
    precision: &[f64; D],
    xs: &[[f64; D]],
    out: &mut [f64],
) {
    let groups = xs.par_chunks(GROUP).zip(out.par_chunks_mut(GROUP));
    groups.for_each_init(Buffers::new::<D>, |buffers, (xs, out)| {
        buffers.load(xs);
        let mut losses = [0.0; GROUP];
        for rows in signed_rows.chunks(BLOCK) {
            let (hinges, products) = block_losses(buffers.margins_of(rows));
            for particle in 0..GROUP {
                losses[particle] += hinges[particle] + products[particle].ln();
            }
        }
        for ((x, out), loss) in xs.iter().zip(out).zip(losses) {
            let prior: f64 = (0..D).map(|axis| precision[axis] * x[axis] * x[axis]).sum();
            *out = -loss - 0.5 * prior;
        }
    });
}

/// t ↦ σ(−t) = 1 / (1 + eᵗ).
fn misses(margins: &mut [f64]) {
    with_widest_vectors(
        #[inline(always)]
        || {
            for t in margins {
                *t = 1.0 / (1.0 + exponential(*t));
            }
        },
    );
}

/// Per particle, over the block's rows: Σ max(−t, 0) and Π (1 + e^−|t|).
fn block_losses(margins: &[f64]) -> ([f64; GROUP], [f64; GROUP]) {
    with_widest_vectors(
        #[inline(always)]
        || {
            let (mut hinges, mut products) = ([0.0; GROUP], [1.0; GROUP]);
            for row in margins.as_chunks::<GROUP>().0 {
                for particle in 0..GROUP {
                    let t = row[particle];
                    hinges[particle] += if t < 0.0 { -t } else { 0.0 };
                    products[particle] *= 1.0 + exponential(-t.abs());
                }
            }
            (hinges, products)
        },
    )
}
