//! From a material's table to its law.

use std::sync::Arc;

use mpm_materials::{Law, Memory, ParameterError};

use crate::SceneFault;
use crate::scene::MaterialTable;
use crate::values::positive;

/// One law of the scene, chosen at run time.
pub type AnyLaw<const D: usize> = Arc<dyn Law<D, State = Memory> + Send + Sync>;

/// The law that a table describes; `field` is what errors call it.
///
/// # Errors
/// [`SceneFault::Value`] for a density that is not positive or a parameter that the law refuses.
pub fn build<const D: usize>(field: &str, table: &MaterialTable) -> Result<AnyLaw<D>, SceneFault> {
    positive(&format!("{field}.density"), table.density())?;
    if let MaterialTable::SofteningHencky(metal) = table {
        positive(&format!("{field}.norm_per_strength"), metal.norm_per_strength)?;
        if let Some(radius) = metal.nonlocal_radius {
            positive(&format!("{field}.nonlocal_radius"), radius)?;
        }
    }
    table.law().map_err(|error| refused(field, error))
}

/// The parameter by the name that it has in the document; angles are in degrees there.
fn refused(field: &str, error: ParameterError) -> SceneFault {
    let field = format!("{field}.{}", error.parameter);
    match error.parameter {
        "friction_angle" => SceneFault::value(field, error.value.to_degrees(), "strictly between 0 and 90 (degrees)"),
        _ => SceneFault::value(field, error.value, error.expected),
    }
}
