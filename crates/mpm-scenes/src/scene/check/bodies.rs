//! Materials and bodies.

use crate::scene::{BodyTable, FillKind, Scene};
use crate::values::positive;
use crate::{SceneFault, law, shape, velocity};

/// Particles per axis of a cell, at most, and with the basis `gimp`, which is compiled for each number.
const MOST_PER_AXIS: u32 = 16;
const MOST_PER_AXIS_GIMP: u32 = 4;

impl Scene {
    pub(super) fn check_bodies<const D: usize>(&self) -> Result<(), SceneFault> {
        for (name, table) in &self.materials {
            law::build::<2>(&format!("materials.{name}"), table)?;
        }
        if self.bodies.is_empty() {
            return Err(SceneFault::value("bodies", [0; 0], "at least one body"));
        }
        for (index, body) in self.bodies.iter().enumerate() {
            let twice = self.bodies[..index].iter().any(|other| other.name == body.name);
            if body.name.is_empty() || twice {
                return Err(SceneFault::value(
                    format!("bodies[{index}].name"),
                    &body.name,
                    "a name of its own",
                ));
            }
            let field = |key: &str| format!("bodies.{}.{key}", body.name);
            shape::build::<D>(&field("shape"), &body.shape)?;
            if !self.materials.contains_key(&body.material) {
                let names: Vec<&String> = self.materials.keys().collect();
                return Err(SceneFault::value(
                    field("material"),
                    &body.material,
                    format!("one of {names:?}"),
                ));
            }
            self.check_particles_per_axis(&field("particles_per_axis"), body.per_axis())?;
            self.check_filling(&field, body)?;
            Self::check_rotation::<D>(&field("rotation"), body.rotation.as_ref())?;
            positive(&field("deformation"), body.deformation.unwrap_or(1.0))?;
            velocity::build::<D>(&field("velocity"), body.velocity.as_ref(), self)?;
        }
        Ok(())
    }

    fn check_particles_per_axis(&self, field: &str, count: u32) -> Result<(), SceneFault> {
        let gimp = self.is_gimp();
        let most = if gimp { MOST_PER_AXIS_GIMP } else { MOST_PER_AXIS };
        if !(1..=most).contains(&count) {
            return Err(SceneFault::value(field, count, format!("between 1 and {most}")));
        }
        if gimp && self.bodies.iter().any(|body| body.per_axis() != count) {
            return Err(SceneFault::value(
                field,
                count,
                "the same for all bodies with grid.basis = \"gimp\"",
            ));
        }
        Ok(())
    }

    /// Whether the keys of a filling are those of its kind.
    fn check_filling(&self, field: &dyn Fn(&str) -> String, body: &BodyTable) -> Result<(), SceneFault> {
        if let Some(spacing) = body.spacing {
            positive(&field("spacing"), spacing)?;
            if self.is_gimp() {
                let expected = "left out with grid.basis = \"gimp\"";
                return Err(SceneFault::value(field("spacing"), spacing, expected));
            }
            if let Some(count) = body.particles_per_axis {
                let expected = "left out where there is a spacing";
                return Err(SceneFault::value(field("particles_per_axis"), count, expected));
            }
        }
        match (body.fill, body.particles) {
            (FillKind::Random, None | Some(0)) => {
                let expected = "at least 1 with fill = \"random\"";
                Err(SceneFault::value(field("particles"), body.particles, expected))
            }
            (FillKind::Random, Some(_)) | (_, None) => Ok(()),
            (_, Some(count)) => {
                let expected = "left out unless fill = \"random\"";
                Err(SceneFault::value(field("particles"), count, expected))
            }
        }
    }

    /// Whether a body that is referred to exists.
    pub(super) fn check_body_name(&self, field: String, name: Option<&String>) -> Result<(), SceneFault> {
        match name {
            Some(name) if self.bodies.iter().all(|body| body.name != *name) => {
                let names: Vec<&String> = self.bodies.iter().map(|body| &body.name).collect();
                Err(SceneFault::value(field, name, format!("one of {names:?}")))
            }
            _ => Ok(()),
        }
    }
}
