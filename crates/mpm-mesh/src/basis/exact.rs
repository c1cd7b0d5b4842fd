//! ∇w in the place of diffuse gradients.

use mpm_core::Member;
use mpm_kernels::{LANES, Lanes, NodeField};
use mpm_tensor::Matrix;

use super::cell_ring::CellRing;
use super::{Gradient, MeshBasis, ParticleFit};
use crate::kernel::{Floor, Gradients, RingLanes, SETS, Slopes, sums};

impl<const D: usize> MeshBasis<D> {
    /// Whether gradients are to be ∇w.
    pub(super) fn is_exact(&self) -> bool {
        self.gradient == Gradient::Exact
    }

    /// Whether they were at the last activation, which is what particles have.
    #[inline(always)]
    pub(super) fn has_gradients(&self) -> bool {
        !self.gradients.is_empty()
    }

    /// ∇w of a particle, in the groups of its ring; `None` where gradients are diffuse.
    #[inline(always)]
    pub(super) fn gradients_of(&self, particle: usize) -> Option<&[Gradients<D>]> {
        let samples = self.particles[particle].samples as usize;
        self.gradients.get(samples..).filter(|_| self.has_gradients())
    }

    /// ∇w of the particles at `points`, the last that were solved.
    pub(super) fn differentiate(
        &self,
        lanes: &RingLanes<D>,
        points: &[[f64; D]],
        (particles, floors): (&[ParticleFit<D>], &[Floor<D>]),
        samples: &[Lanes],
        gradients: &mut [Gradients<D>],
    ) {
        for (k, (x, ParticleFit { fit, cell, .. })) in points.iter().zip(particles).enumerate() {
            let floor = floors.get(k).copied().unwrap_or_else(|| Floor::none(fit));
            lanes.exact_gradients(k, &self.slopes(*cell, x), (fit, &floor), samples, gradients);
        }
    }

    /// How η and h vary at a point of a cell; as if they did not outside of it, where they are those of the nearest point.
    fn slopes(&self, cell: u32, x: &[f64; D]) -> Slopes<D> {
        let (mut slopes, barycentric) = (Slopes::NOTHING, self.search.barycentric(cell, x));
        if !self.search.is_inside(&barycentric) {
            return slopes;
        }
        let (frame, vertices) = (self.search.frame(cell), self.mesh().cell(cell as usize));
        let mut b = [0.0; LANES];
        b[0] = 1.0 - barycentric.iter().sum::<f64>();
        b[1..=D].copy_from_slice(&barycentric);
        for n in 0..=D {
            let gradient = frame.gradient(n);
            let width = self.widths.get(vertices[n] as usize).copied().unwrap_or(0.0);
            for a in 0..D {
                slopes.width[a] += width * gradient[a];
                for set in (0..SETS).filter(|set| set >> n & 1 == 1) {
                    slopes.shares[a][set] += gradient[a];
                }
            }
        }
        for set in 0..SETS {
            let eta = (0..=D).filter(|n| set >> n & 1 == 1).map(|n| b[n]).sum();
            let (_, slope) = self.weight.share(eta);
            for a in 0..D {
                slopes.shares[a][set] *= slope;
            }
        }
        slopes
    }

    /// Σ v ∇wᵀ.
    #[inline(always)]
    pub(super) fn gradient_in_lanes(&self, member: Member<CellRing<D>, D>, nodes: &impl NodeField<D>) -> Matrix<D> {
        let gradients = self.gradients_of(member.particle).unwrap_or_default();
        let mut columns = [[Lanes::ZERO; LANES]; D];
        let groups = gradients.iter().take(member.cell.groups().len());
        for (gradient, [_, v @ ..]) in groups.zip(nodes.by_fours()) {
            for a in 0..D {
                for c in 0..D {
                    columns[a][c] = gradient[a].mul_add(v[c], columns[a][c]);
                }
            }
        }
        let columns = columns.map(|column| sums(&column).to_array());
        Matrix::from_fn(|c, a| columns[a][c])
    }
}

/// What is done, in a function of its own: steps with diffuse gradients are no longer for it.
#[inline(never)]
pub(super) fn outlined<R>(work: impl FnOnce() -> R) -> R {
    work()
}

/// ∇w of the node at a place of the ring.
#[inline(always)]
pub(super) fn gradient_at<const D: usize>(gradients: &[Gradients<D>], index: usize) -> [f64; D] {
    gradients[index / LANES].map(|component| component.as_array()[index % LANES])
}
