//! What an exploration begins with.

use parvi_targets::Frame;

use crate::mixture::Mixture;

/// What is known beforehand of a target, and how random numbers begin.
#[derive(Clone, Debug)]
pub struct Beginning<'a, const D: usize> {
    /// What is known of place and scale; scouts find what is off by powers of ten.
    pub frame: &'a Frame<D>,
    /// Proposals to begin with beside the scouts' (fits, particles).
    pub given: &'a [Mixture<D>],
    /// Values of the target that an earlier process with the same arguments had told its observer: they are used instead of evaluating it again, and the
    /// pool is the same to the bit. Up to 32 log densities and 32 scores of it, spread over all, are evaluated again all the same, and count as no
    /// evaluations: by these a tape of another target is known.
    pub tape: Vec<f64>,
    /// The same seed gives the same bits.
    pub seed: u64,
}

impl<'a, const D: usize> Beginning<'a, D> {
    /// In a frame, with nothing else known and seed 0.
    pub fn in_frame(frame: &'a Frame<D>) -> Self {
        Self {
            frame,
            given: &[],
            tape: Vec::new(),
            seed: 0,
        }
    }

    /// The same with another seed.
    pub fn with_seed(mut self, seed: u64) -> Self {
        self.seed = seed;
        self
    }

    /// The same with values of the target from an earlier process.
    pub fn with_tape(mut self, tape: Vec<f64>) -> Self {
        self.tape = tape;
        self
    }
}
