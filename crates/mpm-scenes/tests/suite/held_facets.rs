//! What facets that hold or let slide hold of a body that pulls at them.

use mpm_mesh::SimplexMesh;
use mpm_mesh::generate::{EdgeTarget, disk_outline, outlines, rectangle_outline};
use mpm_scenes::{Scene, Snapshot, frames};

use crate::facets::msh;

const SCENE: &str = r#"
title = "pulled"
dimension = 2

[mesh]
file = "body.msh"
width = "local"
kernel = "smooth"
gradient = "exact"

[time]
end = 3.0
courant = 0.4
damping = 6.0

[materials.soft]
law = "linear-elastic"
density = 1.0
young_modulus = 100.0
poisson_ratio = 0.3

[[bodies]]
name = "body"
material = "soft"
fill = "cells"
particles_per_axis = 2
shape = { kind = "box", lower = [-3.0, -3.0], upper = [3.0, 3.0] }

[output]
interval = 3.0
"#;

/// The last frame of the scene with these conditions on a mesh with these groups, and how many steps it took.
fn run(mesh: &str, conditions: &str) -> (Snapshot, u64) {
    let directory = tempfile::tempdir().expect("a directory");
    std::fs::write(directory.path().join("body.msh"), mesh).expect("writable");
    let text = SCENE.replace("[output]", &format!("{conditions}\n[output]"));
    let scene = Scene::parse(&text, &directory.path().join("scene.toml")).expect("a scene");
    let mut last = Snapshot::default();
    let effort = frames(&scene, &mut |snapshot| last = snapshot).expect("a run");
    (last, effort.steps)
}

fn facets(group: &str, condition: &str) -> String {
    format!("[[facets]]\ngroup = \"{group}\"\ncondition = \"{condition}\"\n")
}

/// Reference positions and displacements.
fn displacements(last: &Snapshot) -> impl Iterator<Item = ([f64; 2], [f64; 2])> {
    let pairs = last
        .reference_positions
        .chunks_exact(2)
        .zip(last.positions.chunks_exact(2));
    pairs.map(|(start, x)| ([start[0], start[1]], [x[0] - start[0], x[1] - start[1]]))
}

fn mesh(polygons: &[Vec<[f64; 2]>], length: f64) -> SimplexMesh<2> {
    outlines(polygons, &EdgeTarget { length, angle: 0.2 }).expect("a mesh")
}

/// A unit square on rollers, pulled at the top: u = σ (−ν (1 + ν) x, (1 − ν²) y) / E in plane strain.
#[test]
fn a_square_on_rollers_stretches_by_the_formula() {
    let square = mesh(&[rectangle_outline([0.0; 2], [1.0; 2]).expect("a square")], 0.2);
    let names = [(1, "left"), (2, "bottom"), (3, "top"), (4, "right")];
    let text = msh(&square, &names, |facet| match facet.normal {
        [x, _] if x < -0.5 => 1,
        [_, y] if y < -0.5 => 2,
        [_, y] if y > 0.5 => 3,
        _ => 4,
    });
    let pull = facets("top", "traction") + "traction = [0.0, 0.1]\nramp = 0.3\n";
    let (last, _) = run(&text, &(facets("left", "slip") + &facets("bottom", "slip") + &pull));
    let (mut across, mut along) = ([0.0; 2], [0.0; 2]);
    for (start, u) in displacements(&last) {
        across = [across[0] + start[0], across[1] + u[0]];
        along = [along[0] + start[1], along[1] + u[1]];
    }
    let stretch = along[1] / along[0] / (0.001 * (1.0 - 0.09));
    let contraction = across[1] / across[0] / (-0.001 * 0.3 * 1.3);
    assert!((stretch - 1.0).abs() < 0.02, "{stretch}");
    assert!((contraction - 1.0).abs() < 0.03, "{contraction}");
}

/// A ring held inside and pressed from outside, in plane strain: u = A (r − a²/r), A = −p / (2 (λ + μ) + 2 μ a²/b²). Its held facets are curved.
#[test]
fn a_ring_held_inside_gives_way_by_the_formula() {
    let (a, b) = (1.0_f64, 2.0_f64);
    let circle = |radius| disk_outline([0.0; 2], radius, 0.2).expect("a circle");
    let ring = mesh(&[circle(b), circle(a)], 0.2);
    let text = msh(&ring, &[(1, "inner"), (2, "outer")], |facet| {
        let [x, y] = ring.vertices()[facet.vertices[0] as usize];
        if x.hypot(y) < 1.5 { 1 } else { 2 }
    });
    let press = facets("outer", "traction") + "pressure = 0.1\nramp = 0.3\n";
    let (last, _) = run(&text, &(facets("inner", "fixed") + &press));
    let (lambda, mu) = (30.0 / (1.3 * 0.4), 100.0 / 2.6);
    let coefficient = -0.1 / (2.0 * (lambda + mu) + 2.0 * mu * (a / b).powi(2));
    let (mut found, mut expected) = (0.0, 0.0);
    for ([x, y], u) in displacements(&last) {
        let r = x.hypot(y);
        found += (u[0] * x + u[1] * y) / r;
        expected += coefficient * (r - a * a / r);
    }
    assert!((found / expected - 1.0).abs() < 0.05, "{}", found / expected);
}

/// A hull whose plane bottom goes over into its sides at 170°: images of the cells at the bottom would leave notches of 20° there.
#[test]
fn a_plane_group_beside_nearly_plane_sides_does_not_shorten_the_step() {
    let hull = vec![
        [0.0, 0.0],
        [1.0, 0.0],
        [1.985, 0.174],
        [1.985, 1.0],
        [-0.985, 1.0],
        [-0.985, 0.174],
    ];
    let hull = mesh(&[hull], 0.2);
    let text = msh(&hull, &[(1, "bottom"), (2, "rest")], |facet| {
        if facet.normal[1] < -0.999 { 1 } else { 2 }
    });
    let steps = |conditions: &str| run(&text, conditions).1;
    let (held, loaded) = (
        steps(&facets("bottom", "fixed")),
        steps(&(facets("bottom", "traction") + "pressure = 0.0\n")),
    );
    assert!(held as f64 <= 1.5 * loaded as f64, "{held} {loaded}");
}
