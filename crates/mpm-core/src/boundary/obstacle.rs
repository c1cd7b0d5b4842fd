use super::{Contact, SignedDistance};
use crate::GridNode;

/// A rigid body that moves with a given velocity or rests; it acts on the nodes inside it.
pub struct Obstacle<const D: usize> {
    /// Its surface.
    pub shape: Box<dyn SignedDistance<D>>,
    /// What it does to material at it.
    pub contact: Contact,
    /// Velocity of its surface. The shape itself is moved by whoever drives the steps.
    pub velocity: [f64; D],
}

impl<const D: usize> Obstacle<D> {
    pub(super) fn constrain<N: GridNode<D>>(&self, positions: &[[f64; D]], nodes: &mut [N]) {
        for (x, node) in positions.iter().zip(nodes) {
            if self.shape.distance(x) <= 0.0 {
                let v = node.velocity_mut();
                let relative = std::array::from_fn(|a| v[a] - self.velocity[a]);
                let left = self.contact.resolve(&self.shape.normal(x), &relative);
                for a in 0..D {
                    v[a] = self.velocity[a] + left[a];
                }
            }
        }
    }
}
