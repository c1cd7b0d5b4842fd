//! Runs on meshes: of files, with every affine transfer, stopped and gone on with.

use std::path::Path;

use mpm_mesh::generate::{EdgeTarget, rectangle};
use mpm_mesh::{MshFormat, write_msh};
use mpm_scenes::output::read_series;
use mpm_scenes::{Scene, Series, simulate};

use super::scenes::{BLOCK_ON_MESH, RUBBER_ON_MESH};

const GENERATE: &str = "generate = { kind = \"rectangle\", lower = [0.0, 0.0], upper = [1.0, 1.0], size = 0.2 }";

fn run(text: &str, directory: &Path) -> Series {
    let scene = Scene::parse(text, &directory.join("scene.toml")).expect("a valid scene");
    let out = directory.join("out");
    simulate(&scene, &out, &mut ()).expect("runs");
    let series = read_series(&out).expect("written");
    std::fs::remove_dir_all(&out).expect("there");
    series
}

#[test]
fn a_mesh_of_a_file_moves_bodies_as_the_mesh_that_was_written() {
    let directory = tempfile::tempdir().expect("a directory");
    let made = run(RUBBER_ON_MESH, directory.path());
    let target = EdgeTarget {
        length: 0.2,
        angle: 0.0,
    };
    let mesh = rectangle([0.0; 2], [1.0; 2], &target).expect("a mesh");
    assert!(RUBBER_ON_MESH.contains(GENERATE));
    for format in [
        MshFormat::Text22,
        MshFormat::Binary22,
        MshFormat::Text41,
        MshFormat::Binary41,
    ] {
        std::fs::write(directory.path().join("square.msh"), write_msh(&mesh, format)).expect("written");
        let read = run(
            &RUBBER_ON_MESH.replace(GENERATE, "file = \"square.msh\""),
            directory.path(),
        );
        assert_eq!(read, made, "{format:?}");
    }
}

/// A file of another dimension, or of no mesh, is refused with its name.
#[test]
fn a_file_of_another_dimension_is_refused() {
    let directory = tempfile::tempdir().expect("a directory");
    let mesh = mpm_mesh::generate::segments(0.0, &[0.5, 0.5]).expect("a mesh");
    for content in [write_msh(&mesh, MshFormat::Text41), b"no mesh".to_vec()] {
        std::fs::write(directory.path().join("other.msh"), content).expect("written");
        let text = RUBBER_ON_MESH.replace(GENERATE, "file = \"other.msh\"");
        let scene = Scene::parse(&text, &directory.path().join("scene.toml")).expect("a valid scene");
        let error = simulate(&scene, &directory.path().join("out"), &mut ()).expect_err("refused");
        assert!(error.to_string().contains("mesh.file = \"other.msh\""), "{error}");
    }
}

/// Momentum and angular momentum stay, energy does not grow; MLS differs from APIC by its stress force only.
#[test]
fn a_free_block_swings_alike_with_both_affine_transfers() {
    let directory = tempfile::tempdir().expect("a directory");
    let columns = |kind: &str| {
        let series = run(&BLOCK_ON_MESH.replace("apic", kind), directory.path());
        let column = move |name: &str| series.column(name).expect("a column");
        let energy: Vec<f64> = (column("kinetic_energy").iter().zip(column("affine_energy")))
            .zip(column("strain_energy"))
            .map(|((kinetic, affine), strain)| kinetic + affine + strain)
            .collect();
        for name in ["momentum_x", "momentum_y", "angular_momentum"] {
            let values = column(name);
            let change = values
                .iter()
                .fold(0.0, |most: f64, value| most.max((value - values[0]).abs()));
            assert!(change < 1e-13, "{kind}: {name} changes by {change}");
        }
        assert!(energy.iter().all(|e| *e <= energy[0]), "{kind}: {energy:?}");
        column("strain_energy")
    };
    let (apic, mls) = (columns("apic"), columns("mls"));
    let peak = apic.iter().fold(0.0, |peak: f64, energy| peak.max(*energy));
    assert!(peak > 0.0 && apic != mls);
    for (a, m) in apic.iter().zip(&mls) {
        assert!((a - m).abs() < 0.01 * peak, "{apic:?} {mls:?}");
    }
}

/// The first frame of four particles as it has always been written.
#[test]
fn frames_keep_their_bytes() {
    let changes = [
        (
            "lower = [-0.4, -0.3], upper = [0.4, 0.3]",
            "lower = [-0.25, -0.25], upper = [0.25, 0.25]",
        ),
        ("spacing = 0.1", "spacing = 0.25"),
        (
            "velocity = { kind = \"linear\", centre = [0.0, 0.0], gradient = [[0.3, 0.2], [0.5, -0.1]] }",
            "velocity = [0.5, -0.25]",
        ),
    ];
    let mut text = BLOCK_ON_MESH.to_owned();
    for (old, new) in changes {
        assert!(text.contains(old), "{old}");
        text = text.replace(old, new);
    }
    let directory = tempfile::tempdir().expect("a directory");
    let scene = Scene::parse(&text, &directory.path().join("scene.toml")).expect("a valid scene");
    simulate(&scene, directory.path(), &mut ()).expect("runs");
    let frame = std::fs::read(directory.path().join("particles_000000.vtu")).expect("written");
    assert!(frame == include_bytes!("../data/four_particles.vtu"));
}
