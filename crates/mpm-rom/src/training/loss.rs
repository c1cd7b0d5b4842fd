//! Chen et al. 2023, Eq. 31, and its reverse pass.

use serde::{Deserialize, Serialize};

use crate::encoder::{Encoder, EncoderTape};
use crate::manifold::Network;
use crate::manifold::network::{CHUNK, SeedAdjoint, Tape};
use crate::snapshots::{Frame, Run};

/// The three terms of the loss, weights included.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Terms {
    /// |g̃ − φ|² / ℓ².
    pub position: f64,
    /// λ_F ‖∇_X g̃ − F‖².
    pub gradient: f64,
    /// λ_v |∂g̃/∂x̂ (x̂(t_{n+1}) − x̂(t_n)) / (t_{n+1} − t_n) − v|² / ℓ² (s⁻² dropped).
    pub velocity: f64,
}

impl Terms {
    /// The loss.
    pub fn total(&self) -> f64 {
        self.position + self.gradient + self.velocity
    }

    /// Adds a share of other terms.
    pub(super) fn add(&mut self, share: f64, other: &Self) {
        self.position += share * other.position;
        self.gradient += share * other.gradient;
        self.velocity += share * other.velocity;
    }
}

/// What the loss of a batch depends on beside the parameters and the samples.
#[derive(Clone, Copy, Debug)]
pub(super) struct Weights {
    /// λ_F.
    pub gradient: f64,
    /// λ_v.
    pub velocity: f64,
    /// 1 / (pairs × points of a pair) of the batch.
    pub share: f64,
}

/// Loss and adjoints of pairs (run, frame), with the buffers to compute them.
#[derive(Clone, Debug)]
pub(super) struct PairLoss<const D: usize> {
    pub terms: Terms,
    /// Adjoints of the network's parameters.
    pub network: Vec<f64>,
    /// Adjoints of the encoder's parameters.
    pub encoder: Vec<f64>,
    tape: Tape,
    now: EncoderTape,
    next: EncoderTape,
    reference: Vec<[f64; D]>,
}

impl<const D: usize> PairLoss<D> {
    pub fn new(network: &Network<D>, encoder: &Encoder<D>) -> Self {
        Self {
            terms: Terms::default(),
            network: vec![0.0; network.parameters().len()],
            encoder: vec![0.0; encoder.parameters().len()],
            tape: Tape::default(),
            now: EncoderTape::default(),
            next: EncoderTape::default(),
            reference: Vec::new(),
        }
    }

    /// Terms and adjoints of no frame.
    pub fn clear(&mut self) {
        self.terms = Terms::default();
        self.network.fill(0.0);
        self.encoder.fill(0.0);
    }

    /// Adds terms and adjoints of frame `number` at the points `chosen`:
    ///
    /// share Σ_p |g̃ − φ|² / ℓ² + λ_F ‖∇_X g̃ − F‖² + λ_v |∂g̃/∂x̂ w − v|² / ℓ², x̂ = e(φ(t_n)), w = (e(φ(t_{n+1})) − x̂) / (t_{n+1} − t_n).
    ///
    /// The last frame of a run has no t_{n+1} and no third term. Terms without weight are not computed.
    pub fn add(
        &mut self,
        (network, encoder): (&Network<D>, &Encoder<D>),
        weights: &Weights,
        reference: &[[f64; D]],
        run: &Run<D>,
        number: usize,
        chosen: &[usize],
    ) {
        let frame = &run.frames[number];
        encoder.forward(&frame.positions, &mut self.now);
        let next = run.frames.get(number + 1).filter(|_| weights.velocity > 0.0);
        if let Some(next) = next {
            encoder.forward(&next.positions, &mut self.next);
        }
        let next = next.map(|next| next.time - frame.time);
        let now = self.now.latent.clone();
        let rates = next.map(|interval| {
            let pairs = self.next.latent.iter().zip(&now);
            pairs.map(|(next, now)| (next - now) / interval).collect::<Vec<f64>>()
        });
        let motion = (&now[..], rates.as_deref());
        let (mut latent, mut along) = self.add_at(network, weights, reference, frame, motion, chosen);
        if let Some(interval) = next {
            for (latent, along) in latent.iter_mut().zip(&mut along) {
                *along /= interval;
                *latent -= *along;
            }
            encoder.reverse(&self.next, &along, &mut self.encoder);
        }
        encoder.reverse(&self.now, &latent, &mut self.encoder);
    }

    /// The same for given x̂ and, unless it is the last frame of a run, w: no encoder has a part in it. Returns the adjoints of x̂ and w.
    fn add_at(
        &mut self,
        network: &Network<D>,
        weights: &Weights,
        reference: &[[f64; D]],
        frame: &Frame<D>,
        (latent, direction): (&[f64], Option<&[f64]>),
        chosen: &[usize],
    ) -> (Vec<f64>, Vec<f64>) {
        let gradients = weights.gradient > 0.0;
        let seed = network.seed(latent, gradients, direction.into_iter());
        let mut adjoint = SeedAdjoint::zero(&seed);
        for chunk in chosen.chunks(CHUNK) {
            self.reference.clear();
            self.reference.extend(chunk.iter().map(|&point| reference[point]));
            network.forward(&self.reference, &seed, &mut self.tape);
            self.residuals(network, weights, frame, chunk, direction.is_some());
            network.reverse(&self.reference, &mut self.tape, &mut self.network, &mut adjoint);
        }
        network.reverse_seed(&adjoint, gradients, latent, direction, &mut self.network)
    }

    /// Adds the terms of a chunk and overwrites the tape's output with its adjoint.
    fn residuals(&mut self, network: &Network<D>, weights: &Weights, frame: &Frame<D>, chunk: &[usize], moving: bool) {
        let scaling = network.scaling();
        let length = scaling.length().powi(2);
        let gradients = weights.gradient > 0.0;
        let velocity = if gradients { 1 + D } else { 1 };
        for c in 0..D {
            let (mean, deviation) = (scaling.mean[c], scaling.deviation[c]);
            // y → residual r = mean + deviation y − target; y̅ = 2 weight share deviation r; returns Σ weight share r².
            let term = |block: &mut [f64], mean: f64, weight: f64, target: &dyn Fn(usize) -> f64| {
                let weight = weight * weights.share;
                let mut sum = 0.0;
                block[chunk.len()..].fill(0.0);
                for (y, &point) in block.iter_mut().zip(chunk) {
                    let residual = mean + deviation * *y - target(point);
                    sum += residual * residual;
                    *y = 2.0 * weight * deviation * residual;
                }
                weight * sum
            };
            let tape = &mut self.tape;
            self.terms.position += term(tape.output_mut(c, 0), mean, 1.0 / length, &|p| frame.positions[p][c]);
            for k in 0..if gradients { D } else { 0 } {
                let target = |p: usize| frame.deformation_gradients[p].0[c][k];
                self.terms.gradient += term(tape.output_mut(c, 1 + k), 0.0, weights.gradient, &target);
            }
            if moving {
                let target = |p: usize| frame.velocities[p][c];
                self.terms.velocity += term(tape.output_mut(c, velocity), 0.0, weights.velocity / length, &target);
            }
        }
    }
}

#[cfg(test)]
mod tests;
