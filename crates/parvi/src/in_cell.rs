//! Transfers that share one step, compiled once for all of them and told apart at run time.

use mpm_core::{AffineFlip, Flip, FlipNode, Transfer, VelocityNode};

use crate::TransferChoice;

/// APIC, or PIC as APIC with B_p = 0: those of the paper's algorithms.
#[derive(Clone, Copy)]
pub(crate) struct InCell {
    /// Whether it is APIC.
    pub affine: bool,
}

impl<const D: usize> Transfer<D> for InCell {
    type Node = VelocityNode<D>;
    const AFFINE: bool = true;
    const INCREMENTAL: bool = false;

    #[inline(always)]
    fn takes_moments(&self) -> bool {
        self.affine
    }

    #[inline(always)]
    fn particle_velocity(&self, interpolated: &[f64; D], _: &[f64; D], _: &[f64; D], _: f64) -> [f64; D] {
        *interpolated
    }
}

/// Affine FLIP, of which FLIP is B_p = 0 and APIC a share of 0: what the calibrated sampler knows beside PIC.
#[derive(Clone, Copy)]
pub(crate) struct AffineOrFlip {
    transfer: AffineFlip,
    affine: bool,
}

impl AffineOrFlip {
    /// The transfer of that name.
    pub fn new(choice: TransferChoice) -> Self {
        let share = match choice {
            TransferChoice::Flip(share) => share,
            TransferChoice::Pic | TransferChoice::Apic => 0.0,
        };
        Self {
            transfer: AffineFlip(Flip::blend(share)),
            affine: choice == TransferChoice::Apic,
        }
    }
}

impl<const D: usize> Transfer<D> for AffineOrFlip {
    type Node = FlipNode<D>;
    const AFFINE: bool = true;
    const INCREMENTAL: bool = true;

    #[inline(always)]
    fn takes_moments(&self) -> bool {
        self.affine
    }

    #[inline(always)]
    fn particle_velocity(&self, interpolated: &[f64; D], change: &[f64; D], own: &[f64; D], damping: f64) -> [f64; D] {
        Transfer::<D>::particle_velocity(&self.transfer, interpolated, change, own, damping)
    }
}
