//! Conditions on named facets of a mesh from a file.

use std::fmt::Write as _;
use std::path::Path;

use mpm_mesh::generate::{EdgeTarget, disk, rectangle};
use mpm_mesh::{BoundaryFacet, SimplexMesh};
use mpm_scenes::{Scene, Snapshot, frames};

/// A mesh whose boundary is in physical groups by number and name, as a file of version 2.2.
pub fn msh(mesh: &SimplexMesh<2>, names: &[(u32, &str)], group: impl Fn(&BoundaryFacet<2>) -> u32) -> String {
    let mut text = format!(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{}\n",
        names.len()
    );
    for (number, name) in names {
        let _ = writeln!(text, "1 {number} \"{name}\"");
    }
    let _ = writeln!(text, "$EndPhysicalNames\n$Nodes\n{}", mesh.vertices().len());
    for (tag, [x, y]) in (1..).zip(mesh.vertices()) {
        let _ = writeln!(text, "{tag} {x:e} {y:e} 0");
    }
    let boundary = mesh.boundary();
    let _ = writeln!(text, "$EndNodes\n$Elements\n{}", boundary.len() + mesh.cell_count());
    for (tag, facet) in (1..).zip(&boundary) {
        let [a, b] = facet.vertices.map(|vertex| vertex + 1);
        let _ = writeln!(text, "{tag} 1 2 {} 1 {a} {b}", group(facet));
    }
    for (tag, cell) in (boundary.len() + 1..).zip(mesh.cells()) {
        let _ = writeln!(text, "{tag} 2 2 0 1 {} {} {}", cell[0] + 1, cell[1] + 1, cell[2] + 1);
    }
    text + "$EndElements\n"
}

/// A disk of radius 1 whose boundary is the physical group `rim`.
fn file() -> String {
    let target = EdgeTarget {
        length: 0.2,
        angle: 0.3,
    };
    let mesh = disk([0.0; 2], 1.0, &target).expect("a disk");
    msh(&mesh, &[(4, "rim")], |_| 4)
}

const SCENE: &str = r#"
title = "disk"
dimension = 2

[mesh]
file = "disk.msh"

[transfer]
kind = "flip"
flip_share = 1.0

[time]
end = 0.2

[materials]
water = { law = "tait-fluid", density = 1.0, sound_speed = 10.0 }

[[bodies]]
name = "water"
material = "water"
shape = { kind = "sphere", centre = [0.0, 0.0], radius = 0.99 }
spacing = 0.05
velocity = { kind = "linear", centre = [0.0, 0.0], gradient = [[0.0, 1.5], [0.0, 0.0]] }

[[facets]]
group = "rim"
condition = "prescribed"
velocity = { kind = "linear", centre = [0.0, 0.0], gradient = [[0.0, 1.5], [0.0, 0.0]] }

[output]
interval = 0.2
"#;

fn scene(directory: &Path, changes: &[(&str, &str)]) -> Result<Scene, mpm_scenes::SceneError> {
    std::fs::write(directory.join("disk.msh"), file()).expect("writable");
    let mut text = SCENE.to_owned();
    for (old, new) in changes {
        assert!(text.contains(old), "{old}");
        text = text.replace(old, new);
    }
    Scene::parse(&text, &directory.join("scene.toml"))
}

/// The frame of the end.
fn end(changes: &[(&str, &str)]) -> Snapshot {
    let directory = tempfile::tempdir().expect("a directory");
    let scene = scene(directory.path(), changes).expect("a scene");
    let mut last = Snapshot::default();
    frames(&scene, &mut |snapshot| last = snapshot).expect("a run");
    last
}

/// A fluid that moves through the mesh as one: the rim that goes with it does not disturb it, whatever its shape. (Fields that are linear: `run::tagged`.)
#[test]
fn a_body_that_moves_with_its_curved_boundary_is_not_disturbed() {
    let velocity = "velocity = { kind = \"linear\", centre = [0.0, 0.0], gradient = [[0.0, 1.5], [0.0, 0.0]] }";
    let last = end(&[(velocity, "velocity = [0.3, -0.2]")]);
    let places = last
        .reference_positions
        .chunks_exact(2)
        .zip(last.positions.chunks_exact(2));
    for ((start, x), v) in places.zip(last.velocities.chunks_exact(2)) {
        let off = (x[0] - start[0] - 0.06).abs().max((x[1] - start[1] + 0.04).abs());
        assert!(off < 1e-12, "{start:?}: {x:?}");
        assert!(
            (v[0] - 0.3).abs() < 1e-11 && (v[1] + 0.2).abs() < 1e-11,
            "{start:?}: {v:?}"
        );
    }
    assert!(last.volume_ratios.iter().all(|ratio| (ratio - 1.0).abs() < 1e-12));
}

/// Without the condition the rim is free; with a rim at rest the fluid there stays behind.
#[test]
fn the_rim_matters() {
    let slowest = |changes: &[(&str, &str)]| {
        let last = end(changes);
        let pairs = last.positions.chunks_exact(2).zip(last.velocities.chunks_exact(2));
        let lag = pairs.map(|(x, v)| (v[0] - 1.5 * x[1]).abs() / 1.5);
        lag.fold(0.0, f64::max)
    };
    let velocity =
        "velocity = { kind = \"linear\", centre = [0.0, 0.0], gradient = [[0.0, 1.5], [0.0, 0.0]] }\n\n[output]";
    let held = slowest(&[
        ("condition = \"prescribed\"", "condition = \"fixed\""),
        (velocity, "[output]"),
    ]);
    assert!(held > 0.3, "{held}");
}

/// A fluid that falls within the disk: a wall that it slides along keeps it inside, and a rough one too.
#[test]
fn a_rim_that_lets_slide_keeps_the_body_inside() {
    for condition in ["condition = \"slip\"", "condition = \"friction\"\nfriction = 0.3"] {
        let last = end(&[
            ("condition = \"prescribed\"", condition),
            (
                "velocity = { kind = \"linear\", centre = [0.0, 0.0], gradient = [[0.0, 1.5], [0.0, 0.0]] }\n\n[output]",
                "[output]",
            ),
            (
                "velocity = { kind = \"linear\", centre = [0.0, 0.0], gradient = [[0.0, 1.5], [0.0, 0.0]] }\n\n[[facets]]",
                "velocity = [0.0, -1.0]\n\n[[facets]]",
            ),
            ("radius = 0.99", "radius = 0.6"),
            ("end = 0.2", "end = 0.8"),
            ("interval = 0.2", "interval = 0.8"),
        ]);
        let farthest = last
            .positions
            .chunks_exact(2)
            .map(|x| x[0].hypot(x[1]))
            .fold(0.0, f64::max);
        assert!(farthest < 1.02, "{condition}: {farthest}");
    }
}

#[test]
fn groups_that_name_nothing_are_refused() {
    let directory = tempfile::tempdir().expect("a directory");
    let unknown = scene(directory.path(), &[("group = \"rim\"", "group = \"rum\"")]).expect("read without the mesh");
    let error = frames(&unknown, &mut |_| {}).expect_err("no such group").to_string();
    assert!(
        error.contains("facets[0].group = \"rum\"") && error.ends_with("of the mesh: boundary, rim"),
        "{error}"
    );
    let refused = |changes: &[(&str, &str)]| scene(directory.path(), changes).expect_err("refused").to_string();
    let velocity =
        "velocity = { kind = \"linear\", centre = [0.0, 0.0], gradient = [[0.0, 1.5], [0.0, 0.0]] }\n\n[output]";
    for (changes, part) in [
        (
            vec![(
                "[mesh]\nfile = \"disk.msh\"",
                "[domain]\nlower = [-2.0, -2.0]\nupper = [2.0, 2.0]\n\n[grid]\nspacing = 0.2",
            )],
            "facets[0].group = \"rim\": must be one of a [mesh]: a [grid] has no facets, leave [[facets]] out",
        ),
        (vec![(velocity, "[output]")], "facets[0].velocity"),
        (
            vec![("condition = \"prescribed\"", "condition = \"fixed\"")],
            "facets[0].condition",
        ),
        (
            vec![
                ("condition = \"prescribed\"", "condition = \"friction\""),
                (velocity, "[output]"),
            ],
            "facets[0].friction",
        ),
        (
            vec![
                ("condition = \"prescribed\"", "condition = \"traction\""),
                (velocity, "[output]"),
            ],
            "facets[0].traction",
        ),
        (
            vec![
                (
                    "condition = \"prescribed\"",
                    "condition = \"traction\"\npressure = 1.0\ntraction = [1.0, 0.0]",
                ),
                (velocity, "[output]"),
            ],
            "facets[0].traction",
        ),
        (
            vec![
                ("condition = \"prescribed\"", "condition = \"traction\"\npressure = 1.0"),
                (velocity, "[output]"),
                ("end = 0.2", "end = 0.2\nstress_update = \"first\""),
            ],
            "time.stress_update",
        ),
        (
            vec![(
                "condition = \"prescribed\"",
                "condition = \"prescribed\"\npressure = 1.0",
            )],
            "facets[0].pressure",
        ),
        (
            vec![(
                "condition = \"prescribed\"",
                "condition = \"prescribed\"\namplitude = [[0.0, 1.0]]",
            )],
            "facets[0].amplitude",
        ),
        (
            vec![
                (
                    "condition = \"prescribed\"",
                    "condition = \"traction\"\npressure = { kind = \"hydrostatic\", density = 1.0, surface = [0.0, 0.0] }",
                ),
                (velocity, "[output]"),
            ],
            "facets[0].pressure",
        ),
        (
            vec![
                (
                    "condition = \"prescribed\"",
                    "condition = \"traction\"\npressure = { kind = \"hydrostatic\", density = 1.0, surface = [0.0] }",
                ),
                (velocity, "[output]"),
            ],
            "facets[0].pressure.surface",
        ),
        (
            vec![
                (
                    "condition = \"prescribed\"",
                    "condition = \"traction\"\npressure = { kind = \"static\" }",
                ),
                (velocity, "[output]"),
            ],
            "unknown variant `static`",
        ),
        (
            vec![
                ("condition = \"prescribed\"", "condition = \"traction\"\npressure = nan"),
                (velocity, "[output]"),
            ],
            "facets[0].pressure",
        ),
        (
            vec![
                (
                    "condition = \"prescribed\"",
                    "condition = \"traction\"\ntraction = { kind = \"linear\", centre = [0.0, 0.0], gradient = [[1.0, 0.0]] }",
                ),
                (velocity, "[output]"),
            ],
            "facets[0].traction.gradient",
        ),
        (
            vec![
                (
                    "condition = \"prescribed\"",
                    "condition = \"traction\"\npressure = 1.0\namplitude = []",
                ),
                (velocity, "[output]"),
            ],
            "facets[0].amplitude",
        ),
        (
            vec![
                (
                    "condition = \"prescribed\"",
                    "condition = \"traction\"\npressure = 1.0\namplitude = [[1.0, 0.0], [0.5, 1.0]]",
                ),
                (velocity, "[output]"),
            ],
            "facets[0].amplitude",
        ),
        (
            vec![
                (
                    "condition = \"prescribed\"",
                    "condition = \"traction\"\npressure = 1.0\nramp = 1.0\namplitude = [[0.0, 0.0], [0.5, 1.0]]",
                ),
                (velocity, "[output]"),
            ],
            "facets[0].ramp",
        ),
        (
            vec![
                (
                    "condition = \"prescribed\"",
                    "condition = \"traction\"\ntraction = { kind = \"manufactured\", solution = \"axis-aligned\" }",
                ),
                (velocity, "[output]"),
            ],
            "facets[0].traction",
        ),
    ] {
        let message = refused(&changes);
        assert!(message.contains(part), "{message}");
    }
}

/// Within the mesh facets have no side that a body is on.
#[test]
fn conditions_along_normals_need_a_boundary() {
    let directory = tempfile::tempdir().expect("a directory");
    let velocity =
        "velocity = { kind = \"linear\", centre = [0.0, 0.0], gradient = [[0.0, 1.5], [0.0, 0.0]] }\n\n[output]";
    for condition in [
        "\"slip\"",
        "\"friction\"\nfriction = 0.3",
        "\"traction\"\npressure = 1.0",
    ] {
        let condition = format!("condition = {condition}");
        let changes = [
            ("condition = \"prescribed\"", condition.as_str()),
            (velocity, "[output]"),
        ];
        let inside = scene(directory.path(), &changes).expect("read without the mesh");
        // The rim is a group of another number, and the first of its elements one between two vertices inside.
        let whole = file().replace(" 1 2 4 1 ", " 1 2 5 1 ");
        let first = whole
            .lines()
            .find(|line| line.starts_with("1 1 2 5 1 "))
            .expect("an element");
        let last = whole.lines().rev().nth(1).expect("a cell");
        let ends: Vec<&str> = last.split(' ').skip(5).take(2).collect();
        let text = whole.replacen(first, &format!("1 1 2 4 1 {} {}", ends[0], ends[1]), 1);
        std::fs::write(directory.path().join("disk.msh"), text).expect("writable");
        let message = frames(&inside, &mut |_| {}).expect_err(&condition).to_string();
        let expected = "facets[0].group = \"rim\": must be a group with facets of the boundary";
        assert!(message.contains(expected), "{message}");
        // The whole rim, and that facet inside.
        let text = file().replacen(
            first.replace(" 5 1 ", " 4 1 ").as_str(),
            &format!("1 1 2 4 1 {} {}", ends[0], ends[1]),
            1,
        );
        std::fs::write(directory.path().join("disk.msh"), text).expect("writable");
        let message = frames(&inside, &mut |_| {}).expect_err(&condition).to_string();
        let expected = "must be a group of facets of the boundary alone: 1 are inside the mesh";
        assert!(message.contains(expected), "{message}");
    }
}

/// Without a file there is the group of the whole boundary: here the disk's, as `rim` is.
#[test]
fn a_generated_mesh_has_its_boundary() {
    let of_file = end(&[]);
    let generated = end(&[
        (
            "file = \"disk.msh\"",
            "generate = { kind = \"disk\", centre = [0.0, 0.0], radius = 1.0, size = 0.2 }\nangle = 17.188733853924695",
        ),
        ("group = \"rim\"", "group = \"boundary\""),
    ]);
    assert_eq!(of_file.positions.len(), generated.positions.len());
    for (a, b) in of_file.positions.iter().zip(&generated.positions) {
        assert!((a - b).abs() < 1e-9, "{a}, {b}");
    }
}

/// Facets stay where they are: what they prescribe leads along them, or hardly across.
#[test]
fn facets_that_would_travel_are_refused() {
    let velocity =
        "velocity = { kind = \"linear\", centre = [0.0, 0.0], gradient = [[0.0, 1.5], [0.0, 0.0]] }\n\n[output]";
    for travels in [
        "[3.0, 0.0]",
        "{ kind = \"rotation\", centre = [0.0, 4.0], rate = [1.5] }",
    ] {
        let directory = tempfile::tempdir().expect("a directory");
        let changed = format!("velocity = {travels}\n\n[output]");
        let scene = scene(directory.path(), &[(velocity, &changed)]).expect("a scene");
        let message = frames(&scene, &mut |_| {}).expect_err(travels).to_string();
        let expected = format!("facets[0].velocity = {travels}: must be along the facets, or across");
        assert!(message.contains(&expected), "{message}");
    }
}

/// A unit square whose left side and whose bottom are groups, and how bodies stand in it.
fn in_a_square(text: &str) -> Snapshot {
    let target = EdgeTarget {
        length: 0.1,
        angle: 0.2,
    };
    let square = rectangle([0.0; 2], [1.0; 2], &target).expect("a square");
    let names = [(1, "left"), (2, "bottom"), (3, "rest")];
    let text_of_mesh = msh(&square, &names, |facet| match facet.normal {
        [x, _] if x < -0.5 => 1,
        [_, y] if y < -0.5 => 2,
        _ => 3,
    });
    let directory = tempfile::tempdir().expect("a directory");
    std::fs::write(directory.path().join("square.msh"), text_of_mesh).expect("writable");
    let head = "title = \"square\"\ndimension = 2\nmesh = { file = \"square.msh\" }\n";
    let scene = Scene::parse(&format!("{head}{text}"), &directory.path().join("scene.toml")).expect("a scene");
    let mut last = Snapshot::default();
    frames(&scene, &mut |snapshot| last = snapshot).expect("a run");
    last
}

/// Water at rest in a square tank: no normal of a corner is one of its sides, and nothing flows around it.
#[test]
fn a_group_with_corners_holds_on_both_sides_of_them() {
    let water = r#"
gravity = [0.0, -10.0]
transfer = { kind = "apic" }
time = { end = 1.0, damping = 5.0 }
materials.water = { law = "tait-fluid", density = 1000.0, sound_speed = 20.0 }
output = { interval = 1.0 }
bodies = [{ name = "water", material = "water", shape = { kind = "box", lower = [0.0, 0.0], upper = [1.0, 0.6] }, spacing = 0.04 }]
facets = [{ group = "boundary", "#;
    for condition in ["condition = \"slip\"", "condition = \"friction\", friction = 0.0"] {
        let last = in_a_square(&format!("{water}{condition} }}]\n"));
        let lowest = last.positions.iter().copied().fold(f64::INFINITY, f64::min);
        assert!(lowest > 0.01, "{condition}: {lowest}");
        let changes = last.volume_ratios.iter().map(|ratio| (ratio - 1.0).abs());
        let largest = changes.fold(0.0, f64::max);
        assert!(largest < 0.06, "{condition}: {largest}");
    }
}

/// A block that slides on the bottom towards the left side is free until it gets there, at t = 0.18.
#[test]
fn a_body_on_one_group_does_not_touch_another() {
    let block = r#"
transfer = { kind = "apic" }
time = { end = 0.15 }
materials.rubber = { law = "neo-hookean", density = 1000.0, young_modulus = 1e6, poisson_ratio = 0.0 }
output = { interval = 0.15 }
bodies = [{ name = "block", material = "rubber", shape = { kind = "box", lower = [0.2, 0.0], upper = [0.6, 0.2] }, spacing = 0.04, velocity = [-1.0, 0.0] }]
facets = [GROUPS]
"#;
    let groups = |names: &[&str]| {
        let rough = |name: &&str| format!("{{ group = \"{name}\", condition = \"friction\", friction = 0.0 }}");
        block.replace("GROUPS", &names.iter().map(rough).collect::<Vec<_>>().join(", "))
    };
    for names in [["left", "bottom"].as_slice(), &["boundary"]] {
        let last = in_a_square(&groups(names));
        let fastest = last
            .velocities
            .chunks_exact(2)
            .map(|v| (v[0] + 1.0).abs())
            .fold(0.0, f64::max);
        assert!(fastest < 1e-9, "{names:?}: {fastest}");
    }
}
