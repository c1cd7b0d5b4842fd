//! Walls, obstacles, held regions and kinematic particles.

use crate::scene::{Contact, DomainTable, Scene, WallCondition};
use crate::shape::Bounds;
use crate::values::{check, not_negative, positive, vector};
use crate::{SceneFault, kinematics, plane, shape};

impl Scene {
    pub(super) fn check_boundaries<const D: usize>(&self) -> Result<(), SceneFault> {
        for (index, wall) in self.walls.iter().enumerate() {
            let field = |key: &str| format!("walls[{index}].{key}");
            // Without a domain the border is known when the mesh is; here any will do.
            plane::build::<D>(&Bounds::UNIT, index, wall)?;
            let prescribed = wall.condition == WallCondition::Prescribed;
            check_presence(field("velocity"), wall.velocity.as_ref(), prescribed, PRESCRIBED)?;
            check_friction(&field, wall.friction, wall.condition == WallCondition::Friction)?;
            check_motion::<D>(&field, wall.velocity.as_ref(), None)?;
        }
        let room = self.domain.as_ref().map(DomainTable::room).transpose()?;
        plane::check_alike::<D>(self, room.as_ref())?;
        self.check_facets::<D>()?;
        for (index, obstacle) in self.obstacles.iter().enumerate() {
            let field = |key: &str| format!("obstacles[{index}].{key}");
            shape::build::<D>(&field("shape"), &obstacle.shape)?;
            let wanted = obstacle.contact == Contact::Separate && obstacle.friction.is_some();
            check_presence(
                field("friction"),
                obstacle.friction.as_ref(),
                wanted,
                "contact = \"separate\"",
            )?;
            check_motion::<D>(&field, obstacle.velocity.as_ref(), obstacle.friction)?;
        }
        for (index, held) in self.held.iter().enumerate() {
            let field = |key: &str| format!("held[{index}].{key}");
            shape::build::<D>(&field("shape"), &held.shape)?;
            kinematics::motion::<D>(&field, held.velocity.as_ref(), held.rotation.as_ref())?;
            check(held.until, &field("until"), positive)?;
        }
        for (index, table) in self.kinematic.iter().enumerate() {
            let field = |key: &str| format!("kinematic[{index}].{key}");
            shape::build::<D>(&field("region"), &table.region)?;
            self.check_body_name(field("body"), table.body.as_ref())?;
            kinematics::motion::<D>(&field, table.velocity.as_ref(), table.rotation.as_ref())?;
            check(table.until, &field("until"), positive)?;
        }
        Ok(())
    }
}

const PRESCRIBED: &str = "condition = \"prescribed\"";

/// μ of a wall or of facets, which has to be there where they are rough.
pub(super) fn check_friction(
    field: &dyn Fn(&str) -> String,
    friction: Option<f64>,
    rough: bool,
) -> Result<(), SceneFault> {
    check_presence(field("friction"), friction.as_ref(), rough, "condition = \"friction\"")?;
    check(friction, &field("friction"), not_negative)
}

/// A value that belongs to one condition: there with it, left out without it.
pub(super) fn check_presence<T: serde::Serialize>(
    field: String,
    value: Option<&T>,
    wanted: bool,
    condition: &str,
) -> Result<(), SceneFault> {
    match (value, wanted) {
        (None, true) => Err(SceneFault::missing(field, format!("given with {condition}"))),
        (Some(value), false) => Err(SceneFault::value(field, value, format!("left out unless {condition}"))),
        _ => Ok(()),
    }
}

fn check_motion<const D: usize>(
    field: &dyn Fn(&str) -> String,
    velocity: Option<&Vec<f64>>,
    friction: Option<f64>,
) -> Result<(), SceneFault> {
    velocity.map_or(Ok([0.0; D]), |velocity| vector(&field("velocity"), velocity))?;
    check(friction, &field("friction"), not_negative)
}
