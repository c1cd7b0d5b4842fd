use mpm_tensor::vector;

use super::folds::face_each_other;
use super::mirror::mirror;
use super::role::{Role, Roles};
use super::surface::{ON_A_SURFACE, Surface};
use super::{Contact, GridMotion};
use crate::{Basis, GridNode};

/// A plane wall, endless.
///
/// The shape functions of nodes behind the wall reach into the domain. Where the basis has a node at the mirror image of such a node and the material
/// cannot leave the wall ([`Contact::Stick`], [`Contact::Slip`]), the node is the image of its mirror node: the field of velocities is
/// odd (or, along a sliding wall, even) about the wall, so the condition holds on the wall itself and the order of the basis is kept. The
/// pair moves with the momentum both have (the Galerkin method on the odd or even fields), so mass and momentum
/// along the wall are conserved. Images of images, between walls that are a few nodes apart, are images, too. Where material may leave, the condition holds for the mean velocity of such a pair, that on the wall between them, and
/// the material meets the wall where its particles do ([`Contact::Separate`]). Elsewhere the condition holds at the nodes on and behind the wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane<const D: usize> {
    /// A point of the wall.
    pub point: [f64; D],
    /// Unit normal, into the domain.
    pub normal: [f64; D],
    /// What it does to material at it.
    pub contact: Contact,
    /// Velocity of its surface. The wall itself stays where it is.
    pub velocity: [f64; D],
}

impl<const D: usize> Plane<D> {
    /// Whether nodes behind it are images.
    pub(super) fn mirrors(&self) -> bool {
        !matches!(self.contact, Contact::Separate { .. })
    }

    /// Height of x above it.
    pub(super) fn height(&self, x: &[f64; D]) -> f64 {
        vector::dot(&self.normal, &vector::subtract(x, &self.point))
    }

    /// R u, of a velocity u relative to a wall that mirrors: −u where it holds, u − 2 (n·u) n where it lets slide.
    pub(super) fn reflect_relative(&self, u: &[f64; D]) -> [f64; D] {
        match self.contact {
            Contact::Slip => vector::add_scaled(u, -2.0 * vector::dot(&self.normal, u), &self.normal),
            _ => u.map(|c| -c),
        }
    }

    /// V + R (v − V).
    pub(super) fn reflect(&self, v: &[f64; D]) -> [f64; D] {
        let relative = vector::subtract(v, &self.velocity);
        vector::add(&self.velocity, &self.reflect_relative(&relative))
    }

    pub(super) fn constrain<B: Basis<D>, N: GridNode<D>>(
        &self,
        basis: &B,
        motion: &GridMotion<D>,
        (roles, walls): (&Roles, &[Self]),
        (masses, gaps): (&mut [f64], &mut Vec<f64>),
        nodes: &mut [N],
    ) {
        let close = ON_A_SURFACE * basis.spacing();
        let distance = |x: &[f64; D]| self.height(x);
        let mut at = Vec::new();
        for (number, x) in motion.positions.iter().enumerate() {
            let height = distance(x);
            let role = roles.of(number);
            if height > close || role == Role::Image {
                continue;
            }
            if self.mirrors() && role == Role::Own && height < -close {
                let image = vector::add_scaled(x, -2.0 * height, &self.normal);
                if let Some(inner) = basis.node_number(&image) {
                    mirror(self, [number, inner as usize], masses, nodes);
                    continue;
                }
            }
            at.push(number);
        }
        let surface = Surface {
            contact: self.contact,
            velocity: &self.velocity,
            distance: &distance,
            normal: &|_| self.normal,
            image: &|x| {
                let height = self.height(x);
                let image = vector::add_scaled(x, -2.0 * height, &self.normal);
                let is_free = |wall: &Self| !face_each_other(self, wall) || wall.height(&image) > close;
                (height < -close && walls.iter().all(is_free)).then_some(image)
            },
        };
        surface.act(basis, motion, &at, (masses, gaps), nodes);
    }
}
