use super::Contact;
use super::mirror::mirror;
use crate::{Basis, GridNode};

/// The side of the domain that a wall stands on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The domain lies above the wall.
    Lower,
    /// The domain lies below the wall.
    Upper,
}

/// A plane wall across an axis, endless in the others.
///
/// The splines of nodes behind the wall reach into the domain. Where the wall stands on nodes and the material cannot leave
/// it ([`Contact::Stick`], [`Contact::Slip`]), such a node is the image of its mirror node: the field of velocities is odd (or, along a
/// sliding wall, even) about the wall, so the condition holds on the wall itself and the order of the basis is kept. The
/// pair moves with the momentum both have (the Galerkin method on the odd or even fields), so mass and momentum
/// along the wall are conserved. Where the wall stands between nodes, or material may leave, the condition holds at the
/// nodes on and behind the wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wall<const D: usize> {
    /// The axis the wall is normal to; below D.
    pub axis: usize,
    /// Which side of the domain it stands on.
    pub side: Side,
    /// Its coordinate on the axis.
    pub position: f64,
    /// What it does to material at it.
    pub contact: Contact,
    /// Velocity of its surface. The wall itself stays where it is.
    pub velocity: [f64; D],
}

/// Nodes this close to the wall, in spacings, stand on it.
const ON_THE_WALL: f64 = 1e-6;

impl<const D: usize> Wall<D> {
    pub(super) fn constrain<B: Basis<D>, N: GridNode<D>>(
        &self,
        basis: &B,
        positions: &[[f64; D]],
        masses: &mut [f64],
        nodes: &mut [N],
    ) {
        let inward = match self.side {
            Side::Lower => 1.0,
            Side::Upper => -1.0,
        };
        let normal: [f64; D] = std::array::from_fn(|a| if a == self.axis { inward } else { 0.0 });
        let close = ON_THE_WALL * basis.spacing();
        let mirrored = !matches!(self.contact, Contact::Separate { .. });
        for (number, x) in positions.iter().enumerate() {
            let height = inward * (x[self.axis] - self.position);
            if height > close {
                continue;
            }
            if mirrored && height < -close {
                let mut image = *x;
                image[self.axis] = 2.0 * self.position - x[self.axis];
                if let Some(inner) = basis.node_number(&image) {
                    let odd: [bool; D] = std::array::from_fn(|a| a == self.axis || self.contact == Contact::Stick);
                    mirror([number, inner as usize], &odd, &self.velocity, masses, nodes);
                    continue;
                }
            }
            let v = nodes[number].velocity_mut();
            let relative = std::array::from_fn(|a| v[a] - self.velocity[a]);
            let left = self.contact.resolve(&normal, &relative);
            for a in 0..D {
                v[a] = self.velocity[a] + left[a];
            }
        }
    }
}
