use super::{Transfer, VelocityNode};

/// Affine particle in cell (Jiang, Schroeder, Selle, Teran & Stomakhin 2015): particles also carry
/// B_p = Σ_i w_ip v_i (x_i − x_p)ᵀ and send m_p w_ip (v_p + B_p D_p⁻¹ (x_i − x_p)); conserves angular momentum
/// (MPM-ParVI paper, Algorithm 2).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Apic;

impl<const D: usize> Transfer<D> for Apic {
    type Node = VelocityNode<D>;
    const AFFINE: bool = true;
}
