//! Which scenes a reference describes: what sets its problem apart, and all that its comparison reads.

use super::cylinder::ThickWalledCylinder;
use super::hertz::CylinderOnPlane;
use super::kirsch::PlateWithHole;
use super::parts::{gravity, sides, solid, spacing};
use super::{slope_run_out, tilted_cantilever};
use crate::Scene;
use crate::scene::{BodyTable, FillKind, LoadTable, MaterialTable, ShapeTable, VectorField, VectorTable};

/// Whether a scene is one of a problem, and which scenes are in words.
#[derive(Clone, Copy)]
pub struct Problem(pub fn(&Scene) -> bool, pub &'static str);

pub const AXIS_ALIGNED: Problem = Problem(
    |scene| manufactured(scene, "axis-aligned"),
    "a plane body of one elastic material, with the manufactured solution `axis-aligned` as velocity or load",
);
pub const GENERALIZED_VORTEX: Problem = Problem(
    |scene| manufactured(scene, "generalized-vortex"),
    "a plane body of one elastic material, with the manufactured solution `generalized-vortex` as velocity or load",
);
pub const CANTILEVER: Problem = Problem(
    |scene| {
        let box_of_one_solid = solid(scene).is_ok() && sides(scene).is_ok();
        scene.dimension == 2 && box_of_one_solid && gravity(scene) > 0.0 && has_probe(scene, "tip")
    },
    "a plane box of one elastic material under gravity, with the probe `tip`",
);
pub const CONSERVATION: Problem = Problem(
    |scene| scene.dimension == 2 && gravity(scene) == 0.0 && is_closed(scene),
    "a plane scene without gravity, loads, damping and all that bodies touch or are held by",
);
pub const DAM_BREAK: Problem = Problem(
    |scene| {
        let fluid = scene
            .materials
            .values()
            .all(|material| matches!(material, MaterialTable::TaitFluid(_)));
        let column = sides(scene).is_ok_and(|sides| super::dam_break::is_column(&sides));
        fluid && column && gravity(scene) > 0.0
    },
    "a plane box of a tait-fluid under gravity, twice as high as wide",
);
pub const TWO_DISKS: Problem = Problem(
    |scene| {
        let sphere = |body: &BodyTable| matches!(body.shape, ShapeTable::Sphere { .. });
        let two = scene.dimension == 2 && scene.bodies.len() == 2 && scene.bodies.iter().all(sphere);
        two && spacing(scene).is_ok() && has_probe(scene, "first")
    },
    "two spheres in the plane on a grid or a generated mesh, with the probe `first`",
);
pub const BAR: Problem = Problem(
    |scene| {
        let velocity = scene.bodies.first().and_then(|body| body.velocity.as_ref());
        let sine = matches!(velocity, Some(VectorTable::Field(VectorField::Sine { .. })));
        scene.dimension == 1 && sine && solid(scene).is_ok() && sides(scene).is_ok()
    },
    "a box in one dimension of one elastic material, with a sine as its velocity",
);
pub const BAR_WITH_PROBE: Problem = Problem(
    |scene| {
        let mut probes = scene.probes.iter();
        (BAR.0)(scene) && probes.any(|probe| probe.name == "middle" && probe.at.is_some())
    },
    "a box in one dimension of one elastic material, with a sine as its velocity, and the probe `middle` at a point",
);
pub const TILTED_CANTILEVER: Problem = Problem(
    |scene| scene.dimension == 2 && tilted_cantilever::fine_run_of(scene).is_some() && has_probe(scene, "tip"),
    "a plane body turned by 0, 15, 30 or 45 degrees, with the probe `tip`",
);
pub const CHANNEL: Problem = Problem(
    |scene| {
        let random = |body: &BodyTable| body.fill == FillKind::Random;
        let falls = scene.dimension == 2 && gravity(scene) > 0.0;
        let walled = scene.barrier.is_some() || !scene.facets.is_empty();
        falls && walled && scene.bodies.iter().all(random)
    },
    "randomly filled plane bodies under gravity, with a barrier or facets",
);
pub const CYLINDER: Problem = Problem(
    |scene| scene.dimension == 2 && ThickWalledCylinder::of(scene).is_some(),
    "a plane ring (a sphere less a smaller one about its centre) of one elastic material, with a pressure on facets",
);
pub const KIRSCH: Problem = Problem(
    |scene| scene.dimension == 2 && PlateWithHole::of(scene).is_some(),
    "a plane body of one elastic material less a sphere, with a traction along x on the facets `x-upper`",
);
pub const HERTZ: Problem = Problem(
    |scene| scene.dimension == 2 && CylinderOnPlane::of(scene).is_some(),
    "a plane sphere of one elastic material under gravity along -y, above a half-space as the barrier with its normal along y, without friction",
);
pub const EXPANSION: Problem = Problem(
    |scene| scene.dimension == 3 && scene.barrier.is_some(),
    "a scene in three dimensions with a barrier",
);
pub const SLOPE: Problem = Problem(
    |scene| {
        let body = scene.bodies.first();
        let base = body.and_then(|body| slope_run_out::base(&body.shape));
        let spaced = body.is_some_and(|body| body.spacing.is_some());
        let yields = |material: &MaterialTable| {
            matches!(
                material,
                MaterialTable::SofteningHencky(_) | MaterialTable::DruckerPrager(_)
            )
        };
        let falls = scene.dimension > 1 && gravity(scene) > 0.0 && scene.materials.values().all(yields);
        falls && base.is_some() && spaced
    },
    "a polygon or box of a softening-hencky or drucker-prager material under gravity, whose particles have a spacing",
);

/// Whether bodies exchange momentum with nothing but each other.
fn is_closed(scene: &Scene) -> bool {
    let untouched = scene.walls.is_empty() && scene.obstacles.is_empty() && scene.facets.is_empty();
    let free = scene.held.is_empty() && scene.kinematic.is_empty() && scene.loads.is_empty();
    untouched && free && scene.barrier.is_none() && scene.time.damping == 0.0
}

fn has_probe(scene: &Scene, name: &str) -> bool {
    scene.probes.iter().any(|probe| probe.name == name)
}

/// A velocity or a load of this manufactured solution in a plane scene of one elastic material.
fn manufactured(scene: &Scene, name: &str) -> bool {
    let moves = |body: &BodyTable| matches!(&body.velocity, Some(VectorTable::Field(VectorField::Manufactured { solution })) if solution == name);
    let pulls = |load: &LoadTable| matches!(load, LoadTable::Manufactured { solution } if solution == name);
    let named = scene.bodies.iter().any(moves) || scene.loads.iter().any(pulls);
    named && scene.dimension == 2 && solid(scene).is_ok()
}
