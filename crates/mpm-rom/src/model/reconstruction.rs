use rayon::prelude::*;

use super::Model;
use crate::encoder::EncoderError;
use crate::manifold::{Evaluation, Manifold, Wanted};
use crate::snapshots::Snapshots;

impl<const D: usize> Model<D> {
    /// What encoder and network lose of snapshots, in per cent: 100 √(Σ |g̃(X_p, e(φ)) − φ_p|² / Σ |φ_p|²) over all runs, frames and points, the origin at
    /// the body's centroid at rest.
    ///
    /// # Errors
    /// [`EncoderError::Points`] for snapshots of another body.
    pub fn reconstruction_error(&self, snapshots: &Snapshots<D>) -> Result<f64, EncoderError> {
        let frames: Vec<_> = snapshots.runs().iter().flat_map(|run| &run.frames).collect();
        let sums = frames.par_iter().map_init(Evaluation::default, |out, frame| {
            let latent = self.encoder.encode(&frame.positions)?;
            self.network
                .evaluate(snapshots.reference(), &latent, Wanted::default(), out);
            let (mut error, mut size) = (0.0, 0.0);
            for (found, expected) in out.positions.iter().zip(&frame.positions) {
                for c in 0..D {
                    error += (found[c] - expected[c]).powi(2);
                    size += expected[c].powi(2);
                }
            }
            Ok((error, size))
        });
        let sums: Vec<(f64, f64)> = sums.collect::<Result<_, _>>()?;
        let (error, size) = sums
            .iter()
            .fold((0.0, 0.0), |sum, part| (sum.0 + part.0, sum.1 + part.1));
        Ok(100.0 * (error / size).sqrt())
    }
}
