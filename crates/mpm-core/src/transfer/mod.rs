//! How mass and momentum travel between particles and nodes: PIC, APIC, FLIP blend, FLIP with affine particles.

mod affine_flip;
mod ahead;
mod apic;
mod cell_field;
mod cell_sums;
mod flip;
mod gather;
mod mls;
mod moving;
mod pic;
mod scatter;

use std::borrow::Cow;

use mpm_kernels::{Deposit, Packed};
use mpm_tensor::Matrix;

use crate::MpmError;
use crate::largest::larger_or_nan;

pub use affine_flip::{AffineFlip, Moments};
pub(crate) use ahead::Prepare;
pub use apic::Apic;
pub(crate) use cell_field::{CellField, Changes, Numbered, Velocities};
pub(crate) use cell_sums::CellSums;
pub use flip::{Flip, FlipNode};
pub(crate) use gather::gather_cells;
pub use gather::{Divide, gather};
pub use mls::Mls;
pub(crate) use moving::{Moving, MovingParticle};
pub use pic::{Pic, VelocityNode};
pub use scatter::{NodeSums, StencilNodes, Sum};

/// What a node accumulates and later carries: mass and momentum first, velocity after [`advance`](Self::advance).
pub trait GridNode<const D: usize>: Sum {
    /// Add mass (the scalar) and momentum (the vector).
    fn add(&mut self, deposit: &Deposit<D>);

    /// Add the impulse of forces.
    fn add_impulse(&mut self, impulse: &[f64; D]);

    /// m_i.
    fn mass(&self) -> f64;

    /// Turn momentum into velocity: v_i = damping (v_iⁿ + Δt f_i / m_i), shortened to `speed_limit`; 0 where |m_i| is below the normal
    /// numbers. Where weights are negative a mass may be, and its quotient is a velocity like any other: dropping it would lose momentum.
    ///
    /// `impulse` is Δt times a force at the node itself. Returns the squared speed before shortening: infinite where the
    /// square overflows, NaN where the velocity itself is not finite.
    fn advance(&mut self, impulse: &[f64; D], damping: f64, speed_limit: f64) -> f64;

    /// v_i after [`advance`](Self::advance); before it the momentum with all impulses so far, or the impulses alone where v_iⁿ is kept beside them.
    fn velocity(&self) -> &[f64; D];

    /// v_i after [`advance`](Self::advance) as the vector; the scalar has no meaning.
    #[inline(always)]
    fn packed_velocity<const G: usize>(&self) -> Packed<G> {
        Packed::new(0.0, self.velocity())
    }

    /// v_i after [`advance`](Self::advance), for a boundary to change. v_iⁿ stays, so that an incremental transfer sees the reaction.
    fn velocity_mut(&mut self) -> &mut [f64; D];

    /// v_iⁿ, what the particles brought, where the transfer keeps it; elsewhere it is [`velocity`](Self::velocity).
    #[inline(always)]
    fn velocity_brought(&self) -> &[f64; D] {
        self.velocity()
    }

    /// v_iⁿ⁺¹ − damping v_iⁿ, where the transfer keeps v_iⁿ.
    fn change(&self, damping: f64) -> [f64; D];

    /// Mass and v_i after [`advance`](Self::advance) alone: the nodes themselves where they have no more.
    fn velocities_alone(nodes: &[Self]) -> Cow<'_, [VelocityNode<D>]>;
}

/// Nodes of one piece of work.
const PIECE: usize = 1 << 12;

/// [`GridNode::advance`] of all nodes, with forces at them over a time step where there are such; the largest square.
#[inline(never)]
pub(crate) fn advance<N: GridNode<D>, const D: usize>(
    nodes: &mut [N],
    forces: Option<(&[[f64; D]], f64)>,
    damping: f64,
    speed_limit: f64,
) -> f64 {
    let piece = |(index, nodes): (usize, &mut [N])| {
        let mut largest = 0.0;
        for (k, node) in nodes.iter_mut().enumerate() {
            let impulse = forces.map_or([0.0; D], |(forces, dt)| forces[index * PIECE + k].map(|f| dt * f));
            largest = larger_or_nan(largest, node.advance(&impulse, damping, speed_limit));
        }
        largest
    };
    let largest = mpm_parallel::map(nodes.chunks_mut(PIECE).enumerate(), &piece);
    largest.into_iter().fold(0.0, larger_or_nan)
}

/// A pair of particle-to-grid and grid-to-particle rules for the velocity.
pub trait Transfer<const D: usize>: Copy + Send + Sync {
    /// Storage at a node.
    type Node: GridNode<D>;

    /// Whether particles carry the affine moment B_p.
    const AFFINE: bool;

    /// Whether the velocity gradient is C_p = B_p D_p⁻¹, and the stress acts by w_ip D_p⁻¹ (x_i − x_p) in the place of ∇w_ip; only with `AFFINE`.
    const MOVING_LEAST_SQUARES: bool = false;

    /// Whether nodes keep v_iⁿ beside v_iⁿ⁺¹ ([`GridNode::change`]); otherwise impulse and momentum may be added as one.
    const INCREMENTAL: bool = false;

    /// Whether particles take B_p in this run, of a transfer that is `AFFINE`; otherwise theirs stays as it is. Zero from the start, APIC is PIC.
    #[inline(always)]
    fn takes_moments(&self) -> bool {
        true
    }

    /// Whether its parameters are in their ranges.
    ///
    /// # Errors
    /// [`MpmError::InvalidParameter`] with the first that is not.
    fn check(&self) -> Result<(), MpmError> {
        Ok(())
    }

    /// The transfer in a step of length Δt; most do not depend on it.
    #[inline(always)]
    fn over(&self, _time_step: f64) -> Self {
        *self
    }

    /// New particle velocity from the interpolated nodal velocity, the interpolated nodal change and its own velocity: the first unless a transfer is incremental.
    #[inline(always)]
    fn particle_velocity(&self, interpolated: &[f64; D], _: &[f64; D], _: &[f64; D], _damping: f64) -> [f64; D] {
        *interpolated
    }

    /// Whether the moment of the nodal change is asked for in this run, of a transfer that is `AFFINE` and `INCREMENTAL`.
    #[inline(always)]
    fn adds_moments(&self) -> bool {
        false
    }

    /// New B_p from the moment of the nodal velocity, that of the nodal change (zero unless asked for), and its own: the first unless a transfer adds moments.
    #[inline(always)]
    fn particle_moment(&self, interpolated: &Matrix<D>, _: &Matrix<D>, _: &Matrix<D>, _damping: f64) -> Matrix<D> {
        *interpolated
    }
}

/// Shorten `vector` to the length `limit` if it is longer. Returns its squared length before: infinite where the square
/// overflows, NaN where the vector is not finite.
#[inline(always)]
fn shorten<const D: usize>(vector: &mut [f64; D], limit: f64) -> f64 {
    let square: f64 = vector.iter().map(|c| c * c).sum();
    if !square.is_finite() {
        return shorten_huge(vector, limit);
    }
    if square > limit * limit {
        let scale = limit / square.sqrt();
        for c in vector.iter_mut() {
            *c *= scale;
        }
    }
    square
}

/// [`shorten`] where the square is not a finite number.
#[cold]
fn shorten_huge<const D: usize>(vector: &mut [f64; D], limit: f64) -> f64 {
    if !vector.iter().all(|c| c.is_finite()) {
        return f64::NAN;
    }
    if limit < f64::INFINITY {
        let largest = vector.iter().fold(0.0, |largest: f64, c| largest.max(c.abs()));
        let unit = vector.map(|c| c / largest);
        let length = unit.iter().map(|c| c * c).sum::<f64>().sqrt();
        *vector = unit.map(|c| c * (limit / length));
    }
    f64::INFINITY
}

#[cfg(test)]
mod tests {
    use super::{FlipNode, GridNode, VelocityNode, shorten};
    use mpm_kernels::Deposit;

    fn velocity_of<N: GridNode<2>>(mass: f64, momentum: [f64; 2]) -> [f64; 2] {
        let mut node = N::default();
        node.add(&Deposit {
            scalar: mass,
            vector: momentum,
        });
        node.advance(&[0.0; 2], 1.0, f64::INFINITY);
        *node.velocity()
    }

    #[test]
    fn momentum_over_mass_is_the_velocity_whatever_the_sign() {
        for (mass, expected) in [
            (0.5, [2.0, -4.0]),
            (-0.5, [-2.0, 4.0]),
            (0.0, [0.0; 2]),
            (-1e-310, [0.0; 2]),
        ] {
            assert_eq!(velocity_of::<VelocityNode<2>>(mass, [1.0, -2.0]), expected);
            assert_eq!(velocity_of::<FlipNode<2>>(mass, [1.0, -2.0]), expected);
        }
    }

    #[test]
    fn a_vector_is_shortened_to_the_limit_and_keeps_its_direction() {
        let mut vector = [3.0, -4.0];
        assert_eq!(shorten(&mut vector, 5.0), 25.0);
        assert_eq!(vector, [3.0, -4.0]);
        assert_eq!(shorten(&mut vector, 2.5), 25.0);
        assert_eq!(vector, [1.5, -2.0]);
        assert_eq!(shorten(&mut vector, f64::INFINITY), 6.25);
    }

    #[test]
    fn a_square_that_overflows_is_no_obstacle() {
        let mut vector = [3e200, -4e200];
        assert_eq!(shorten(&mut vector, f64::INFINITY), f64::INFINITY);
        assert_eq!(vector, [3e200, -4e200]);
        assert_eq!(shorten(&mut vector, 5.0), f64::INFINITY);
        assert!((vector[0] - 3.0).abs() < 1e-15 && (vector[1] + 4.0).abs() < 1e-15);
    }

    #[test]
    fn what_is_not_finite_gives_nan() {
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            for limit in [1.0, f64::INFINITY] {
                assert!(shorten(&mut [1.0, value], limit).is_nan());
            }
        }
    }
}
