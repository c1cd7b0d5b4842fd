//! The particles of all bodies at t = 0.

use crate::fill::{Filling, poisson_disk, regular, rings};
use crate::scene::{BodyTable, FillKind, Scene};
use crate::shape::{Bounds, Shape};
use crate::values::vector;
use crate::{SceneFault, shape, velocity};

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
    /// Number of the body.
    pub bodies: Vec<u32>,
    /// Number of the material, in the order of the names.
    pub materials: Vec<u32>,
}

impl<const D: usize> Population<D> {
    /// Fills the bodies of a scene.
    ///
    /// # Errors
    /// [`SceneFault::EmptyBody`], [`SceneFault::Overlap`] for a particle inside the shape of another body, [`SceneFault::OutsideDomain`], and
    /// [`SceneFault::Value`] for more particles than can be numbered.
    pub fn fill(scene: &Scene) -> Result<Self, SceneFault> {
        let room = domain(scene)?;
        let mut all = Self::default();
        let mut shapes: Vec<Box<dyn Shape<D>>> = Vec::new();
        for (number, body) in scene.bodies.iter().enumerate() {
            let shape = shape::build::<D>(&format!("bodies.{}.shape", body.name), &body.shape)?;
            let filling = fill(scene, body, &*shape, &room)?;
            if filling.positions.is_empty() {
                return Err(SceneFault::EmptyBody {
                    body: body.name.clone(),
                });
            }
            all.add(scene, number, &filling)?;
            shapes.push(shape);
        }
        all.check_places(scene, &shapes, &room)?;
        Ok(all)
    }

    fn add(&mut self, scene: &Scene, number: usize, filling: &Filling<D>) -> Result<(), SceneFault> {
        let Some(body) = scene.bodies.get(number) else {
            return Ok(());
        };
        let field = format!("bodies.{}.velocity", body.name);
        let velocity = velocity::build::<D>(&field, body.velocity.as_ref(), scene)?;
        let material = scene.materials.keys().position(|name| *name == body.material);
        let density = scene
            .materials
            .get(&body.material)
            .map_or(f64::NAN, |table| table.density());
        let total = self.positions.len() + filling.positions.len();
        if u32::try_from(total).is_err() {
            let expected = format!("so wide that there are at most {} particles", u32::MAX);
            return Err(SceneFault::value("grid.spacing", scene.grid.spacing, expected));
        }
        self.velocities.extend(filling.positions.iter().map(|x| velocity.at(x)));
        self.positions.extend(&filling.positions);
        self.masses.resize(total, density * filling.volume);
        self.volumes.resize(total, filling.volume);
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

/// The domain of a scene.
///
/// # Errors
/// [`SceneFault::Value`] for corners of another dimension.
pub(crate) fn domain<const D: usize>(scene: &Scene) -> Result<Bounds<D>, SceneFault> {
    Ok(Bounds {
        lower: vector("domain.lower", &scene.domain.lower)?,
        upper: vector("domain.upper", &scene.domain.upper)?,
    })
}

fn fill<const D: usize>(
    scene: &Scene,
    body: &BodyTable,
    shape: &dyn Shape<D>,
    room: &Bounds<D>,
) -> Result<Filling<D>, SceneFault> {
    let step = scene.grid.spacing / f64::from(body.particles_per_axis);
    match body.fill {
        FillKind::Regular => regular(shape, &room.lower, step, room),
        FillKind::PoissonDisk => poisson_disk(shape, step, room, body.seed),
        FillKind::Rings => rings(&format!("bodies.{}", body.name), shape, step, room),
    }
}
