use std::collections::HashMap;

use mpm_dense::{DenseMatrix, SingularValues};
use mpm_tensor::{Matrix, vector};

use super::{Evaluation, Manifold, Wanted};
use crate::nearest::nearest;
use crate::snapshots::Snapshots;

/// Proper orthogonal decomposition: g̃(X_p, x̂) = X_p + Σ_k x̂_k u_k(X_p) with the r modes u_k that reproduce the displacements of the snapshots best
/// in the mean square.
///
/// With the displacements of N frames as columns of S = U Σ Vᵀ, mode k is u_k = U_k σ_k / √N, so that its coordinate √N V_nk has mean square 1 over
/// the frames. The gradients at the material points are those of the snapshots with the same coordinates,
/// ∇u_k = N⁻¹ Σ_n √N V_nk (F_n − I); u_k itself obeys the same formula.
///
/// Modes are known at the material points only: any other reference position takes those of the nearest one.
#[derive(Clone, Debug, PartialEq)]
pub struct Pod<const D: usize> {
    coordinates: usize,
    reference: Vec<[f64; D]>,
    /// Number of the point at a position, by its bits.
    numbers: HashMap<[u64; D], usize>,
    /// u_k at point p: entry p r + k.
    modes: Vec<[f64; D]>,
    /// ∇u_k at point p: entry p r + k.
    gradients: Vec<Matrix<D>>,
}

/// Why there are no such modes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum LinearError {
    /// r is zero, or larger than the number of modes that the snapshots have (singular values above 10⁻¹² of the largest).
    #[error("the number of coordinates is {wanted}, the displacements of the snapshots have rank {rank}")]
    Rank {
        /// r.
        wanted: usize,
        /// The rank.
        rank: usize,
    },
    /// The decomposition did not converge.
    #[error("singular value decomposition failed")]
    Decomposition,
}

impl<const D: usize> Pod<D> {
    /// The r leading modes of all frames of all runs. Costs a thin singular value decomposition of P D × N.
    ///
    /// # Errors
    /// [`LinearError::Rank`], [`LinearError::Decomposition`].
    pub fn new(snapshots: &Snapshots<D>, coordinates: usize) -> Result<Self, LinearError> {
        let reference = snapshots.reference();
        let frames: Vec<_> = snapshots.frames().collect();
        let displacements = DenseMatrix::from_fn(reference.len() * D, frames.len(), |row, column| {
            frames[column].positions[row / D][row % D] - reference[row / D][row % D]
        });
        let decomposition = SingularValues::new(&displacements).ok_or(LinearError::Decomposition)?;
        let sizes = &decomposition.values;
        let largest = sizes.first().copied().unwrap_or(0.0);
        let rank = sizes.iter().filter(|&&size| size > 1e-12 * largest).count();
        if coordinates == 0 || coordinates > rank {
            return Err(LinearError::Rank {
                wanted: coordinates,
                rank,
            });
        }
        let count = frames.len() as f64;
        let mut modes = vec![[0.0; D]; reference.len() * coordinates];
        let mut gradients = vec![Matrix::ZERO; reference.len() * coordinates];
        for (number, frame) in frames.iter().enumerate() {
            for k in 0..coordinates {
                let share = decomposition.right[(number, k)] / count.sqrt();
                for (p, rest) in reference.iter().enumerate() {
                    let displacement = vector::subtract(&frame.positions[p], rest);
                    vector::accumulate(&mut modes[p * coordinates + k], share, &displacement);
                    gradients[p * coordinates + k] += (frame.deformation_gradients[p] - Matrix::IDENTITY) * share;
                }
            }
        }
        Ok(Self {
            coordinates,
            reference: reference.to_vec(),
            numbers: (reference.iter().map(|x| x.map(f64::to_bits)).zip(0..)).collect(),
            modes,
            gradients,
        })
    }

    /// u_k at point p, entry p r + k (m).
    pub fn modes(&self) -> &[[f64; D]] {
        &self.modes
    }
}

impl<const D: usize> Manifold<D> for Pod<D> {
    fn coordinates(&self) -> usize {
        self.coordinates
    }

    fn evaluate(&self, reference: &[[f64; D]], latent: &[f64], wanted: Wanted, out: &mut Evaluation<D>) {
        let r = self.coordinates;
        out.positions.clear();
        out.gradients.clear();
        out.jacobians.clear();
        for position in reference {
            let known = self.numbers.get(&position.map(f64::to_bits));
            let point = known.copied().unwrap_or_else(|| nearest(position, &self.reference));
            let range = point * r..(point + 1) * r;
            let mut deformed = *position;
            for (mode, x) in self.modes[range.clone()].iter().zip(latent) {
                vector::accumulate(&mut deformed, *x, mode);
            }
            out.positions.push(deformed);
            if wanted.gradients {
                let mut gradient = Matrix::IDENTITY;
                for (mode, x) in self.gradients[range.clone()].iter().zip(latent) {
                    gradient += *mode * *x;
                }
                out.gradients.push(gradient);
            }
            if wanted.jacobians {
                out.jacobians.extend_from_slice(&self.modes[range]);
            }
        }
    }
}
