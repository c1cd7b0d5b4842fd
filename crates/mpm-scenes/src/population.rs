//! The particles of all bodies at t = 0.

use crate::background::{Background, of_shape};
use crate::fill::{Filling, centroids, in_cells, poisson_disk, random, regular, rings, vertices};
use crate::scene::{BodyTable, FillKind, Scene};
use crate::shape::{Bounds, Rotated, Shape};
use crate::values::within;
use crate::{SceneFault, plane, rotation, shape, vector_field};

/// All particles in the order of creation, which is that of the bodies; one entry per particle in every list.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Population<const D: usize> {
    /// X_p.
    pub positions: Vec<[f64; D]>,
    /// v_p at t = 0.
    pub velocities: Vec<[f64; D]>,
    /// m_p = ρ₀ V⁰_p.
    pub masses: Vec<f64>,
    /// V⁰_p.
    pub volumes: Vec<f64>,
    /// λ in F = λ 1 at t = 0.
    pub stretches: Vec<f64>,
    /// Number of the body.
    pub bodies: Vec<u32>,
    /// Number of the material, in the order of the names.
    pub materials: Vec<u32>,
}

impl<const D: usize> Population<D> {
    /// Fills the bodies of a scene.
    ///
    /// # Errors
    /// [`SceneFault::EmptyBody`], [`SceneFault::Overlap`] for a particle inside the shape of another body, [`SceneFault::OutsideDomain`],
    /// [`SceneFault::BehindWall`], and [`SceneFault::Value`] for more particles than can be numbered.
    pub fn fill(scene: &Scene) -> Result<Self, SceneFault> {
        Self::fill_on(scene, &Background::build(scene)?)
    }

    /// As [`fill`](Self::fill), on a background that has been made.
    pub(crate) fn fill_on(scene: &Scene, background: &Background<D>) -> Result<Self, SceneFault> {
        let mut all = Self::default();
        let mut shapes: Vec<Box<dyn Shape<D>>> = Vec::new();
        for (number, body) in scene.bodies.iter().enumerate() {
            let field = |key: &str| format!("bodies.{}.{key}", body.name);
            let mut shape = shape::build::<D>(&field("shape"), &body.shape)?;
            let mut filling = fill(body, &*shape, background).map_err(|fault| by_distance(fault, body, background))?;
            if let Some(rotation) = rotation::build(&field("rotation"), body.rotation.as_ref())? {
                filling.positions.iter_mut().for_each(|x| *x = rotation.apply(x));
                shape = Box::new(Rotated { shape, rotation });
            }
            if filling.positions.is_empty() {
                return Err(SceneFault::EmptyBody {
                    body: body.name.clone(),
                });
            }
            all.add(scene, number, &filling)?;
            shapes.push(shape);
        }
        all.check_places(scene, &shapes, background.room())?;
        plane::check_sides(
            scene,
            background.room(),
            background.spacing(),
            &all.positions,
            &all.bodies,
        )?;
        Ok(all)
    }

    /// The name of the body of a particle.
    pub(crate) fn body(&self, scene: &Scene, particle: usize) -> Option<String> {
        let number = *self.bodies.get(particle)? as usize;
        Some(scene.bodies.get(number)?.name.clone())
    }

    /// The side of the cube that a particle takes up.
    pub(crate) fn width(&self, particle: usize) -> f64 {
        self.stretches[particle] * self.volumes[particle].powf(1.0 / D as f64)
    }

    fn add(&mut self, scene: &Scene, number: usize, filling: &Filling<D>) -> Result<(), SceneFault> {
        let Some(body) = scene.bodies.get(number) else {
            return Ok(());
        };
        let field = format!("bodies.{}.velocity", body.name);
        let velocity = vector_field::build::<D>(&field, body.velocity.as_ref(), scene)?;
        let material = scene.materials.keys().position(|name| *name == body.material);
        let density = scene
            .materials
            .get(&body.material)
            .map_or(f64::NAN, |table| table.density());
        let total = self.positions.len() + filling.positions.len();
        let few = u32::try_from(total).is_ok();
        let expected = "so few that they can be numbered with 32 bits";
        within(&format!("bodies.{}", body.name), total, few, expected)?;
        self.velocities.extend(filling.positions.iter().map(|x| velocity.at(x)));
        self.positions.extend(&filling.positions);
        // The shape is that of the deformed body, V = λᴰ V⁰.
        let stretch = body.deformation.unwrap_or(1.0);
        let ratio = stretch.powi(D as i32);
        self.volumes.extend(filling.volumes.iter().map(|volume| volume / ratio));
        self.masses
            .extend(filling.volumes.iter().map(|volume| density * (volume / ratio)));
        self.stretches.resize(total, stretch);
        self.bodies.resize(total, number as u32);
        self.materials.resize(total, material.unwrap_or(0) as u32);
        Ok(())
    }

    /// Whether every particle is in the domain and in no other body.
    fn check_places(&self, scene: &Scene, shapes: &[Box<dyn Shape<D>>], room: &Bounds<D>) -> Result<(), SceneFault> {
        let name = |number: usize| scene.bodies.get(number).map_or(String::new(), |body| body.name.clone());
        for (particle, (x, &own)) in self.positions.iter().zip(&self.bodies).enumerate() {
            let own = own as usize;
            if !room.contains(x) {
                return Err(SceneFault::OutsideDomain {
                    body: name(own),
                    particle,
                    position: x.to_vec(),
                    lower: room.lower.to_vec(),
                    upper: room.upper.to_vec(),
                });
            }
            let others = shapes.iter().enumerate().filter(|&(number, _)| number != own);
            for (number, shape) in others {
                if shape.distance(x) < 0.0 {
                    return Err(SceneFault::Overlap {
                        first: name(number),
                        second: name(own),
                        position: x.to_vec(),
                    });
                }
            }
        }
        Ok(())
    }
}

/// Error of the volume of a filling, over the volume of its shape, that staircases of a lattice along its edges may leave.
const STAIRCASES: f64 = 0.02;

/// A filling that stands for all of its shape: where a lattice has too many or too few points in it for its own volume, as it has where sides are no multiples of its step, they share that of the shape.
fn of_volume<const D: usize>(filling: Filling<D>, shape: &dyn Shape<D>, room: &Bounds<D>) -> Filling<D> {
    let bounds = shape.bounds();
    let volume = shape.volume().filter(|_| bounds == bounds.finite_within(room));
    match volume {
        Some(volume) if (filling.volume() / volume - 1.0).abs() > STAIRCASES => {
            let each = volume / filling.positions.len().max(1) as f64;
            Filling::of_equal(filling.positions, each)
        }
        _ => filling,
    }
}

/// The distance between the particles of a body.
fn step<const D: usize>(body: &BodyTable, background: &Background<D>) -> f64 {
    let of_cells = || background.spacing() / f64::from(body.per_axis());
    body.spacing.unwrap_or_else(of_cells)
}

/// The fault of too many points with the distance that the file asks for, and the key that does: a filling may count on a finer lattice.
fn by_distance<const D: usize>(mut fault: SceneFault, body: &BodyTable, background: &Background<D>) -> SceneFault {
    if let SceneFault::TooManyPoints { key, distance, .. } = &mut fault {
        *distance = step(body, background);
        if body.spacing.is_none() {
            *key = "particles_per_axis";
        }
    }
    fault
}

/// Fills a shape before it is turned.
fn fill<const D: usize>(
    body: &BodyTable,
    shape: &dyn Shape<D>,
    background: &Background<D>,
) -> Result<Filling<D>, SceneFault> {
    let field = format!("bodies.{}", body.name);
    let step = step(body, background);
    let (room, seed) = (background.room(), body.seed.unwrap_or(0));
    let mesh = || of_shape::<D>(&format!("{field}.shape"), &body.shape, step);
    match body.fill {
        FillKind::Regular => {
            // A lattice of its own begins at the shape, and ends there where the mesh says about how far apart particles are; that of a grid begins at the grid's first node.
            let bounds = shape.bounds().finite_within(room);
            let (origin, steps) = match (body.spacing, background) {
                (Some(_), _) => (bounds.lower, [step; D]),
                (None, Background::Mesh { .. }) => (
                    bounds.lower,
                    bounds.sides().map(|side| side / (side / step).round().max(1.0)),
                ),
                (None, Background::Grid { .. }) => (room.lower, [step; D]),
            };
            regular(&body.name, shape, &origin, &steps, room).map(|filling| of_volume(filling, shape, room))
        }
        FillKind::PoissonDisk => poisson_disk(&body.name, shape, step, room, seed),
        FillKind::Rings => rings(&body.name, shape, step, room),
        FillKind::Random => random(&body.name, shape, body.particles.unwrap_or(0), room, seed),
        FillKind::Vertices => Ok(vertices(&mesh()?)),
        FillKind::Centroids => Ok(centroids(&mesh()?)),
        FillKind::Cells => match background {
            Background::Mesh { inner, .. } => Ok(in_cells(inner, shape, body.per_axis())),
            Background::Grid { .. } => Err(SceneFault::value(
                format!("{field}.fill"),
                "cells",
                "with a [mesh] only",
            )),
        },
    }
}
