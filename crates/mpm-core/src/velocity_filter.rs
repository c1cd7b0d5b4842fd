//! Forgetting what the grid does not see of the particles' velocities.

use mpm_kernels::Deposit;
use mpm_tensor::vector::scale;

use crate::transfer::{CellSums, GridNode, NodeSums, VelocityNode, gather};
use crate::{Basis, Masses, Member, MpmError};

/// v ← v − (1 − e^{−rτ}) (1 − 𝒫)ᵐ v over a time τ, where 𝒫 takes velocities to the nodes and back as PIC does.
///
/// FLIP keeps whatever the nodes do not see of the particles' velocities, and it comes back as noise of the stress. With m = 1 the filter is PIC at the rate r,
/// which also damps what is smooth: a field of which 𝒫 loses a share ε. With order m it loses a share εᵐ of that field, and noise, of which 𝒫 loses
/// nearly all, as fast as before. The limit of large r, the filter in every step, is XPIC(m).
///
/// Momentum is conserved, angular momentum is not. Kinetic energy never grows where weights are not negative: 𝒫 is then symmetric in the
/// product Σ m_p u_p · v_p, with eigenvalues from 0 to 1.
///
/// It takes m passes to the nodes and back, each time that r t has grown by 1/10, or in every step if r Δt is more.
///
/// Source: the velocities of XPIC(m), Hammerquist & Nairn, *A new method for material point method particle updates that reduces noise and enhances
/// stability*, Comput. Methods Appl. Mech. Eng. 318 (2017), doi 10.1016/j.cma.2017.01.035; the rate is ours, so that what is lost does not hang on the number of steps.
#[derive(Clone, Debug)]
pub struct VelocityFilter<const D: usize> {
    order: usize,
    rate: f64,
    /// (1 − 𝒫)ᵏ v.
    unseen: Vec<[f64; D]>,
    nodes: NodeSums<VelocityNode<D>>,
}

/// rτ at which the filter acts, at least.
const DUE: f64 = 0.1;

impl<const D: usize> VelocityFilter<D> {
    /// The filter of order m ≥ 1 at the rate r ≥ 0, per time.
    ///
    /// # Errors
    /// [`MpmError::InvalidParameter`] for an order of 0, a rate below 0 or one that is not finite.
    pub fn new(order: usize, rate: f64) -> Result<Self, MpmError> {
        let refuse = |field, value, expected| Err(MpmError::InvalidParameter { field, value, expected });
        if order == 0 {
            return refuse("order", 0.0, "at least 1");
        }
        if !(rate >= 0.0 && rate.is_finite()) {
            return refuse("rate", rate, "at least 0 and finite");
        }
        Ok(Self {
            order,
            rate,
            unseen: Vec::new(),
            nodes: NodeSums::default(),
        })
    }

    /// r τ that the step from `time` on is filtered with: its own r Δt, or a tenth wherever r t passes one if that is more. It depends on the step alone, so that a resumed run is filtered as one that was not interrupted.
    fn exponent(&self, time: f64, time_step: f64) -> f64 {
        let own = self.rate * time_step;
        if own >= DUE {
            return own;
        }
        let passed = |time: f64| (self.rate * time / DUE).floor();
        DUE * (passed(time + time_step) - passed(time))
    }

    /// Filter the velocities if it is time to. All are in the order of the basis' schedule, and the basis is active at the positions.
    pub(crate) fn act<B: Basis<D>>(
        &mut self,
        basis: &B,
        (time, time_step): (f64, f64),
        positions: &[[f64; D]],
        masses: &Masses,
        velocities: &mut [[f64; D]],
    ) {
        let exponent = self.exponent(time, time_step);
        if exponent == 0.0 {
            return;
        }
        self.unseen.clear();
        self.unseen.extend_from_slice(velocities);
        for _ in 0..self.order {
            self.subtract_what_nodes_see(basis, positions, masses);
        }
        let share = -(-exponent).exp_m1();
        for (velocity, unseen) in velocities.iter_mut().zip(&self.unseen) {
            for a in 0..D {
                velocity[a] -= share * unseen[a];
            }
        }
    }

    /// u ← u − 𝒫 u.
    fn subtract_what_nodes_see<B: Basis<D>>(&mut self, basis: &B, positions: &[[f64; D]], masses: &Masses) {
        let unseen = &self.unseen[..];
        let deposit = move |member: Member<B::Cell, D>, _: Option<&()>, cell: &mut CellSums<B, VelocityNode<D>, D>| {
            let p = member.particle;
            let mass = masses.get(p);
            let value = Deposit {
                scalar: mass,
                vector: scale(&unseen[p], mass),
            };
            basis.deposit(member, &value, &(), &(), &mut cell.sums());
        };
        self.nodes.scatter_packed(basis, positions, false, (), deposit);
        for node in self.nodes.as_mut_slice() {
            node.advance(&[0.0; D], 1.0, f64::INFINITY);
        }
        let nodes = self.nodes.as_slice();
        gather(
            basis,
            &mut self.unseen[..],
            move |unseen: &mut &mut [[f64; D]], k, p, cell_nodes| {
                basis.for_each_node(p, &positions[p], |index, entry| {
                    let seen = nodes[cell_nodes[index] as usize].velocity();
                    for a in 0..D {
                        unseen[k][a] -= entry.weight * seen[a];
                    }
                });
            },
        );
    }

    /// Bytes held.
    pub(crate) fn storage_bytes(&self) -> usize {
        self.unseen.capacity() * size_of::<[f64; D]>() + self.nodes.storage_bytes()
    }
}
