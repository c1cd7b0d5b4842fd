//! Conditions on named facets.

use super::boundaries::{check_friction, check_presence};
use crate::scene::{FacetCondition, FacetTable, Scene, StressUpdateName};
use crate::values::{not_negative, vector, within};
use crate::{SceneFault, velocity};

impl Scene {
    pub(super) fn check_facets<const D: usize>(&self) -> Result<(), SceneFault> {
        for (index, table) in self.facets.iter().enumerate() {
            let field = |key: &str| format!("facets[{index}].{key}");
            if self.mesh.is_none() {
                let expected = "left out without a [mesh]";
                return Err(SceneFault::value(field("group"), &table.group, expected));
            }
            let prescribed = table.condition == FacetCondition::Prescribed;
            match &table.velocity {
                None if prescribed => {
                    let expected = "given with condition = \"prescribed\"";
                    return Err(SceneFault::missing(field("velocity"), expected));
                }
                Some(_) if !prescribed => {
                    let expected = "\"prescribed\", since there is a velocity";
                    return Err(SceneFault::value(field("condition"), table.condition, expected));
                }
                velocity => drop(velocity::build::<D>(&field("velocity"), velocity.as_ref(), self)?),
            }
            check_friction(&field, table.friction, table.condition == FacetCondition::Friction)?;
            self.check_traction::<D>(&field, table)?;
        }
        Ok(())
    }

    fn check_traction<const D: usize>(
        &self,
        field: &dyn Fn(&str) -> String,
        table: &FacetTable,
    ) -> Result<(), SceneFault> {
        let loaded = table.condition == FacetCondition::Traction;
        let condition = "condition = \"traction\" and nothing else says how large it is";
        let by_pressure = table.pressure.is_some();
        check_presence(
            field("traction"),
            table.traction.as_ref(),
            loaded && !by_pressure,
            condition,
        )?;
        for (key, value) in [("pressure", table.pressure), ("ramp", table.ramp)] {
            let wanted = loaded && value.is_some();
            check_presence(field(key), value.as_ref(), wanted, "condition = \"traction\"")?;
            if let Some(value) = value {
                within(&field(key), value, value.is_finite(), "finite")?;
            }
        }
        not_negative(&field("ramp"), table.ramp.unwrap_or(0.0))?;
        if let Some(traction) = &table.traction {
            vector::<D>(&field("traction"), traction)?;
        }
        if loaded && self.time.stress_update == StressUpdateName::First {
            let expected = "\"last\" or \"modified-last\" with a traction on facets";
            return Err(SceneFault::value("time.stress_update", "first", expected));
        }
        Ok(())
    }
}
