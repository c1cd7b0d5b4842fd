//! Every bad mesh of a scene gets an error with file, field and value.

use std::path::Path;

use mpm_scenes::{Scene, simulate};

use super::refusal::refusal;
use super::scenes::RUBBER_ON_MESH;

#[test]
fn errors_name_the_field_and_the_value() {
    let generate = "generate = { kind = \"rectangle\", lower = [0.0, 0.0], upper = [1.0, 1.0], size = 0.2 }";
    let cases: &[(&str, &str, &[&str])] = &[
        (
            "[mesh]",
            "[grid]\nspacing = 0.1\n\n[mesh]",
            &["mesh = ", "left out where there is a [grid]"],
        ),
        (
            &format!("[mesh]\n{generate}"),
            "",
            &["grid is missing: must be given unless there is a [mesh]"],
        ),
        (
            &format!("[mesh]\n{generate}"),
            "[grid]\nspacing = 0.2",
            &["domain is missing: must be given with a [grid]"],
        ),
        (
            generate,
            "",
            &["mesh.file is missing: must be given unless generate is"],
        ),
        (
            generate,
            &format!("file = \"a.msh\"\n{generate}"),
            &["mesh.file = \"a.msh\"", "not beside it"],
        ),
        (
            generate,
            "file = \"a.msh\"",
            &["mesh.file = \"a.msh\": must be a file that can be read"],
        ),
        (
            "size = 0.2",
            "size = -0.2",
            &["mesh.generate.size = -0.2: must be positive"],
        ),
        ("size = 0.2", "sizes = 0.2", &["of [mesh]", "unknown field `sizes`"]),
        (
            "size = 0.2",
            "size = 1e-9",
            &["mesh.generate = ", "cells, the limit is"],
        ),
        (
            "upper = [1.0, 1.0], size",
            "upper = [-1.0, 1.0], size",
            &["mesh.generate = ", "width is -1"],
        ),
        (
            generate,
            "generate = { kind = \"ball\", centre = [0.0, 0.0, 0.0], radius = 1.0, size = 0.2 }",
            &["mesh.generate = ", "a mesh of 2 dimensions"],
        ),
        (
            generate,
            &format!("{generate}\nreach = -1.0"),
            &["mesh.reach = -1.0: must be at least 0"],
        ),
        (
            generate,
            &format!("{generate}\nrotation = {{ centre = [0.0], degrees = 3.0 }}"),
            &["mesh.rotation.centre = [0.0]: must be 2 finite numbers"],
        ),
        (
            generate,
            "generate = { kind = \"lattice\", lower = [0.0, 0.0], upper = [1.0, 1.0], size = 0.2 }\ndelaunay = {}",
            &["mesh.delaunay = ", "left out unless mesh.generate is a rectangle"],
        ),
        (
            generate,
            "file = \"a.msh\"\nangle = 3.0",
            &["mesh.angle = 3.0", "left out unless mesh.generate is a rectangle"],
        ),
        (
            generate,
            &format!("{generate}\ndelaunay = {{ refine = [{{ centre = [0.0, 0.0], size = 0.0 }}] }}"),
            &["mesh.delaunay.refine[0].size = 0.0: must be positive"],
        ),
        (
            generate,
            &format!("{generate}\nkernel = \"spline\""),
            &["unknown variant `spline`", "of [mesh]"],
        ),
        (
            "spacing = 0.05",
            "spacing = 0.0",
            &["bodies.block.spacing = 0.0: must be positive"],
        ),
        (
            "spacing = 0.05",
            "spacing = 0.05\nparticles_per_axis = 2",
            &["bodies.block.particles_per_axis = 2: must be left out where there is a spacing"],
        ),
        (
            "spacing = 0.05",
            "spacing = 0.05\nparticles = 7",
            &["bodies.block.particles = 7: must be left out unless fill = \"random\""],
        ),
        (
            "spacing = 0.05",
            "fill = \"random\"",
            &["bodies.block.particles is missing: must be at least 1"],
        ),
        (
            "shape = { kind = \"box\", lower = [0.3, 0.3], upper = [0.6, 0.6] }",
            "fill = \"vertices\"\nshape = { kind = \"capsule\", start = [0.3, 0.3], end = [0.6, 0.6], radius = 0.1 }",
            &[
                "bodies.block.shape = { kind = \"capsule\"",
                "a box, a sphere or a polygon",
            ],
        ),
        (
            "spacing = 0.05",
            "spacing = 0.05\ndeformation = 0.0",
            &["bodies.block.deformation = 0.0"],
        ),
        (
            "upper = [0.6, 0.6]",
            "upper = [1.6, 0.6]",
            &["bodies.block: particle", "outside the domain"],
        ),
        (
            "axis = \"x\"\nside = \"lower\"",
            "axis = \"x\"",
            &["walls[0].axis = \"x\": must be given with a side"],
        ),
        (
            "axis = \"x\"\nside = \"lower\"",
            "point = [0.0, 0.0]\nnormal = [0.0, 0.0]",
            &["walls[0].normal = [0.0, 0.0]: must be longer than 0"],
        ),
        (
            "axis = \"x\"\nside = \"lower\"",
            "point = [0.0, 0.0]\nnormal = [1.0, 0.0]\nposition = 1.0",
            &["walls[0].position = 1.0: must be left out unless there is an axis"],
        ),
        (
            "against = \"mesh\"",
            "",
            &["barrier.shapes = []: must be at least one shape"],
        ),
        (
            "against = \"mesh\"",
            "against = \"grid\"",
            &["unknown variant `grid`", "of [barrier]"],
        ),
    ];
    for (from, to, expected) in cases {
        let message = refusal(RUBBER_ON_MESH, "no/such/mesh.toml", from, to);
        for part in *expected {
            assert!(message.contains(part), "{to}: {message}\nlacks {part}");
        }
        let after = message.strip_prefix("no/such/mesh.toml");
        assert!(after.is_some_and(|rest| rest.starts_with([':', ','])), "{message}");
    }
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
