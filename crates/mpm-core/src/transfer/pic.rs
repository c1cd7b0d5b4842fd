use std::borrow::Cow;

use mpm_kernels::{Deposit, Packed};

use super::{GridNode, Sum, Transfer, shorten};

/// Particle in cell (Harlow 1964): v_p = Σ_i w_ip v_i. Stable and dissipative (MPM-ParVI paper, Algorithm 1).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Pic;

impl<const D: usize> Transfer<D> for Pic {
    type Node = VelocityNode<D>;
    const AFFINE: bool = false;
}

/// Mass and velocity of a node; body-force and stress impulses are added to the momentum as they arrive.
///
/// Momentum stands where the velocity will be until `advance`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct VelocityNode<const D: usize>(pub(super) Deposit<D>);

impl<const D: usize> Sum for VelocityNode<D> {
    #[inline(always)]
    fn merge(&mut self, other: &Self) {
        self.0.add(&other.0);
    }
}

impl<const D: usize> GridNode<D> for VelocityNode<D> {
    #[inline(always)]
    fn add(&mut self, deposit: &Deposit<D>) {
        self.0.add(deposit);
    }

    #[inline(always)]
    fn add_impulse(&mut self, impulse: &[f64; D]) {
        for a in 0..D {
            self.0.vector[a] += impulse[a];
        }
    }

    #[inline(always)]
    fn mass(&self) -> f64 {
        self.0.scalar
    }

    #[inline(always)]
    fn advance(&mut self, impulse: &[f64; D], damping: f64, speed_limit: f64) -> f64 {
        let Deposit { scalar: mass, vector } = &mut self.0;
        if mass.abs() < f64::MIN_POSITIVE {
            *vector = [0.0; D];
            return 0.0;
        }
        let scale = damping / *mass;
        for a in 0..D {
            vector[a] = (vector[a] + impulse[a]) * scale;
        }
        shorten(vector, speed_limit)
    }

    #[inline(always)]
    fn velocity(&self) -> &[f64; D] {
        &self.0.vector
    }

    #[inline(always)]
    fn velocity_mut(&mut self) -> &mut [f64; D] {
        &mut self.0.vector
    }

    #[inline(always)]
    fn packed_velocity<const G: usize>(&self) -> Packed<G> {
        Packed::new(self.0.scalar, &self.0.vector)
    }

    #[inline(always)]
    fn change(&self, _damping: f64) -> [f64; D] {
        [0.0; D]
    }

    fn velocities_alone(nodes: &[Self]) -> Cow<'_, [Self]> {
        Cow::Borrowed(nodes)
    }
}
