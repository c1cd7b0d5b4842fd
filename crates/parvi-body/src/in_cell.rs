//! The transfers beside PIC as one, told apart at run time: their step is compiled once.

use mpm_core::{Flip, FlipNode, Transfer};

use crate::choices::TransferChoice;

/// Affine FLIP, of which FLIP is B_p = 0, APIC a share of 0, and PIC both.
#[derive(Clone, Copy)]
pub(crate) struct InCell {
    flip: Flip,
    affine: bool,
}

impl InCell {
    /// The transfer of that name.
    pub fn new(choice: TransferChoice) -> Self {
        let (affine, share) = match choice {
            TransferChoice::Pic => (false, 0.0),
            TransferChoice::Apic => (true, 0.0),
            TransferChoice::Flip(share) => (false, share),
            TransferChoice::AffineFlip(share) => (true, share),
        };
        Self {
            flip: Flip::blend(share),
            affine,
        }
    }
}

impl<const D: usize> Transfer<D> for InCell {
    type Node = FlipNode<D>;
    const AFFINE: bool = true;
    const INCREMENTAL: bool = true;

    #[inline(always)]
    fn takes_moments(&self) -> bool {
        self.affine
    }

    #[inline(always)]
    fn particle_velocity(&self, interpolated: &[f64; D], change: &[f64; D], own: &[f64; D], damping: f64) -> [f64; D] {
        self.flip.particle_velocity(interpolated, change, own, damping)
    }
}
