//! Shape functions of UMLS-MPM: moving least squares over the first ring of a particle's cell.

mod definite;
mod exact;
mod fit;
mod positive;
mod ring_lanes;
mod spline;

use mpm_kernels::{LANES, Lanes};

pub(crate) use exact::{Gradients, Slopes};
pub(crate) use fit::Fit;
pub(crate) use positive::Floor;
pub(crate) use ring_lanes::{RingLanes, SETS};

/// How the nodes of a first ring are weighted in the least squares fit of a particle (Cao et al. 2024, §2.3).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SampleWeight {
    /// d′_pi = η_pi N₂(‖x_i − x_p‖ / h) with η_pi = Σ_{n ∈ N⁰_p} b_pn A_in (Eq. 32), A_nn = 1, and N₂ as the closed forms of Appendix C have it: a node that only some vertices of the cell are joined
    /// to counts the less, the closer the particle is to the others. Weights and gradients are continuous across faces.
    #[default]
    Continuous,
    /// d′_pi = η̃_pi N₂(‖x_i − x_p‖ / h) with η̃ = η² (3 − 2η): nodes come and go with the slope zero, so that ∇ of the weight, too, is small where the weight is, and does not
    /// jump there. What [`Gradient::Exact`](crate::Gradient::Exact) asks for (ours).
    Smooth,
    /// d′_pi = N₂(‖x_i − x_p‖ / h). The ring changes from cell to cell and the weights jump: a control, for tests and figures.
    DistanceAlone,
    /// d′_pi = N₂(‖x_i − x_p‖ / h) for the D + 1 vertices of the particle's cell and 0 for all others. A fit of as many nodes as it has
    /// coefficients interpolates: weights are the barycentric coordinates and gradients theirs, the piecewise linear functions of the finite element method,
    /// whose gradients jump at faces. A control: what UMLS-MPM improves on.
    CellAlone,
}

impl SampleWeight {
    /// What a node counts by its η, and the derivative.
    #[inline(always)]
    pub(crate) fn share(self, eta: f64) -> (f64, f64) {
        match self {
            Self::Continuous if eta > 0.0 => (eta, 1.0),
            Self::Smooth if eta > 0.0 => {
                let eta = eta.min(1.0);
                (eta * eta * (3.0 - 2.0 * eta), 6.0 * eta * (1.0 - eta))
            }
            Self::Continuous | Self::Smooth => (0.0, 0.0),
            Self::DistanceAlone | Self::CellAlone => (1.0, 0.0),
        }
    }

    /// Whether η counts at all.
    #[inline(always)]
    pub(crate) fn diminishes(self) -> bool {
        matches!(self, Self::Continuous | Self::Smooth)
    }
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
