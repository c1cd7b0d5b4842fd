//! What the velocities of the nodes obey beside the balance of momentum: walls and obstacles.

mod amplitude;
mod contact;
mod folds;
mod held_surface;
mod image_solve;
mod mirror;
mod node_forces;
mod obstacle;
mod plane;
mod prescribed;
mod role;
mod signed_distance;
mod surface;

pub use amplitude::Amplitude;
pub use contact::Contact;
pub use held_surface::{HeldNode, HeldSurface, ImageNode};
pub use node_forces::{NodeForces, VirtualStress};
pub use obstacle::Obstacle;
pub use plane::Plane;
pub use prescribed::PrescribedVelocity;
pub use signed_distance::{HalfSpace, SignedDistance};
pub use surface::{Extents, ON_A_SURFACE};

use self::folds::Folds;
use crate::error::finite;
use crate::{Basis, GridNode, MpmError};

/// The grid when a boundary is asked: after forces, before particles move.
#[derive(Clone, Copy)]
pub struct GridMotion<'a, const D: usize> {
    /// Positions of the nodes, by number.
    pub positions: &'a [[f64; D]],
    /// The particles.
    pub extents: Extents<'a, D>,
    /// Time at the start of the step.
    pub time: f64,
    /// Δt.
    pub time_step: f64,
}

/// The particles when forces of a boundary are asked for.
#[derive(Clone, Copy)]
pub struct Loading<'a, const D: usize> {
    /// The particles.
    pub extents: Extents<'a, D>,
    /// Time at the start of the step.
    pub time: f64,
    /// Δt.
    pub time_step: f64,
    /// Whether stresses act by w_ip D_p⁻¹ (x_i − x_p) in the place of ∇w_ip.
    pub least_squares: bool,
}

/// Conditions on the velocities of the nodes.
pub trait Boundary<const D: usize>: Sync {
    /// Whether there are any; without, not even the positions of the nodes are computed.
    const PRESENT: bool = true;

    /// Whether its parameters are in their ranges; asked at the start of every step.
    ///
    /// # Errors
    /// [`MpmError::InvalidParameter`] with the first that is not.
    fn check(&self) -> Result<(), MpmError> {
        Ok(())
    }

    /// Give nodes the impulses Δt f_i of forces ([`GridNode::add_impulse`]), which are damped and limited together with those of the stresses.
    fn push<B: Basis<D>, N: GridNode<D>>(&self, _basis: &B, _loading: &Loading<D>, _nodes: &mut [N]) {}

    /// Change the velocities ([`GridNode::velocity_mut`]) of nodes. What the nodes get goes back to the particles, so the
    /// momentum that is taken is the reaction of the boundary.
    ///
    /// Nodes that are held at a plane and behind it make a boundary of first order, since particles beside it share these nodes; [`Plane`] mirrors what is behind, and is of second order
    /// where nodes lie on it.
    fn constrain<B: Basis<D>, N: GridNode<D>>(&mut self, basis: &B, motion: &GridMotion<D>, nodes: &mut [N]);
}

/// No boundary: a body in free space.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct NoBoundary;

impl<const D: usize> Boundary<D> for NoBoundary {
    const PRESENT: bool = false;

    fn constrain<B: Basis<D>, N: GridNode<D>>(&mut self, _: &B, _: &GridMotion<D>, _: &mut [N]) {}
}

/// Forces at nodes; then walls, held surfaces of a mesh, obstacles and prescribed velocities, applied in this order.
#[derive(Default)]
pub struct Boundaries<const D: usize> {
    /// Forces at nodes of the mesh.
    pub forces: Vec<NodeForces<D>>,
    /// Plane walls.
    pub walls: Vec<Plane<D>>,
    /// Parts of the boundary of a mesh.
    pub surfaces: Vec<HeldSurface<D>>,
    /// Rigid bodies.
    pub obstacles: Vec<Obstacle<D>>,
    /// Given velocities; the last one has the last word.
    pub prescribed: Vec<Box<dyn PrescribedVelocity<D>>>,
    /// Images of images.
    folds: Folds,
    /// Masses that mirrored nodes have together.
    masses: Vec<f64>,
    /// Gaps between a surface and the material around the nodes.
    gaps: Vec<f64>,
}

impl<const D: usize> Boundaries<D> {
    /// These walls and obstacles.
    pub fn new(walls: Vec<Plane<D>>, obstacles: Vec<Obstacle<D>>) -> Self {
        Self {
            forces: Vec::new(),
            walls,
            surfaces: Vec::new(),
            obstacles,
            prescribed: Vec::new(),
            folds: Folds::default(),
            masses: Vec::new(),
            gaps: Vec::new(),
        }
    }

    /// The same, with these velocities.
    pub fn with_prescribed(mut self, prescribed: Vec<Box<dyn PrescribedVelocity<D>>>) -> Self {
        self.prescribed = prescribed;
        self
    }

    /// The same, with these surfaces.
    pub fn with_surfaces(mut self, surfaces: Vec<HeldSurface<D>>) -> Self {
        self.surfaces = surfaces;
        self
    }

    /// The same, with these forces.
    pub fn with_forces(mut self, forces: Vec<NodeForces<D>>) -> Self {
        self.forces = forces;
        self
    }
}

impl<const D: usize> Boundary<D> for Boundaries<D> {
    fn check(&self) -> Result<(), MpmError> {
        for wall in &self.walls {
            wall.contact.check()?;
            finite("point", &wall.point)?;
            signed_distance::check_normal(&wall.normal)?;
            finite("velocity", &wall.velocity)?;
        }
        for surface in &self.surfaces {
            surface.check()?;
        }
        for obstacle in &self.obstacles {
            obstacle.contact.check()?;
            obstacle.shape.check()?;
            finite("velocity", &obstacle.velocity)?;
        }
        Ok(())
    }

    fn push<B: Basis<D>, N: GridNode<D>>(&self, basis: &B, loading: &Loading<D>, nodes: &mut [N]) {
        for forces in &self.forces {
            forces.push(basis, loading, nodes);
        }
    }

    fn constrain<B: Basis<D>, N: GridNode<D>>(&mut self, basis: &B, motion: &GridMotion<D>, nodes: &mut [N]) {
        if !(self.walls.is_empty() && self.surfaces.is_empty() && self.obstacles.is_empty()) {
            self.masses.clear();
            self.masses.extend(nodes.iter().map(GridNode::mass));
        }
        self.folds
            .fold(&self.walls, basis, motion, (&mut self.masses, &mut *nodes));
        for wall in &self.walls {
            let scratch = (&mut *self.masses, &mut self.gaps);
            wall.constrain(basis, motion, (&self.folds.roles, &self.walls), scratch, nodes);
        }
        self.folds.unfold(&self.walls, nodes);
        for surface in &mut self.surfaces {
            surface.constrain(basis, &mut self.masses, nodes);
        }
        // Where two meet, the second may have moved nodes of the first.
        for surface in &self.surfaces {
            surface.hold(basis, nodes);
        }
        for obstacle in &self.obstacles {
            obstacle.constrain(basis, motion, (&self.masses, &mut self.gaps), nodes);
        }
        for field in &self.prescribed {
            prescribed::prescribe(&**field, basis, motion, nodes);
        }
    }
}
