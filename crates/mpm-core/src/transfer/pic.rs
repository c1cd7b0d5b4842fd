use super::{GridNode, Sum, Transfer, shorten};

/// Particle in cell (Harlow 1964): v_p = Σ_i w_ip v_i. Stable and dissipative (MPM-ParVI paper, Algorithm 1).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Pic;

impl<const D: usize> Transfer<D> for Pic {
    type Node = VelocityNode<D>;
    const AFFINE: bool = false;
    const INCREMENTAL: bool = false;

    #[inline(always)]
    fn particle_velocity(&self, interpolated: &[f64; D], _: &[f64; D], _: &[f64; D], _: f64) -> [f64; D] {
        *interpolated
    }
}

/// Mass and velocity of a node; body-force and stress impulses are added to the momentum as they arrive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VelocityNode<const D: usize> {
    mass: f64,
    /// Momentum until `advance`, velocity afterwards.
    velocity: [f64; D],
}

impl<const D: usize> Default for VelocityNode<D> {
    fn default() -> Self {
        Self {
            mass: 0.0,
            velocity: [0.0; D],
        }
    }
}

impl<const D: usize> Sum for VelocityNode<D> {
    #[inline(always)]
    fn merge(&mut self, other: &Self) {
        self.mass += other.mass;
        for a in 0..D {
            self.velocity[a] += other.velocity[a];
        }
    }
}

impl<const D: usize> GridNode<D> for VelocityNode<D> {
    #[inline(always)]
    fn add(&mut self, mass: f64, impulse: &[f64; D]) {
        self.mass += mass;
        self.add_momentum(impulse);
    }

    #[inline(always)]
    fn add_momentum(&mut self, momentum: &[f64; D]) {
        for a in 0..D {
            self.velocity[a] += momentum[a];
        }
    }

    #[inline(always)]
    fn mass(&self) -> f64 {
        self.mass
    }

    #[inline(always)]
    fn advance(&mut self, impulse: &[f64; D], damping: f64, speed_limit: f64) -> f64 {
        if self.mass <= 0.0 {
            self.velocity = [0.0; D];
            return 0.0;
        }
        let scale = damping / self.mass;
        for a in 0..D {
            self.velocity[a] = (self.velocity[a] + impulse[a]) * scale;
        }
        shorten(&mut self.velocity, speed_limit)
    }

    #[inline(always)]
    fn velocity(&self) -> &[f64; D] {
        &self.velocity
    }

    #[inline(always)]
    fn change(&self, _damping: f64) -> [f64; D] {
        [0.0; D]
    }
}
