//! What a model loses of snapshots.

use mpm_tensor::vector;
use rayon::prelude::*;

use super::Model;
use crate::encoder::EncoderError;
use crate::least_squares::squared_distance;
use crate::manifold::{Evaluation, Manifold, Wanted};
use crate::snapshots::{Frame, Snapshots};

impl<const D: usize> Model<D> {
    /// What encoder and network lose of snapshots, in per cent: 100 √(Σ |g̃(X_p, e(φ)) − φ_p|² / Σ |φ_p|²) over all runs, frames and points, the origin at
    /// the body's centroid at rest.
    ///
    /// # Errors
    /// [`EncoderError::Points`] for snapshots of another body.
    pub fn reconstruction_error(&self, snapshots: &Snapshots<D>) -> Result<f64, EncoderError> {
        let sums = self.sums(snapshots, Wanted::default(), |at, frame| {
            let error = squared_distance(&at.positions, &frame.positions);
            [error, frame.positions.iter().map(vector::norm_squared).sum()]
        });
        sums.map(|[error, size]| 100.0 * (error / size).sqrt())
    }

    /// How far the deformation gradients of encoder and network are from those of snapshots: the root mean square of ‖∇_X g̃(X_p, e(φ)) − F_p‖ (Frobenius)
    /// over all runs, frames and points. The loss is taken at some of the points; where this is much more than its gradient term says, the network has learned these points and not the motion.
    ///
    /// # Errors
    /// As [`reconstruction_error`](Self::reconstruction_error).
    pub fn gradient_error(&self, snapshots: &Snapshots<D>) -> Result<f64, EncoderError> {
        let sums = self.sums(snapshots, Wanted::GRADIENTS, |at, frame| {
            let pairs = at.gradients.iter().zip(&frame.deformation_gradients);
            let error: f64 = pairs
                .map(|(&found, &expected)| (found - expected).frobenius_norm().powi(2))
                .sum();
            [error, frame.deformation_gradients.len() as f64]
        });
        sums.map(|[error, count]| (error / count).sqrt())
    }

    /// Sums over all frames of two numbers each, in the order of the frames.
    fn sums(
        &self,
        snapshots: &Snapshots<D>,
        wanted: Wanted,
        of_frame: impl Fn(&Evaluation<D>, &Frame<D>) -> [f64; 2] + Sync,
    ) -> Result<[f64; 2], EncoderError> {
        let frames: Vec<_> = snapshots.frames().collect();
        let parts = frames.par_iter().map_init(Evaluation::default, |at, frame| {
            let latent = self.encoder.encode(&frame.positions)?;
            self.network.evaluate(snapshots.reference(), &latent, wanted, at);
            Ok(of_frame(at, frame))
        });
        let parts = parts.collect::<Result<Vec<[f64; 2]>, EncoderError>>()?;
        Ok(parts.iter().fold([0.0; 2], |sum, part| vector::add(&sum, part)))
    }
}
