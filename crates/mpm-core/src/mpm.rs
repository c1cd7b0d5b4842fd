//! A body of particles: what a step works on.

use mpm_tensor::Matrix;

use crate::{Basis, BodyForce, Medium, NodeSums, Particles, Transfer};

/// A body of particles on a basis: what moves (`particles`), where (`basis`), how velocities travel (`transfer`), what it
/// is made of (`medium`) and what pulls at it (`body_force`).
pub struct Mpm<const D: usize, B, T: Transfer<D>, M, F> {
    /// State of the particles, in schedule order after a step.
    pub particles: Particles<D>,
    /// Background discretisation.
    pub basis: B,
    /// Velocity transfer.
    pub transfer: T,
    /// Constitutive behaviour.
    pub medium: M,
    /// External force.
    pub body_force: F,
    /// Nodal masses and velocities, in the order of the basis' numbers.
    pub(crate) nodes: NodeSums<T::Node>,
    /// Body force per unit mass at the particles; empty where it acts at nodes.
    pub(crate) accelerations: Vec<[f64; D]>,
    /// Positions of the nodes and force at them; empty where it acts at particles.
    pub(crate) node_positions: Vec<[f64; D]>,
    pub(crate) node_forces: Vec<[f64; D]>,
}

impl<const D: usize, B, T, M, F> Mpm<D, B, T, M, F>
where
    B: Basis<D>,
    T: Transfer<D>,
    M: Medium<D>,
    F: BodyForce<D>,
{
    /// A body. The affine moments B_p = 0 are added to the particles where the transfer needs them; F_p and V⁰_p, where the
    /// medium needs them, come from [`Particles::with_elastic_state`].
    pub fn new(mut particles: Particles<D>, basis: B, transfer: T, medium: M, body_force: F) -> Self {
        if T::AFFINE {
            particles.affine.resize(particles.len(), Matrix::ZERO);
        }
        Self {
            particles,
            basis,
            transfer,
            medium,
            body_force,
            nodes: NodeSums::default(),
            accelerations: Vec::new(),
            node_positions: Vec::new(),
            node_forces: Vec::new(),
        }
    }

    /// Bytes held by particles, grid and nodes.
    pub fn storage_bytes(&self) -> usize {
        let vectors = self.accelerations.capacity() + self.node_positions.capacity() + self.node_forces.capacity();
        self.particles.storage_bytes()
            + self.basis.storage_bytes()
            + self.nodes.storage_bytes()
            + vectors * size_of::<[f64; D]>()
    }
}
