//! The references and manufactured solutions that a scene can name.

use super::parts::{Rows, Run};
use super::{
    Displacement, axis_aligned, cantilever, channel, conservation, cylinder, dam_break, expansion, generalized_vortex,
    needs, slope_run_out, tilted_cantilever, two_disks, vibrating_bar,
};
use crate::{ManufacturedSolution, Scene, SceneFault, Series, Snapshot};

/// A comparison with a reference.
struct Reference {
    name: &'static str,
    /// The scenes that it is for, in words.
    describes: &'static str,
    /// Whether a scene is one of these.
    fits: fn(&Scene) -> bool,
    /// Compares a run of such a scene.
    validate: fn(&Run) -> Rows,
}

/// A manufactured solution for the material of a scene.
type Manufacture = fn(&Scene) -> Result<Box<dyn ManufacturedSolution>, SceneFault>;

const VALIDATIONS: [Reference; 17] = [
    Reference {
        name: "axis-aligned",
        describes: "a plane body of one elastic material, with the manufactured solution `axis-aligned` as velocity or load",
        fits: needs::axis_aligned,
        validate: axis_aligned::validate,
    },
    Reference {
        name: "cantilever-dynamic",
        describes: "a plane box of one elastic material under gravity, with the probe `tip`",
        fits: needs::cantilever,
        validate: cantilever::validate_dynamic,
    },
    Reference {
        name: "cantilever-frequency",
        describes: "a plane box of one elastic material under gravity, with the probe `tip`",
        fits: needs::cantilever,
        validate: cantilever::validate_frequency,
    },
    Reference {
        name: "cantilever-static",
        describes: "a plane box of one elastic material under gravity, with the probe `tip`",
        fits: needs::cantilever,
        validate: cantilever::validate_static,
    },
    Reference {
        name: "conservation",
        describes: "a plane scene without gravity",
        fits: needs::conservation,
        validate: conservation::validate,
    },
    Reference {
        name: "dam-break",
        describes: "a plane box of a tait-fluid under gravity, twice as high as wide",
        fits: needs::dam_break,
        validate: dam_break::validate,
    },
    Reference {
        name: "generalized-vortex",
        describes: "a plane body of one elastic material, with the manufactured solution `generalized-vortex` as velocity or load",
        fits: needs::generalized_vortex,
        validate: generalized_vortex::validate,
    },
    Reference {
        name: "two-disks",
        describes: "two spheres in the plane on a grid or a generated mesh, with the probe `first`",
        fits: needs::two_disks,
        validate: two_disks::validate,
    },
    Reference {
        name: "umls-bar",
        describes: "a box in one dimension of one elastic material, with a sine as its velocity, and the probe `middle` at a point",
        fits: needs::bar_with_probe,
        validate: vibrating_bar::validate_on_mesh,
    },
    Reference {
        name: "umls-cantilever",
        describes: "a plane body turned by 0, 15, 30 or 45 degrees, with the probe `tip`",
        fits: needs::tilted_cantilever,
        validate: tilted_cantilever::validate,
    },
    Reference {
        name: "umls-channel",
        describes: "randomly filled plane bodies under gravity, with a barrier or facets",
        fits: needs::channel,
        validate: channel::validate,
    },
    Reference {
        name: "umls-cylinder",
        describes: "a plane ring (a sphere less a smaller one about its centre) of one elastic material, with a pressure on facets",
        fits: needs::cylinder,
        validate: cylinder::validate,
    },
    Reference {
        name: "umls-disks",
        describes: "two spheres in the plane on a grid or a generated mesh, with the probe `first`",
        fits: needs::two_disks,
        validate: two_disks::validate_on_mesh,
    },
    Reference {
        name: "umls-expansion",
        describes: "a scene in three dimensions with a barrier",
        fits: needs::expansion,
        validate: expansion::validate,
    },
    Reference {
        name: "umls-slope",
        describes: "a polygon or box of a softening-hencky or drucker-prager material under gravity, whose particles have a spacing",
        fits: needs::slope,
        validate: slope_run_out::validate,
    },
    Reference {
        name: "umls-square",
        describes: "a plane scene without gravity",
        fits: needs::conservation,
        validate: conservation::validate_on_mesh,
    },
    Reference {
        name: "vibrating-bar",
        describes: "a box in one dimension of one elastic material, with a sine as its velocity",
        fits: needs::bar,
        validate: vibrating_bar::validate,
    },
];

const SOLUTIONS: [(&str, Manufacture); 2] = [
    ("axis-aligned", axis_aligned::manufacture),
    ("generalized-vortex", generalized_vortex::manufacture),
];

/// Names that `validation.reference` may have.
pub const REFERENCES: &[&str] = &{
    let mut names = [""; VALIDATIONS.len()];
    let mut k = 0;
    while k < names.len() {
        names[k] = VALIDATIONS[k].name;
        k += 1;
    }
    names
};

/// Names of manufactured solutions, for bodies (`velocity = { kind = "manufactured", solution = NAME }`) and loads.
pub const MANUFACTURED: &[&str] = &{
    let mut names = [""; SOLUTIONS.len()];
    let mut k = 0;
    while k < names.len() {
        names[k] = SOLUTIONS[k].0;
        k += 1;
    }
    names
};

/// The reference of this name.
fn named(name: &str) -> Result<&'static Reference, SceneFault> {
    let entry = VALIDATIONS.iter().find(|reference| reference.name == name);
    entry.ok_or_else(|| SceneFault::value("validation.reference", name, format!("one of {REFERENCES:?}")))
}

/// Whether the reference `name` is one for this scene.
///
/// # Errors
/// [`SceneFault::Value`] for a name that is none of [`REFERENCES`], or a scene that the reference does not describe.
pub fn check(name: &str, scene: &Scene) -> Result<(), SceneFault> {
    let reference = named(name)?;
    if (reference.fits)(scene) {
        return Ok(());
    }
    let expected = format!("one for this scene: {name} is for {}", reference.describes);
    Err(SceneFault::value("validation.reference", name, expected))
}

/// Compares a finished run with the reference `name`, by its series and its last particles.
///
/// # Errors
/// [`SceneFault::Value`] for a name that is none of [`REFERENCES`], or a scene that the reference does not describe.
pub fn validate(name: &str, scene: &Scene, series: &Series, last: &Snapshot) -> Rows {
    (named(name)?.validate)(&Run { scene, series, last })
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
/// [`SceneFault::Value`] for a name that is none of [`MANUFACTURED`], or a scene that it does not describe.
pub fn manufactured(name: &str, scene: &Scene) -> Result<Box<dyn ManufacturedSolution>, SceneFault> {
    let expected = || format!("one of {MANUFACTURED:?}");
    let entry = SOLUTIONS.iter().find(|(known, _)| *known == name);
    let (_, manufacture) = entry.ok_or_else(|| SceneFault::value("solution", name, expected()))?;
    manufacture(scene)
}
