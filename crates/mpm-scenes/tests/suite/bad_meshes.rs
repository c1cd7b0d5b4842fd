//! Every bad mesh of a scene gets an error with file, field and value.

use std::path::Path;

use mpm_scenes::{Scene, simulate};

use super::refusal::assert_refused;
use super::scenes::RUBBER_ON_MESH;

#[test]
fn errors_name_the_field_and_the_value() {
    assert_refused(
        RUBBER_ON_MESH,
        "no/such/mesh.toml",
        include_str!("../data/rubber_on_mesh_refused.toml"),
    );
}

#[test]
fn a_barrier_against_the_mesh_needs_one() {
    let text = super::scenes::BLOCK.replace("[barrier]", "[barrier]\nagainst = \"mesh\"");
    let message = Scene::parse(&text, Path::new("block.toml"))
        .expect_err("a grid")
        .to_string();
    assert!(
        message.contains("barrier.against = \"mesh\": must be left out"),
        "{message}"
    );
}

#[test]
fn a_particle_that_leaves_the_mesh_is_an_error_with_its_number() {
    let text = RUBBER_ON_MESH
        .replace("velocity = [0.1, 0.0]", "velocity = [100.0, 0.0]")
        .replace("[mesh]", "[mesh]\nouter_layer = false")
        .replace(
            "against = \"mesh\"",
            "shapes = [{ kind = \"sphere\", centre = [9.0, 9.0], radius = 1.0 }]",
        );
    let scene = Scene::parse(&text, Path::new("mesh.toml")).expect("a good scene");
    let directory = tempfile::tempdir().expect("a directory");
    let error = simulate(&scene, directory.path(), &mut ()).expect_err("it leaves");
    match error {
        mpm_scenes::SimulationError::Step { particle, source, .. } => {
            assert!(particle.is_some() && source.to_string().contains("mesh"), "{source}");
        }
        other => panic!("{other}"),
    }
}
