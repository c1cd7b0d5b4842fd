//! What energies need to know of the background basis.

use mpm_core::{Basis, SplineGrid};
use mpm_kernels::{SecondMoment, Spline};
use mpm_mesh::MeshBasis;
use mpm_tensor::Matrix;

/// D_p = Σ_i w_ip (x_i − x_p)(x_i − x_p)ᵀ.
pub(super) trait SecondMoments<const D: usize>: Basis<D> {
    /// D_p⁻¹ for a particle at x; zero along directions without a moment, in which the affine part vanishes.
    fn inverse_moment(&self, x: &[f64; D]) -> Matrix<D>;
}

impl<S: Spline<W>, const W: usize, const D: usize> SecondMoments<D> for SplineGrid<S, W, D> {
    /// D_p is diagonal: the same everywhere for smooth splines; of hat functions (x − x_i)(x_{i+1} − x) between the nodes on both sides.
    fn inverse_moment(&self, x: &[f64; D]) -> Matrix<D> {
        let h = self.spacing();
        let moments = match S::SECOND_MOMENT {
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
        };
        Matrix::diagonal(&moments.map(|moment| if moment > 0.0 { 1.0 / moment } else { 0.0 }))
    }
}

impl<const D: usize> SecondMoments<D> for MeshBasis<D> {
    /// Negative weights may leave no inverse, or that of an indefinite D_p; B is then not used, and the energy of such a particle is left out.
    fn inverse_moment(&self, x: &[f64; D]) -> Matrix<D> {
        let mut moment = Matrix::ZERO;
        for weight in self.weights_at(x).unwrap_or_default() {
            let entry = weight.entry;
            moment += Matrix::outer(&entry.offset, &entry.offset) * entry.weight;
        }
        let inverse = moment.inverse().unwrap_or(Matrix::ZERO);
        let definite = (0..D).all(|a| inverse.0[a][a] > 0.0);
        if definite { inverse } else { Matrix::ZERO }
    }
}
