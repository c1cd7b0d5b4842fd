use super::surface::{ON_A_SURFACE, Surface};
use super::{Contact, GridMotion, SignedDistance};
use crate::{Basis, GridNode};

/// A rigid body that moves with a given velocity or rests; it acts on the nodes inside it and on its surface.
pub struct Obstacle<const D: usize> {
    /// Its surface.
    pub shape: Box<dyn SignedDistance<D>>,
    /// What it does to material at it.
    pub contact: Contact,
    /// Velocity of its surface. The shape itself is moved by whoever drives the steps.
    pub velocity: [f64; D],
}

impl<const D: usize> Obstacle<D> {
    pub(super) fn constrain<B: Basis<D>, N: GridNode<D>>(
        &self,
        basis: &B,
        motion: &GridMotion<D>,
        scratch: (&[f64], &mut Vec<f64>),
        nodes: &mut [N],
    ) {
        let close = ON_A_SURFACE * basis.spacing();
        let numbered = motion.positions.iter().enumerate();
        let inside = numbered.filter(|(_, x)| self.shape.distance(x) <= close);
        let inside: Vec<usize> = inside.map(|(number, _)| number).collect();
        let surface = Surface {
            contact: self.contact,
            velocity: &self.velocity,
            distance: &|x| self.shape.distance_of_particle(x),
            normal: &|x| self.shape.normal(x),
            image: &|x| self.shape.image(x),
        };
        surface.act(basis, motion, &inside, scratch, nodes);
    }
}
