//! The boundary of a mesh where material does not leave it.

use mpm_tensor::vector;

use super::Contact;
use super::image_solve::{Free, NO_UNKNOWN, Work, at_mirror};
use crate::error::within;
use crate::{Basis, GridNode, MpmError};

/// A part of the boundary of a mesh that material sticks to or slides along, and the nodes behind it.
///
/// At its own nodes the condition holds. To hold the nodes behind it as well would be a condition at the wrong places, an error of first order (docs/mechanics.md, section 3): their velocities are images. With
/// û = Σ_k b_k v_k at the mirror point of a node, v* the velocity of the surface between the two, and R u = −u where it holds, R u = u − 2 (n·u) n where it lets slide,
///
/// v = v* + R (û − v*).
///
/// So a field that is linear and keeps the condition is kept. Of all such fields the nodes get the one that is nearest to the velocities that they would have without, by Σ m |·|² (Galerkin's method on the
/// fields that are images): kinetic energy does not grow, and momentum along a sliding plane is kept. Of pairs of mirror images that is what [`Plane`](super::Plane) does.
pub struct HeldSurface<const D: usize> {
    /// Its nodes.
    pub held: Vec<HeldNode<D>>,
    /// Those behind it.
    pub images: Vec<ImageNode<D>>,
    /// Whether material slides along it; it sticks otherwise.
    pub slides: bool,
    work: Work<D>,
}

/// A node on a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeldNode<const D: usize> {
    /// Where it is.
    pub position: [f64; D],
    /// Unit normal of the surface there; 0 where there is none, which lets slide in all directions.
    pub normal: [f64; D],
    /// Velocity of the surface there.
    pub velocity: [f64; D],
}

/// A node behind a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct ImageNode<const D: usize> {
    /// The node, with normal and velocity of the surface between it and its mirror point.
    pub node: HeldNode<D>,
    /// Positions of the nodes around its mirror point and their shares b_k, from 0 to 1 and of sum one. Where there are none, or one of them is not active, the node is held.
    pub sources: Vec<([f64; D], f64)>,
}

impl<const D: usize> HeldSurface<D> {
    /// A surface with these nodes on it and behind it.
    pub fn new(held: Vec<HeldNode<D>>, images: Vec<ImageNode<D>>, slides: bool) -> Self {
        let work = Work::default();
        Self {
            held,
            images,
            slides,
            work,
        }
    }

    /// 0 ≤ b ≤ 1.
    pub(super) fn check(&self) -> Result<(), MpmError> {
        let mut shares = self
            .images
            .iter()
            .flat_map(|image| &image.sources)
            .map(|source| source.1);
        let bad = shares.find(|share| !(0.0..=1.0).contains(share));
        bad.map_or(Ok(()), |share| within("share of an image", share, false, "from 0 to 1"))
    }

    /// The condition at the nodes of the surface.
    pub(super) fn hold<B: Basis<D>, N: GridNode<D>>(&self, basis: &B, nodes: &mut [N]) {
        for held in &self.held {
            if let Some(number) = basis.node_number(&held.position) {
                self.hold_node(held, nodes[number as usize].velocity_mut());
            }
        }
    }

    fn hold_node(&self, node: &HeldNode<D>, velocity: &mut [f64; D]) {
        let relative = vector::subtract(velocity, &node.velocity);
        *velocity = vector::add(&node.velocity, &self.contact().resolve(&node.normal, &relative));
    }

    fn contact(&self) -> Contact {
        if self.slides { Contact::Slip } else { Contact::Stick }
    }

    /// v* + R (v − v*).
    fn image(&self, node: &HeldNode<D>, velocity: &[f64; D]) -> [f64; D] {
        let relative = vector::subtract(velocity, &node.velocity);
        let reflected = if self.slides {
            vector::add_scaled(&relative, -2.0 * vector::dot(&node.normal, &relative), &node.normal)
        } else {
            relative.map(|c| -c)
        };
        vector::add(&node.velocity, &reflected)
    }

    /// The condition at the nodes of the surface and behind it. `masses` become those that unknowns and images have together, so that a second surface sees the right weights in a corner.
    pub(super) fn constrain<B: Basis<D>, N: GridNode<D>>(&mut self, basis: &B, masses: &mut [f64], nodes: &mut [N]) {
        self.hold(basis, nodes);
        let mut work = std::mem::take(&mut self.work);
        self.collect(basis, &mut work, nodes);
        work.begin(
            masses,
            |image, number, at_mirror| {
                vector::subtract(
                    &self.image(&self.images[image].node, nodes[number].velocity()),
                    at_mirror,
                )
            },
            |number| *nodes[number].velocity(),
        );
        work.solve(masses);
        for (&number, change) in work.numbers.iter().zip(&work.change) {
            vector::accumulate(nodes[number].velocity_mut(), 1.0, change);
        }
        for (image, number, sources) in work.with_sources() {
            let at_mirror = at_mirror(sources, |unknown| *nodes[work.numbers[unknown]].velocity());
            *nodes[number].velocity_mut() = self.image(&self.images[image].node, &at_mirror);
        }
        work.join(masses);
        self.work = work;
    }

    /// Which images have their sources; the others are held.
    fn collect<B: Basis<D>, N: GridNode<D>>(&self, basis: &B, work: &mut Work<D>, nodes: &mut [N]) {
        work.images.clear();
        work.sources.clear();
        work.numbers.clear();
        work.free.clear();
        work.places.clear();
        work.places.resize(nodes.len(), NO_UNKNOWN);
        for (index, image) in self.images.iter().enumerate() {
            let Some(number) = basis.node_number(&image.node.position) else {
                continue;
            };
            let active = |(x, _): &([f64; D], f64)| basis.node_number(x).is_some();
            if image.sources.is_empty() || !image.sources.iter().all(active) {
                self.hold_node(&image.node, nodes[number as usize].velocity_mut());
                continue;
            }
            for (x, share) in &image.sources {
                if let Some(source) = basis.node_number(x) {
                    let unknown = work.unknown(source as usize);
                    work.sources.push((unknown, *share));
                }
            }
            work.images.push((index, number as usize, work.sources.len()));
        }
        for held in &self.held {
            let number = basis.node_number(&held.position);
            let place = number.map_or(NO_UNKNOWN, |number| work.places[number as usize]);
            if place != NO_UNKNOWN {
                work.free[place as usize] = if self.slides {
                    Free::Along(held.normal)
                } else {
                    Free::Nothing
                };
            }
        }
    }
}
