//! How mass and momentum travel between particles and nodes: PIC, APIC, FLIP blend.

mod apic;
mod flip;
mod gather;
mod pic;
mod scatter;

pub use apic::Apic;
pub use flip::{Flip, FlipNode};
pub use gather::{Divide, gather};
pub use pic::{Pic, VelocityNode};
pub use scatter::{StencilNodes, scatter};

/// What a node accumulates and later carries: mass and momentum first, velocity after [`advance`](Self::advance).
pub trait GridNode<const D: usize>: Copy + Default + Send + Sync {
    /// Add mass and the impulse of forces.
    fn add(&mut self, mass: f64, impulse: &[f64; D]);

    /// Add momentum.
    fn add_momentum(&mut self, momentum: &[f64; D]);

    /// m_i.
    fn mass(&self) -> f64;

    /// Turn momentum into velocity: v_i = damping (v_iⁿ + Δt f_i / m_i), shortened to `speed_limit`.
    ///
    /// `impulse` is Δt times a force at the node itself. Returns the squared speed before shortening.
    fn advance(&mut self, impulse: &[f64; D], damping: f64, speed_limit: f64) -> f64;

    /// v_i after [`advance`](Self::advance).
    fn velocity(&self) -> &[f64; D];

    /// v_iⁿ⁺¹ − damping v_iⁿ, where the transfer keeps v_iⁿ.
    fn change(&self, damping: f64) -> [f64; D];
}

/// A pair of particle-to-grid and grid-to-particle rules for the velocity.
pub trait Transfer<const D: usize>: Copy + Send + Sync {
    /// Storage at a node.
    type Node: GridNode<D>;

    /// Whether particles carry the affine moment B_p.
    const AFFINE: bool;

    /// Whether nodes keep v_iⁿ beside v_iⁿ⁺¹ ([`GridNode::change`]); otherwise impulse and momentum may be added as one.
    const INCREMENTAL: bool;

    /// New particle velocity from the interpolated nodal velocity, the interpolated nodal change and its own velocity.
    fn particle_velocity(&self, interpolated: &[f64; D], change: &[f64; D], own: &[f64; D], damping: f64) -> [f64; D];
}

/// `vector`, shortened to the length `limit` if it is longer; and its squared length before.
#[inline(always)]
fn shorten<const D: usize>(vector: &mut [f64; D], limit: f64) -> f64 {
    let square: f64 = vector.iter().map(|c| c * c).sum();
    if square > limit * limit {
        let scale = limit / square.sqrt();
        for c in vector.iter_mut() {
            *c *= scale;
        }
    }
    square
}
