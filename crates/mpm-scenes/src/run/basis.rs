//! What energies need to know of the background basis.

use mpm_core::{Basis, SplineGrid};
use mpm_kernels::{SecondMoment, Spline};

/// D_p = Σ_i w_ip (x_i − x_p)(x_i − x_p)ᵀ, which is diagonal, of a tensor-product basis.
pub(super) trait SecondMoments<const D: usize>: Basis<D> {
    /// The diagonal of D_p for a particle at x.
    fn second_moments(&self, x: &[f64; D]) -> [f64; D];
}

impl<S: Spline<W>, const W: usize, const D: usize> SecondMoments<D> for SplineGrid<S, W, D> {
    /// The same everywhere for smooth splines; of hat functions (x − x_i)(x_{i+1} − x) between the nodes on both sides.
    fn second_moments(&self, x: &[f64; D]) -> [f64; D] {
        let h = self.spacing();
        match S::SECOND_MOMENT {
            SecondMoment::Constant(moment) => [moment * h * h; D],
            SecondMoment::Gradient | SecondMoment::Varies => {
                let mut moments = [0.0; D];
                self.for_each_node(0, x, |_, entry| {
                    for a in 0..D {
                        moments[a] += entry.weight * entry.offset[a] * entry.offset[a];
                    }
                });
                moments
            }
        }
    }
}
