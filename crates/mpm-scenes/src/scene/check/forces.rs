//! Loads and the barrier.

use crate::scene::{LoadTable, Scene};
use crate::values::{not_negative, positive, vector};
use crate::{SceneFault, reference, shape};

impl Scene {
    pub(super) fn check_forces<const D: usize>(&self) -> Result<(), SceneFault> {
        for (index, load) in self.loads.iter().enumerate() {
            let field = |key: &str| format!("loads[{index}].{key}");
            let (region, body, ramp) = match load {
                LoadTable::PointForce {
                    region,
                    body,
                    force,
                    ramp,
                } => {
                    vector::<D>(&field("force"), force)?;
                    (region, body, *ramp)
                }
                LoadTable::Traction {
                    region,
                    body,
                    traction,
                    thickness,
                    ramp,
                } => {
                    vector::<D>(&field("traction"), traction)?;
                    positive(&field("thickness"), *thickness)?;
                    (region, body, *ramp)
                }
                LoadTable::Manufactured { solution } => {
                    reference::manufactured(solution, self)?;
                    continue;
                }
            };
            shape::build::<D>(&field("region"), region)?;
            self.check_body_name(field("body"), body.as_ref())?;
            not_negative(&field("ramp"), ramp)?;
        }
        self.check_barrier::<D>()
    }

    fn check_barrier<const D: usize>(&self) -> Result<(), SceneFault> {
        let Some(barrier) = &self.barrier else { return Ok(()) };
        match barrier.against {
            None if barrier.shapes.is_empty() => {
                return Err(SceneFault::value("barrier.shapes", [0; 0], "at least one shape"));
            }
            Some(against) if self.mesh.is_none() => {
                return Err(SceneFault::value(
                    "barrier.against",
                    against,
                    "left out unless there is a [mesh]",
                ));
            }
            _ => {}
        }
        for (index, table) in barrier.shapes.iter().enumerate() {
            shape::build::<D>(&format!("barrier.shapes[{index}]"), table)?;
        }
        positive("barrier.stiffness", barrier.stiffness)?;
        positive("barrier.gap", barrier.gap)?;
        not_negative("barrier.friction", barrier.friction)?;
        match barrier.friction_speed {
            Some(speed) => positive("barrier.friction_speed", speed).map(|_| ()),
            None if barrier.friction > 0.0 => Err(SceneFault::missing(
                "barrier.friction_speed",
                "given where there is friction",
            )),
            None => Ok(()),
        }
    }
}
