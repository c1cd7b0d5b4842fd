//! Loads and the barrier.

use crate::scene::{LoadTable, Scene, amplitude};
use crate::values::{not_negative, positive, vector, within};
use crate::{SceneFault, reference, shape};

impl Scene {
    pub(super) fn check_forces<const D: usize>(&self) -> Result<(), SceneFault> {
        for (index, load) in self.loads.iter().enumerate() {
            let field = |key: &str| format!("loads[{index}].{key}");
            match load {
                LoadTable::Traction { thickness, .. } => drop(positive(&field("thickness"), *thickness)?),
                LoadTable::Manufactured { solution } => drop(reference::manufactured(solution, self)?),
                LoadTable::PointForce { .. } => {}
            }
            if let Some(part) = load.part() {
                let (key, force) = part.force;
                vector::<D>(&field(key), force)?;
                shape::build::<D>(&field("region"), part.region)?;
                self.check_body_name(field("body"), part.body)?;
                amplitude(&field, part.ramp, part.amplitude)?;
            }
        }
        self.check_barrier::<D>()
    }

    fn check_barrier<const D: usize>(&self) -> Result<(), SceneFault> {
        let Some(barrier) = &self.barrier else { return Ok(()) };
        let (against, some) = (barrier.against, !barrier.shapes.is_empty());
        within(
            "barrier.shapes",
            [0; 0],
            some || against.is_some(),
            "at least one shape, unless against = \"mesh\" is given",
        )?;
        let on_mesh = self.mesh.is_some() || against.is_none();
        within("barrier.against", against, on_mesh, "left out unless there is a [mesh]")?;
        for (index, table) in barrier.shapes.iter().enumerate() {
            shape::build::<D>(&format!("barrier.shapes[{index}]"), table)?;
        }
        positive("barrier.stiffness", barrier.stiffness)?;
        positive("barrier.gap", barrier.gap)?;
        not_negative("barrier.friction", barrier.friction)?;
        not_negative("barrier.friction_speed", barrier.friction_speed).map(drop)
    }
}
