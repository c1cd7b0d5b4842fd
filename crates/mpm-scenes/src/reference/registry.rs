//! The references and manufactured solutions that a scene can name.

use super::parts::{Rows, Run};
use super::{
    axis_aligned, cantilever, channel, conservation, dam_break, expansion, generalized_vortex, slope_run_out,
    tilted_cantilever, two_disks, vibrating_bar,
};
use crate::{ManufacturedSolution, Scene, SceneFault, Series, Snapshot};

/// A comparison of a run with a reference.
type Validate = fn(&Run) -> Rows;

/// A manufactured solution for the material of a scene.
type Manufacture = fn(&Scene) -> Result<Box<dyn ManufacturedSolution>, SceneFault>;

const VALIDATIONS: [(&str, Validate); 16] = [
    ("axis-aligned", axis_aligned::validate),
    ("cantilever-dynamic", cantilever::validate_dynamic),
    ("cantilever-frequency", cantilever::validate_frequency),
    ("cantilever-static", cantilever::validate_static),
    ("conservation", conservation::validate),
    ("dam-break", dam_break::validate),
    ("generalized-vortex", generalized_vortex::validate),
    ("two-disks", two_disks::validate),
    ("umls-bar", vibrating_bar::validate_on_mesh),
    ("umls-cantilever", tilted_cantilever::validate),
    ("umls-channel", channel::validate),
    ("umls-disks", two_disks::validate_on_mesh),
    ("umls-expansion", expansion::validate),
    ("umls-slope", slope_run_out::validate),
    ("umls-square", conservation::validate_on_mesh),
    ("vibrating-bar", vibrating_bar::validate),
];

const SOLUTIONS: [(&str, Manufacture); 2] = [
    ("axis-aligned", axis_aligned::manufacture),
    ("generalized-vortex", generalized_vortex::manufacture),
];

/// Names that `validation.reference` may have.
pub const REFERENCES: &[&str] = &names(&VALIDATIONS);

/// Names of manufactured solutions, for bodies (`velocity = { kind = "manufactured", solution = NAME }`) and loads.
pub const MANUFACTURED: &[&str] = &names(&SOLUTIONS);

const fn names<T, const N: usize>(table: &[(&'static str, T); N]) -> [&'static str; N] {
    let mut names = [""; N];
    let mut k = 0;
    while k < N {
        names[k] = table[k].0;
        k += 1;
    }
    names
}

/// Compares a finished run with the reference `name`, by its series and its last particles.
///
/// # Errors
/// [`SceneFault::Value`] for a name that is none of [`REFERENCES`], or a scene that the reference does not describe.
pub fn validate(name: &str, scene: &Scene, series: &Series, last: &Snapshot) -> Rows {
    let expected = || format!("one of {REFERENCES:?}");
    let entry = VALIDATIONS.iter().find(|(known, _)| *known == name);
    let (_, validate) = entry.ok_or_else(|| SceneFault::value("validation.reference", name, expected()))?;
    validate(&Run { scene, series, last })
}

/// The manufactured solution `name` for the material of this scene.
///
/// # Errors
/// [`SceneFault::Value`] for a name that is none of [`MANUFACTURED`], or a scene that it does not describe.
pub fn manufactured(name: &str, scene: &Scene) -> Result<Box<dyn ManufacturedSolution>, SceneFault> {
    let expected = || format!("one of {MANUFACTURED:?}");
    let entry = SOLUTIONS.iter().find(|(known, _)| *known == name);
    let (_, manufacture) = entry.ok_or_else(|| SceneFault::value("solution", name, expected()))?;
    manufacture(scene)
}
