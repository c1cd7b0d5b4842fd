use super::{Transfer, VelocityNode};

/// The moving least squares MPM (Hu, Fang, Ge, Qu, Zhu, Pradhana & Jiang 2018): [`Apic`](crate::Apic) whose C_p = B_p D_p⁻¹ is the velocity
/// gradient, and whose internal force is −V⁰_p τ_p w_ip D_p⁻¹ (x_i − x_p).
///
/// No gradient of a shape function is computed. On piecewise linear bases it is APIC itself.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Mls;

impl<const D: usize> Transfer<D> for Mls {
    type Node = VelocityNode<D>;
    const AFFINE: bool = true;
    const MOVING_LEAST_SQUARES: bool = true;
}
