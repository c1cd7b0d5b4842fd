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
    refused_before_a_frame(&text, "bodies.block: particle 0 at [0.32");
}

/// The hole is wider than the cells of the layer in it.
#[test]
fn a_body_over_a_hole_is_refused_before_a_frame_is_written() {
    let hole = "generate = { kind = \"polygon\", corners = [[-1.0, -1.0], [2.0, -1.0], [2.0, 2.0], [-1.0, 2.0]], holes = [[[-0.5, -0.5], [1.5, -0.5], [1.5, 1.5], [-0.5, 1.5]]], size = 0.2 }";
    let square = "generate = { kind = \"rectangle\", lower = [0.0, 0.0], upper = [1.0, 1.0], size = 0.2 }";
    let wall = "[[walls]]\naxis = \"x\"\nside = \"lower\"\ncondition = \"slip\"\n";
    let text = without_barrier().replace(square, hole).replace(wall, "");
    for layer in ["outer_layer = true", "outer_layer = false", "reach = 0.1"] {
        let text = text.replace("outer_layer = false", layer);
        refused_before_a_frame(&text, "bodies.block: particle 0 at [0.3");
    }
}

/// Half of the body is beyond a mesh that ends at x = 0.45, within `reach` or not.
#[test]
fn a_body_beyond_the_mesh_may_be_within_its_reach() {
    let text = without_barrier().replace("upper = [1.0, 1.0], size = 0.2 }", "upper = [0.45, 1.0], size = 0.2 }");
    let text = text + "\n[domain]\nlower = [0.0, 0.0]\nupper = [1.0, 1.0]\n";
    let with_reach =
        |reach: &str| text.replace("outer_layer = false", &format!("outer_layer = false\nreach = {reach}"));
    refused_before_a_frame(&with_reach("0.1"), "and mesh.reach = 0.1");
    let scene = Scene::parse(&with_reach("0.2"), Path::new("mesh.toml")).expect("a good scene");
    let directory = tempfile::tempdir().expect("a directory");
    simulate(&scene, directory.path(), &mut ()).expect("a run");
}

fn refused_before_a_frame(text: &str, expected: &str) {
    let scene = Scene::parse(text, Path::new("mesh.toml")).expect("a good scene");
    let directory = tempfile::tempdir().expect("a directory");
    let message = simulate(&scene, directory.path(), &mut ())
        .expect_err("it is outside")
        .to_string();
    assert!(
        message.contains(expected) && message.contains("is outside the mesh"),
        "{message}"
    );
    let files = std::fs::read_dir(directory.path()).expect("a directory");
    let frames = files
        .flatten()
        .filter(|file| file.path().extension().is_some_and(|kind| kind == "vtu"));
    assert_eq!(frames.count(), 0);
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
