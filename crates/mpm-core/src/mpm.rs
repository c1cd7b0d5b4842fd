//! A body of particles: what a step works on.

use mpm_tensor::Matrix;

use crate::contact::NodalContact;
use crate::friction::NormalImpulse;
use crate::volume_averaging::{NodeVolume, VolumeAveraging};
use crate::{
    Basis, BodyForce, Boundary, EnergyBudget, Medium, NoBoundary, NodeSums, Particles, StressUpdate, StressWork,
    Transfer, VelocityFilter,
};

/// A body of particles on a basis: what moves (`particles`), where (`basis`), how velocities travel (`transfer`), what it
/// is made of (`medium`), what pulls at it (`body_force`) and what it runs against (`boundary`).
pub struct Mpm<const D: usize, B, T: Transfer<D>, M: Medium<D>, F, C = NoBoundary> {
    /// State of the particles, in schedule order after a step.
    pub particles: Particles<D, M::State>,
    /// Background discretisation.
    pub basis: B,
    /// Velocity transfer.
    pub transfer: T,
    /// Constitutive behaviour.
    pub medium: M,
    /// External force.
    pub body_force: F,
    /// Conditions on the velocities of the nodes.
    pub boundary: C,
    /// When in a step the particles deform.
    pub stress_update: StressUpdate,
    /// What of the particles' volumes is averaged over the nodes (F̄), against volumetric locking.
    pub volume_averaging: VolumeAveraging,
    /// What is forgotten of velocities that the nodes do not see.
    pub velocity_filter: Option<VelocityFilter<D>>,
    /// Where kinetic energy has gone; `None`, as at first: nobody asks.
    pub energy_budget: Option<EnergyBudget>,
    /// Time since the body was made; every step adds its Δt.
    pub time: f64,
    /// What has become, in the step, of the work of every particle's stress; empty without an energy budget.
    pub(crate) stress_works: Vec<StressWork>,
    /// Nodal masses and velocities, in the order of the basis' numbers.
    pub(crate) nodes: NodeSums<T::Node>,
    /// Body force per unit mass at the particles; empty where it acts at nodes.
    pub(crate) accelerations: Vec<[f64; D]>,
    /// Positions of the nodes and force at them; empty where it acts at particles.
    pub(crate) node_positions: Vec<[f64; D]>,
    pub(crate) node_forces: Vec<[f64; D]>,
    /// Volumes around the nodes; empty without volume averaging.
    pub(crate) node_volumes: NodeSums<NodeVolume>,
    /// F before the step, where changes of volumes are averaged; else empty.
    pub(crate) deformations_before: Vec<Matrix<D>>,
    /// What presses on the nodes; empty without friction.
    pub(crate) normal_impulses: NodeSums<NormalImpulse<D>>,
    /// Particles in contact, by nodes; empty without a contact.
    pub(crate) contact: NodalContact<D>,
}

impl<const D: usize, B, T, M, F> Mpm<D, B, T, M, F>
where
    B: Basis<D>,
    T: Transfer<D>,
    M: Medium<D>,
    F: BodyForce<D>,
{
    /// A body in free space, at time 0. The affine moments B_p = 0 are added to the particles where the transfer needs them and there are none, and velocity gradients L_p = 0
    /// where the medium does; F_p and V⁰_p, where the medium needs them, come from [`Particles::with_elastic_state`] and [`Particles::with_states`]. Fields of another length than the
    /// positions are errors of the first step.
    pub fn new(mut particles: Particles<D, M::State>, basis: B, transfer: T, medium: M, body_force: F) -> Self {
        // Some of another length are left as they are, for the step to refuse.
        if T::AFFINE && particles.affine.is_empty() {
            particles.affine.resize(particles.len(), Matrix::ZERO);
        }
        if medium.rate_dependent() && particles.velocity_gradients.is_empty() {
            particles.velocity_gradients.resize(particles.len(), Matrix::ZERO);
        }
        Self {
            particles,
            basis,
            transfer,
            medium,
            body_force,
            boundary: NoBoundary,
            stress_update: StressUpdate::default(),
            volume_averaging: VolumeAveraging::Off,
            velocity_filter: None,
            energy_budget: None,
            time: 0.0,
            stress_works: Vec::new(),
            nodes: NodeSums::default(),
            accelerations: Vec::new(),
            node_positions: Vec::new(),
            node_forces: Vec::new(),
            node_volumes: NodeSums::default(),
            deformations_before: Vec::new(),
            normal_impulses: NodeSums::default(),
            contact: NodalContact::default(),
        }
    }
}

impl<const D: usize, B: Basis<D>, T: Transfer<D>, M: Medium<D>, F: BodyForce<D>, C: Boundary<D>> Mpm<D, B, T, M, F, C> {
    /// The same body with a boundary.
    #[inline]
    pub fn with_boundary<N: Boundary<D>>(self, boundary: N) -> Mpm<D, B, T, M, F, N> {
        Mpm {
            boundary,
            particles: self.particles,
            basis: self.basis,
            transfer: self.transfer,
            medium: self.medium,
            body_force: self.body_force,
            stress_update: self.stress_update,
            volume_averaging: self.volume_averaging,
            velocity_filter: self.velocity_filter,
            energy_budget: self.energy_budget,
            time: self.time,
            stress_works: self.stress_works,
            nodes: self.nodes,
            accelerations: self.accelerations,
            node_positions: self.node_positions,
            node_forces: self.node_forces,
            node_volumes: self.node_volumes,
            deformations_before: self.deformations_before,
            normal_impulses: self.normal_impulses,
            contact: self.contact,
        }
    }

    /// Bytes held by particles, grid and nodes.
    pub fn storage_bytes(&self) -> usize {
        let vectors = self.accelerations.capacity() + self.node_positions.capacity() + self.node_forces.capacity();
        self.particles.storage_bytes()
            + self.basis.storage_bytes()
            + self.nodes.storage_bytes()
            + self.node_volumes.storage_bytes()
            + self.deformations_before.capacity() * size_of::<Matrix<D>>()
            + self.normal_impulses.storage_bytes()
            + self.contact.storage_bytes()
            + self.velocity_filter.as_ref().map_or(0, VelocityFilter::storage_bytes)
            + self.stress_works.capacity() * size_of::<StressWork>()
            + vectors * size_of::<[f64; D]>()
    }
}
