//! Materials and bodies.

use crate::scene::{BodyTable, FillKind, Scene};
use crate::values::{positive, within};
use crate::{SceneFault, law, shape, vector_field};

/// Particles per axis of a cell, at most, and with the basis `gimp`, which is compiled for each number.
const MOST_PER_AXIS: u32 = 16;
const MOST_PER_AXIS_GIMP: u32 = 4;

impl Scene {
    pub(super) fn check_bodies<const D: usize>(&self) -> Result<(), SceneFault> {
        for (name, table) in &self.materials {
            law::build::<2>(&format!("materials.{name}"), table)?;
        }
        within("bodies", [0; 0], !self.bodies.is_empty(), "at least one body")?;
        for (index, body) in self.bodies.iter().enumerate() {
            let twice = self.bodies[..index].iter().any(|other| other.name == body.name);
            let (name, own) = (&body.name, !body.name.is_empty() && !twice);
            within(&format!("bodies[{index}].name"), name, own, "a name of its own")?;
            let field = |key: &str| format!("bodies.{}.{key}", body.name);
            shape::build::<D>(&field("shape"), &body.shape)?;
            let names: Vec<&String> = self.materials.keys().collect();
            let known = names.contains(&&body.material);
            within(&field("material"), &body.material, known, &format!("one of {names:?}"))?;
            self.check_particles_per_axis(&field("particles_per_axis"), body.per_axis())?;
            self.check_filling(&field, body)?;
            Self::check_rotation::<D>(&field("rotation"), body.rotation.as_ref())?;
            positive(&field("deformation"), body.deformation.unwrap_or(1.0))?;
            vector_field::build::<D>(&field("velocity"), body.velocity.as_ref(), self)?;
        }
        Ok(())
    }

    fn check_particles_per_axis(&self, field: &str, count: u32) -> Result<(), SceneFault> {
        let gimp = self.is_gimp();
        let most = if gimp { MOST_PER_AXIS_GIMP } else { MOST_PER_AXIS };
        within(
            field,
            count,
            (1..=most).contains(&count),
            &format!("between 1 and {most}"),
        )?;
        let same = !gimp || self.bodies.iter().all(|body| body.per_axis() == count);
        within(field, count, same, "the same for all bodies with grid.basis = \"gimp\"").map(drop)
    }

    /// Whether the keys of a filling are those of its kind.
    fn check_filling(&self, field: &dyn Fn(&str) -> String, body: &BodyTable) -> Result<(), SceneFault> {
        if let Some(spacing) = body.spacing {
            positive(&field("spacing"), spacing)?;
            let expected = "left out with grid.basis = \"gimp\"";
            within(&field("spacing"), spacing, !self.is_gimp(), expected)?;
            let (count, expected) = (body.particles_per_axis, "left out where there is a spacing");
            within(&field("particles_per_axis"), count, count.is_none(), expected)?;
        }
        let drawn = matches!(body.fill, FillKind::PoissonDisk | FillKind::Random);
        let expected = "left out unless fill = \"poisson-disk\" or \"random\"";
        within(&field("seed"), body.seed, drawn || body.seed.is_none(), expected)?;
        let (valid, expected) = match body.fill {
            FillKind::Random => (body.particles > Some(0), "at least 1 with fill = \"random\""),
            _ => (body.particles.is_none(), "left out unless fill = \"random\""),
        };
        within(&field("particles"), body.particles, valid, expected).map(drop)
    }

    /// Whether a body that is referred to exists.
    pub(super) fn check_body_name(&self, field: String, name: Option<&String>) -> Result<(), SceneFault> {
        let names: Vec<&String> = self.bodies.iter().map(|body| &body.name).collect();
        let known = name.is_none_or(|name| names.contains(&name));
        within(&field, name, known, &format!("one of {names:?}")).map(drop)
    }
}
