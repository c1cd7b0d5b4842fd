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
fn a_particle_that_leaves_the_mesh_is_an_error_with_its_number_and_body() {
    let text = without_barrier().replace("velocity = [0.1, 0.0]", "velocity = [100.0, 0.0]");
    assert!(outside(&text).contains("bodies.block: particle "));
}

/// The domain is wider than the mesh.
#[test]
fn a_body_beyond_a_narrow_mesh_is_named_with_the_place() {
    let disk = "generate = { kind = \"disk\", centre = [0.5, 0.5], radius = 0.12, size = 0.05 }";
    let square = "generate = { kind = \"rectangle\", lower = [0.0, 0.0], upper = [1.0, 1.0], size = 0.2 }";
    let text = without_barrier().replace(square, disk);
    let text = text + "\n[domain]\nlower = [0.0, 0.0]\nupper = [1.0, 1.0]\n";
    let message = outside(&text);
    let expected = "step 1 at t = 0: bodies.block: particle 0 is at [0.32";
    assert!(message.starts_with(expected), "{message}");
}

fn without_barrier() -> String {
    let barrier = "[barrier]\nagainst = \"mesh\"\nstiffness = 1.0\ngap = 0.05\n";
    assert!(RUBBER_ON_MESH.contains(barrier));
    RUBBER_ON_MESH
        .replace("[mesh]", "[mesh]\nouter_layer = false")
        .replace(barrier, "")
}

/// What is said of a scene, one of whose particles is in no cell.
fn outside(text: &str) -> String {
    let scene = Scene::parse(text, Path::new("mesh.toml")).expect("a good scene");
    let directory = tempfile::tempdir().expect("a directory");
    let error = simulate(&scene, directory.path(), &mut ()).expect_err("it is outside");
    let message = error.to_string();
    assert!(message.ends_with("in no cell of the mesh"), "{message}");
    match error {
        mpm_scenes::SimulationError::Step { particle, body, .. } => {
            assert!(particle.is_some() && body.as_deref() == Some("block"));
        }
        other => panic!("{other}"),
    }
    message
}
