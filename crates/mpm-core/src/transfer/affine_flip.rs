use super::{Flip, FlipNode, Transfer};

/// FLIP whose particles also carry B_p and send m_p w_ip (v_p + B_p D_p⁻¹ (x_i − x_p)), as with [`Apic`](crate::Apic); v_p changes as with [`Flip`].
///
/// A velocity that is linear in space arrives at the nodes as it is, which FLIP alone smoothes; and v_p keeps what APIC loses in every step. So neither
/// rotation nor shear is dissipated by the number of steps or by the spacing. Angular momentum is not conserved to rounding: what the nodes do not see of v_p has a
/// moment.
///
/// Source: AFLIP of Fei, Guo, Wu, Huang & Gao, *Revisiting integration in the material point method*, ACM Trans. Graph. 40 (2021).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AffineFlip(
    /// How v_p changes.
    pub Flip,
);

impl<const D: usize> Transfer<D> for AffineFlip {
    type Node = FlipNode<D>;
    const AFFINE: bool = true;
    const INCREMENTAL: bool = true;

    #[inline(always)]
    fn over(&self, time_step: f64) -> Self {
        Self(Transfer::<D>::over(&self.0, time_step))
    }

    #[inline(always)]
    fn particle_velocity(&self, interpolated: &[f64; D], change: &[f64; D], own: &[f64; D], damping: f64) -> [f64; D] {
        self.0.particle_velocity(interpolated, change, own, damping)
    }
}
