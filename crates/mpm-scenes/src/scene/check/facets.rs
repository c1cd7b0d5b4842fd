//! Conditions on named facets.

use super::boundaries::{check_friction, check_presence};
use crate::scene::{FacetCondition, FacetTable, ON_MESH, Scene, StressUpdateName, amplitude};
use crate::values::within;
use crate::{SceneFault, facet_traction, vector_field};

impl Scene {
    pub(super) fn check_facets<const D: usize>(&self) -> Result<(), SceneFault> {
        for (index, table) in self.facets.iter().enumerate() {
            let field = |key: &str| format!("facets[{index}].{key}");
            let on_mesh = self.mesh.is_some();
            within(&field("group"), &table.group, on_mesh, ON_MESH)?;
            let holds = |table: &FacetTable| table.condition != FacetCondition::Traction;
            let same = |other: &FacetTable| other.group == table.group && holds(other);
            let earlier = self.facets[..index].iter().position(same).filter(|_| holds(table));
            if let Some(earlier) = earlier {
                let expected = format!("another group than that of facets[{earlier}], which says what happens there");
                return Err(SceneFault::value(field("group"), &table.group, expected));
            }
            let prescribed = table.condition == FacetCondition::Prescribed;
            let velocity = table.velocity.as_ref();
            if prescribed && velocity.is_none() {
                let expected = "given with condition = \"prescribed\"";
                return Err(SceneFault::missing(field("velocity"), expected));
            }
            let (condition, fits) = (table.condition, prescribed || velocity.is_none());
            within(
                &field("condition"),
                condition,
                fits,
                "\"prescribed\", since there is a velocity",
            )?;
            vector_field::build::<D>(&field("velocity"), velocity, self)?;
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
        let (pressure, ramp, points) = (table.pressure.as_ref(), table.ramp.as_ref(), table.amplitude.as_ref());
        let condition = "condition = \"traction\"";
        check_presence(field("pressure"), pressure, loaded && by_pressure, condition)?;
        check_presence(field("ramp"), ramp, loaded && ramp.is_some(), condition)?;
        check_presence(field("amplitude"), points, loaded && points.is_some(), condition)?;
        amplitude(field, table.ramp, points)?;
        facet_traction::build::<D>(field, table, self).map(drop)?;
        let late = !loaded || self.time.stress_update != StressUpdateName::First;
        let expected = "\"last\" or \"modified-last\" with a traction on facets";
        within("time.stress_update", "first", late, expected).map(drop)
    }
}
