use std::borrow::Cow;

use mpm_kernels::Deposit;

use super::{GridNode, Sum, Transfer, VelocityNode, shorten};
use crate::MpmError;
use crate::error::{not_negative, within};

/// FLIP blend (Brackbill & Ruppel 1986; Zhu & Bridson 2005) with share a of FLIP:
/// v_p ← (1−a) Σ w_ip v_iⁿ⁺¹ + a (v_p + Σ w_ip (v_iⁿ⁺¹ − v_iⁿ)); positions always move with Σ w_ip v_iⁿ⁺¹.
///
/// With friction, v_p and v_iⁿ in the second term are damped by the factor e^{−γΔt} that vⁿ⁺¹ contains.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flip {
    /// Share a ∈ [0, 1] in every step: 0 is PIC, 1 is FLIP. What a share below 1 dissipates depends on the number of steps.
    pub share: f64,
    /// Rate r ≥ 0, per time, at which what the nodes do not see of v_p is forgotten: a = share · e^{−rΔt}. With a share of 1 that does not depend on the
    /// number of steps.
    pub pic_rate: f64,
}

impl Flip {
    /// A fixed share of FLIP, the rest is PIC.
    pub fn blend(share: f64) -> Self {
        Self { share, pic_rate: 0.0 }
    }
}

impl<const D: usize> Transfer<D> for Flip {
    type Node = FlipNode<D>;
    const AFFINE: bool = false;
    const INCREMENTAL: bool = true;

    fn check(&self) -> Result<(), MpmError> {
        within("share", self.share, (0.0..=1.0).contains(&self.share), "from 0 to 1")?;
        not_negative("pic_rate", self.pic_rate)
    }

    #[inline(always)]
    fn over(&self, time_step: f64) -> Self {
        Self::blend(self.share * (-self.pic_rate * time_step).exp())
    }

    #[inline(always)]
    fn particle_velocity(&self, interpolated: &[f64; D], change: &[f64; D], own: &[f64; D], damping: f64) -> [f64; D] {
        let mut velocity = [0.0; D];
        for a in 0..D {
            velocity[a] = (1.0 - self.share) * interpolated[a] + self.share * (damping * own[a] + change[a]);
        }
        velocity
    }
}

/// Mass and both velocities of a node; impulses are kept apart from the momentum until `advance`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlipNode<const D: usize> {
    mass: f64,
    /// Impulse until `advance`, vⁿ⁺¹ afterwards.
    velocity: [f64; D],
    /// Momentum until `advance`, vⁿ afterwards.
    previous: [f64; D],
}

impl<const D: usize> Default for FlipNode<D> {
    fn default() -> Self {
        Self {
            mass: 0.0,
            velocity: [0.0; D],
            previous: [0.0; D],
        }
    }
}

impl<const D: usize> Sum for FlipNode<D> {
    #[inline(always)]
    fn merge(&mut self, other: &Self) {
        self.mass += other.mass;
        for a in 0..D {
            self.velocity[a] += other.velocity[a];
            self.previous[a] += other.previous[a];
        }
    }
}

impl<const D: usize> GridNode<D> for FlipNode<D> {
    #[inline(always)]
    fn add(&mut self, deposit: &Deposit<D>) {
        self.mass += deposit.scalar;
        for a in 0..D {
            self.previous[a] += deposit.vector[a];
        }
    }

    #[inline(always)]
    fn add_impulse(&mut self, impulse: &[f64; D]) {
        for a in 0..D {
            self.velocity[a] += impulse[a];
        }
    }

    #[inline(always)]
    fn mass(&self) -> f64 {
        self.mass
    }

    #[inline(always)]
    fn advance(&mut self, impulse: &[f64; D], damping: f64, speed_limit: f64) -> f64 {
        if self.mass.abs() < f64::MIN_POSITIVE {
            *self = Self::default();
            return 0.0;
        }
        for a in 0..D {
            self.previous[a] /= self.mass;
            self.velocity[a] = damping * (self.previous[a] + (self.velocity[a] + impulse[a]) / self.mass);
        }
        shorten(&mut self.velocity, speed_limit)
    }

    #[inline(always)]
    fn velocity(&self) -> &[f64; D] {
        &self.velocity
    }

    #[inline(always)]
    fn velocity_mut(&mut self) -> &mut [f64; D] {
        &mut self.velocity
    }

    #[inline(always)]
    fn velocity_brought(&self) -> &[f64; D] {
        &self.previous
    }

    #[inline(always)]
    fn change(&self, damping: f64) -> [f64; D] {
        let mut change = self.velocity;
        for a in 0..D {
            change[a] -= damping * self.previous[a];
        }
        change
    }

    fn velocities_alone(nodes: &[Self]) -> Cow<'_, [VelocityNode<D>]> {
        let each = nodes.iter().map(|node| Deposit {
            scalar: node.mass,
            vector: node.velocity,
        });
        each.map(VelocityNode).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_share_or_a_rate_out_of_range_is_named() {
        let field = |flip: Flip| match Transfer::<2>::check(&flip) {
            Err(MpmError::InvalidParameter { field, .. }) => field,
            other => panic!("{other:?}"),
        };
        assert_eq!(
            [-0.1, 1.5, f64::NAN].map(|share| field(Flip::blend(share))),
            ["share"; 3]
        );
        let forgetting = |pic_rate| Flip { share: 1.0, pic_rate };
        assert_eq!(
            [-1.0, f64::INFINITY].map(|rate| field(forgetting(rate))),
            ["pic_rate"; 2]
        );
        assert!(Transfer::<2>::check(&forgetting(2.0)).is_ok());
    }
}
