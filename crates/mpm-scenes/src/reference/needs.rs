//! Which scenes a reference describes: what sets its problem apart, and all that its comparison reads.

use super::cylinder::ThickWalledCylinder;
use super::parts::{gravity, sides, solid, spacing};
use super::{slope_run_out, tilted_cantilever};
use crate::Scene;
use crate::scene::{BodyTable, FillKind, LoadTable, MaterialTable, ShapeTable, VelocityField, VelocityTable};

fn has_probe(scene: &Scene, name: &str) -> bool {
    scene.probes.iter().any(|probe| probe.name == name)
}

/// A velocity or a load of this manufactured solution in a plane scene of one elastic material.
fn manufactured(scene: &Scene, name: &str) -> bool {
    let moves = |body: &BodyTable| matches!(&body.velocity, Some(VelocityTable::Field(VelocityField::Manufactured { solution })) if solution == name);
    let pulls = |load: &LoadTable| matches!(load, LoadTable::Manufactured { solution } if solution == name);
    let named = scene.bodies.iter().any(moves) || scene.loads.iter().any(pulls);
    named && scene.dimension == 2 && solid(scene).is_ok()
}

pub fn axis_aligned(scene: &Scene) -> bool {
    manufactured(scene, "axis-aligned")
}

pub fn generalized_vortex(scene: &Scene) -> bool {
    manufactured(scene, "generalized-vortex")
}

pub fn cantilever(scene: &Scene) -> bool {
    let box_of_one_solid = solid(scene).is_ok() && sides(scene).is_ok();
    scene.dimension == 2 && box_of_one_solid && gravity(scene) > 0.0 && has_probe(scene, "tip")
}

pub fn conservation(scene: &Scene) -> bool {
    scene.dimension == 2 && gravity(scene) == 0.0
}

pub fn dam_break(scene: &Scene) -> bool {
    let fluid = scene
        .materials
        .values()
        .all(|material| matches!(material, MaterialTable::TaitFluid(_)));
    let column = sides(scene).is_ok_and(|sides| super::dam_break::is_column(&sides));
    fluid && column && gravity(scene) > 0.0
}

pub fn two_disks(scene: &Scene) -> bool {
    let sphere = |body: &BodyTable| matches!(body.shape, ShapeTable::Sphere { .. });
    let two = scene.dimension == 2 && scene.bodies.len() == 2 && scene.bodies.iter().all(sphere);
    two && spacing(scene).is_ok() && has_probe(scene, "first")
}

pub fn bar(scene: &Scene) -> bool {
    let velocity = scene.bodies.first().and_then(|body| body.velocity.as_ref());
    let sine = matches!(velocity, Some(VelocityTable::Field(VelocityField::Sine { .. })));
    scene.dimension == 1 && sine && solid(scene).is_ok() && sides(scene).is_ok()
}

pub fn bar_with_probe(scene: &Scene) -> bool {
    let mut probes = scene.probes.iter();
    bar(scene) && probes.any(|probe| probe.name == "middle" && probe.at.is_some())
}

pub fn tilted_cantilever(scene: &Scene) -> bool {
    scene.dimension == 2 && tilted_cantilever::fine_run_of(scene).is_some() && has_probe(scene, "tip")
}

pub fn channel(scene: &Scene) -> bool {
    let random = |body: &BodyTable| body.fill == FillKind::Random;
    let falls = scene.dimension == 2 && gravity(scene) > 0.0;
    let walled = scene.barrier.is_some() || !scene.facets.is_empty();
    falls && walled && scene.bodies.iter().all(random)
}

pub fn cylinder(scene: &Scene) -> bool {
    scene.dimension == 2 && ThickWalledCylinder::of(scene).is_some()
}

pub fn expansion(scene: &Scene) -> bool {
    scene.dimension == 3 && scene.barrier.is_some()
}

pub fn slope(scene: &Scene) -> bool {
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
}
