//! Shape functions of UMLS-MPM: moving least squares over the first ring of a particle's cell.

mod definite;
mod fit;
mod positive;
mod ring_lanes;
mod spline;

use mpm_kernels::{LANES, Lanes};

pub(crate) use fit::Fit;
pub(crate) use positive::Floor;
pub(crate) use ring_lanes::RingLanes;

/// How the nodes of a first ring are weighted in the least squares fit of a particle (Cao et al. 2024, §2.3).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SampleWeight {
    /// d′_pi = η_pi N₂(‖x_i − x_p‖ / h) with η_pi = Σ_{n ∈ N⁰_p} b_pn A_in: a node that only some vertices of the cell are joined
    /// to counts the less, the closer the particle is to the others. Weights and gradients are continuous across faces.
    #[default]
    Continuous,
    /// d′_pi = N₂(‖x_i − x_p‖ / h). The ring changes from cell to cell and the weights jump: a control, for tests and figures.
    DistanceAlone,
    /// d′_pi = N₂(‖x_i − x_p‖ / h) for the D + 1 vertices of the particle's cell and 0 for all others. A fit of as many nodes as it has
    /// coefficients interpolates: weights are the barycentric coordinates and gradients theirs, the piecewise linear functions of the finite element method,
    /// whose gradients jump at faces. A control: what UMLS-MPM improves on.
    CellAlone,
}

/// 1, D and D (D + 1) / 2 sums for D = 3.
const LARGEST_COUNT: usize = 10;

/// Sums over a ring, one after the other: Σ d′, Σ d′ r, and the lower triangle of Σ d′ r rᵀ by rows.
type Sums = [Lanes; LARGEST_COUNT];

/// The sum over the lanes of each of four rows.
#[inline(always)]
pub(crate) fn sums(rows: &[Lanes; LANES]) -> Lanes {
    let [a, b, c, d] = Lanes::transpose(*rows);
    (a + b) + (c + d)
}
