//! Coulomb friction of particles that a force presses on something rigid.

use mpm_tensor::vector;

use crate::transfer::{GridNode, NodeSums, Sum};
use crate::{Basis, Masses};

/// What presses on the particles, and how rough it is.
#[derive(Clone, Copy, Debug)]
pub struct Friction<'a, const D: usize> {
    /// The coefficient μ ≥ 0.
    pub coefficient: f64,
    /// The sliding speed ε ≥ 0 from which friction is full; 0: Coulomb's law, with sticking.
    pub full_speed: f64,
    /// The normal force per unit mass on every particle, in the present order; zero where nothing presses. What a [`ContactPotential`](crate::ContactPotential) gives is
    /// added.
    pub normal_forces: &'a [[f64; D]],
}

/// Impulse of the normal forces around a node.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NormalImpulse<const D: usize>(pub [f64; D]);

impl<const D: usize> Default for NormalImpulse<D> {
    fn default() -> Self {
        Self([0.0; D])
    }
}

impl<const D: usize> Sum for NormalImpulse<D> {
    #[inline(always)]
    fn merge(&mut self, other: &Self) {
        vector::accumulate(&mut self.0, 1.0, &other.0);
    }
}

/// N_i = Δt Σ_p w_ip m_p f_p, f_p the normal force per mass on a particle; all zero where nothing presses.
#[inline(never)]
pub(crate) fn sum_up_impulses<const D: usize, B: Basis<D>>(
    basis: &B,
    positions: &[[f64; D]],
    masses: &Masses,
    forces: &[[f64; D]],
    time_step: f64,
    impulses: &mut NodeSums<NormalImpulse<D>>,
) {
    if forces.iter().all(|force| *force == [0.0; D]) {
        impulses.clear(basis.node_count());
        return;
    }
    impulses.scatter(basis, positions, move |p, x, stencil| {
        if let Some(force) = forces.get(p).filter(|force| **force != [0.0; D]) {
            let scale = time_step * masses.get(p);
            basis.for_each_node(p, x, |index, entry| {
                vector::accumulate(&mut stencil.node(index).0, scale * entry.weight, force);
            });
        }
    });
}

/// Slow the nodes, after all forces: with N_i the impulse of the normal forces and v_t the part of v_i across it, |v_t| becomes y ε with
///
/// y ε + (μ |N_i| / m_i) φ(y) = |v_t|, φ(y) = 2y − y² below y = 1 and 1 from there on (backward Euler; φ: Li et al., *Incremental potential contact*, ACM Trans. Graph. 39
/// (2020), Eq. 14);
///
/// in the limit ε → 0 it falls by μ |N_i| / m_i or to 0. So friction takes at most what sliding there is, whatever Δt, and what sticks stays where it is: internal forces have
/// acted already. Nodes of no mass and of negative mass, which negative weights may leave, are left alone.
#[inline(never)]
pub(crate) fn slow_nodes<const D: usize, N: GridNode<D>>(
    friction: &Friction<D>,
    impulses: &NodeSums<NormalImpulse<D>>,
    nodes: &mut [N],
) {
    for (node, impulse) in nodes.iter_mut().zip(impulses.as_slice()) {
        let (mass, size) = (node.mass(), vector::norm(&impulse.0));
        if !(mass >= f64::MIN_POSITIVE && size > 0.0) {
            continue;
        }
        let normal = impulse.0.map(|c| c / size);
        let velocity = node.velocity_mut();
        let sliding = vector::add_scaled(velocity, -vector::dot(velocity, &normal), &normal);
        let speed = vector::norm(&sliding);
        if speed > 0.0 {
            let left = slowed(speed, friction.coefficient * size / mass, friction.full_speed);
            vector::accumulate(velocity, left / speed - 1.0, &sliding);
        }
    }
}

/// What friction leaves of a speed that it lowers by `most` where it is full, from the speed `full` on.
fn slowed(speed: f64, most: f64, full: f64) -> f64 {
    if speed >= most + full {
        return speed - most;
    }
    if full == 0.0 {
        return 0.0;
    }
    // r y² − (1 + 2r) y + v = 0 with r = most / ε, v = |v_t| / ε; the discriminant is at least 1.
    let (r, v) = (most / full, speed / full);
    let linear = 1.0 + 2.0 * r;
    2.0 * speed / (linear + (linear * linear - 4.0 * r * v).sqrt())
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::slowed;

    proptest! {
        #[test]
        fn what_is_left_solves_the_equation(speed in 0.0..10.0f64, most in 0..12i32, full in 0..12i32) {
            let (most, full) = (10f64.powi(6 - most), 10f64.powi(6 - full));
            let left = slowed(speed, most, full);
            prop_assert!((0.0..=speed).contains(&left));
            let y = (left / full).min(1.0);
            prop_assert!((left + most * (2.0 * y - y * y) - speed).abs() <= 1e-12 * (speed + most));
        }
    }

    #[test]
    fn without_a_speed_it_is_coulombs_law() {
        assert_eq!(
            [slowed(3.0, 1.0, 0.0), slowed(1.0, 1.0, 0.0), slowed(0.5, 1.0, 0.0)],
            [2.0, 0.0, 0.0]
        );
        assert_eq!(slowed(3.0, 0.0, 0.0), 3.0);
    }
}
