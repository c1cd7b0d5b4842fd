use mpm_tensor::Matrix;

use super::{Flip, FlipNode, Transfer};
use crate::MpmError;

/// How B_p changes beside a v_p that changes as with [`Flip`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Moments {
    /// B_p = Σ_i w_ip v_iⁿ⁺¹ (x_i − x_p)ᵀ, as Fei et al. have it. Where particles run towards each other the nodes' gradients grow while v_p is kept, so that kinetic energy is made without a force.
    #[default]
    OfNodes,
    /// B_p ← (1−a) Σ_i w_ip v_iⁿ⁺¹ (x_i − x_p)ᵀ + a (B_p + Σ_i w_ip (v_iⁿ⁺¹ − v_iⁿ) (x_i − x_p)ᵀ), as v_p. With a = 1 particles gain no more kinetic energy than the nodes:
    /// Σ m_p (v_p·δv_p + ½ δv_p² + B_p D_p⁻¹ : δB_p + ½ δB_p D_p⁻¹ : δB_p) ≤ Σ m_i (v_iⁿ·δv_i + ½ δv_i²), since v_p and B_p send Σ m_i v_iⁿ·δv_i and a projection is no longer than what it is of (weights ≥ 0).
    Increments,
}

/// FLIP whose particles also carry B_p and send m_p w_ip (v_p + B_p D_p⁻¹ (x_i − x_p)), as with [`Apic`](crate::Apic); v_p changes as with [`Flip`].
///
/// A velocity that is linear in space arrives at the nodes as it is, which FLIP alone smoothes; and v_p keeps what APIC loses in every step. So neither
/// rotation nor shear is dissipated by the number of steps or by the spacing. Angular momentum is not conserved to rounding: what the nodes do not see of v_p has a
/// moment.
///
/// Source: AFLIP of Fei, Guo, Wu, Huang & Gao, *Revisiting integration in the material point method*, ACM Trans. Graph. 40 (2021).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AffineFlip {
    /// How v_p changes.
    pub flip: Flip,
    /// How B_p does.
    pub moments: Moments,
}

impl AffineFlip {
    /// That of Fei et al.: B_p is that of the nodes.
    pub const fn new(flip: Flip) -> Self {
        Self {
            flip,
            moments: Moments::OfNodes,
        }
    }
}

impl<const D: usize> Transfer<D> for AffineFlip {
    type Node = FlipNode<D>;
    const AFFINE: bool = true;
    const INCREMENTAL: bool = true;

    fn check(&self) -> Result<(), MpmError> {
        Transfer::<D>::check(&self.flip)
    }

    #[inline(always)]
    fn over(&self, time_step: f64) -> Self {
        let flip = Transfer::<D>::over(&self.flip, time_step);
        Self { flip, ..*self }
    }

    #[inline(always)]
    fn particle_velocity(&self, interpolated: &[f64; D], change: &[f64; D], own: &[f64; D], damping: f64) -> [f64; D] {
        self.flip.particle_velocity(interpolated, change, own, damping)
    }

    #[inline(always)]
    fn adds_moments(&self) -> bool {
        self.moments == Moments::Increments
    }

    #[inline(always)]
    fn particle_moment(
        &self,
        interpolated: &Matrix<D>,
        change: &Matrix<D>,
        own: &Matrix<D>,
        damping: f64,
    ) -> Matrix<D> {
        let share = self.flip.share;
        match self.moments {
            Moments::OfNodes => *interpolated,
            Moments::Increments => *interpolated * (1.0 - share) + (*own * damping + *change) * share,
        }
    }
}
