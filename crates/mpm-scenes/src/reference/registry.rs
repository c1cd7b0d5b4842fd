//! The references and manufactured solutions that a scene can name.

use super::needs::{self, Problem};
use super::parts::{Rows, Run};
use super::{
    Displacement, axis_aligned, cantilever, channel, conservation, cylinder, dam_break, expansion, generalized_vortex,
    hertz, kirsch, slope_run_out, tilted_cantilever, two_disks, vibrating_bar,
};
use crate::values::within;
use crate::{ManufacturedSolution, Scene, SceneFault, Series, Snapshot};

/// A comparison with a reference: its name, the problem that it is of, and the comparison itself.
type Reference = (&'static str, Problem, fn(&Run) -> Rows);

/// A manufactured solution for the material of a scene.
type Manufacture = fn(&Scene) -> Result<Box<dyn ManufacturedSolution>, SceneFault>;

const VALIDATIONS: [Reference; 19] = [
    ("axis-aligned", needs::AXIS_ALIGNED, axis_aligned::validate),
    ("cantilever-dynamic", needs::CANTILEVER, cantilever::validate_dynamic),
    (
        "cantilever-frequency",
        needs::CANTILEVER,
        cantilever::validate_frequency,
    ),
    ("cantilever-static", needs::CANTILEVER, cantilever::validate_static),
    ("conservation", needs::CONSERVATION, conservation::validate),
    ("dam-break", needs::DAM_BREAK, dam_break::validate),
    (
        "generalized-vortex",
        needs::GENERALIZED_VORTEX,
        generalized_vortex::validate,
    ),
    ("hertz", needs::HERTZ, hertz::validate),
    ("kirsch", needs::KIRSCH, kirsch::validate),
    ("two-disks", needs::TWO_DISKS, two_disks::validate),
    ("umls-bar", needs::BAR_WITH_PROBE, vibrating_bar::validate_on_mesh),
    ("umls-cantilever", needs::TILTED_CANTILEVER, tilted_cantilever::validate),
    ("umls-channel", needs::CHANNEL, channel::validate),
    ("umls-cylinder", needs::CYLINDER, cylinder::validate),
    ("umls-disks", needs::TWO_DISKS, two_disks::validate_on_mesh),
    ("umls-expansion", needs::EXPANSION, expansion::validate),
    ("umls-slope", needs::SLOPE, slope_run_out::validate),
    ("umls-square", needs::CONSERVATION, conservation::validate_on_mesh),
    ("vibrating-bar", needs::BAR, vibrating_bar::validate),
];

const SOLUTIONS: [(&str, Manufacture); 2] = [
    ("axis-aligned", |scene| Ok(Box::new(axis_aligned::of_scene(scene)?))),
    ("generalized-vortex", |scene| {
        Ok(Box::new(generalized_vortex::of_scene(scene)?))
    }),
];

/// Names that `validation.reference` may have.
pub fn references() -> [&'static str; VALIDATIONS.len()] {
    VALIDATIONS.map(|(name, ..)| name)
}

/// The reference of this name.
fn named(name: &str) -> Result<&'static Reference, SceneFault> {
    let entry = VALIDATIONS.iter().find(|(known, ..)| *known == name);
    entry.ok_or_else(|| SceneFault::value("validation.reference", name, format!("one of {:?}", references())))
}

/// Whether the reference `name` is one for this scene.
///
/// # Errors
/// [`SceneFault::Value`] for a name that is none of [`references`], or a scene that the reference does not describe.
pub fn check(name: &str, scene: &Scene) -> Result<(), SceneFault> {
    let (_, Problem(fits, described), _) = named(name)?;
    let expected = format!("one for this scene: {name} is for {described}");
    within("validation.reference", name, fits(scene), &expected).map(drop)
}

/// Compares a finished run with the reference `name`, by its series and its last particles.
///
/// # Errors
/// [`SceneFault::Value`] for a name that is none of [`references`], or a scene that the reference does not describe.
pub fn validate(name: &str, scene: &Scene, series: &Series, last: &Snapshot) -> Rows {
    (named(name)?.2)(&Run { scene, series, last })
}

/// The exact displacement of all particles of a scene, where its reference has one.
pub fn displacement(scene: &Scene) -> Option<Displacement> {
    match scene.validation.as_ref()?.reference.as_str() {
        "umls-bar" | "vibrating-bar" => vibrating_bar::displacement(scene),
        _ => None,
    }
}

/// The manufactured solution `name` for the material of this scene.
///
/// # Errors
/// [`SceneFault::Value`] for a name that is not known, or a scene that it does not describe.
pub fn manufactured(name: &str, scene: &Scene) -> Result<Box<dyn ManufacturedSolution>, SceneFault> {
    let expected = || format!("one of {:?}", SOLUTIONS.map(|(name, _)| name));
    let entry = SOLUTIONS.iter().find(|(known, _)| *known == name);
    let (_, manufacture) = entry.ok_or_else(|| SceneFault::value("solution", name, expected()))?;
    manufacture(scene)
}
