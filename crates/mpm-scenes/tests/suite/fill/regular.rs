//! Lattices.

use std::path::Path;

use mpm_scenes::fill::regular;
use mpm_scenes::shape::{Ball, Bounds, Cuboid, HalfSpace, Shape};
use mpm_scenes::{Scene, SceneFault, frames};

#[test]
fn whole_cells_get_all_their_particles() {
    let shape = Cuboid {
        lower: [0.5, -0.25],
        upper: [1.5, 0.5],
    };
    let filling = regular("block", &shape, &[0.0, 0.0], &[0.125; 2], &Bounds::EVERYWHERE).expect("few points");
    assert_eq!(filling.positions.len(), 8 * 6);
    assert_eq!(filling.positions[0], [0.5625, -0.1875]);
    assert_eq!(filling.positions[47], [1.4375, 0.4375]);
    assert_eq!(filling.volume(), 0.75);
}

#[test]
fn the_volume_of_a_ball_is_met_as_finely_as_the_lattice() {
    let shape = Ball {
        centre: [0.1, 0.2, 0.3],
        radius: 0.5,
    };
    let filling = regular("block", &shape, &[0.0; 3], &[0.025; 3], &Bounds::EVERYWHERE).expect("few points");
    let volume = filling.volume();
    assert!((volume / shape.volume().expect("known") - 1.0).abs() < 0.01, "{volume}");
}

#[test]
fn an_infinite_shape_is_cut_by_the_room() {
    let room = Bounds {
        lower: [0.0, 0.0],
        upper: [1.0, 1.0],
    };
    let shape = HalfSpace {
        point: [0.0, 0.5],
        normal: [0.0, 1.0],
    };
    let filling = regular("block", &shape, &[0.0, 0.0], &[0.25; 2], &room).expect("few points");
    assert_eq!(filling.positions.len(), 8);
    let many = regular("block", &shape, &[0.0, 0.0], &[1e-9; 2], &room);
    assert!(matches!(many, Err(SceneFault::TooManyPoints { body, .. }) if body == "block"));
}

/// On a mesh particles are as far apart as its edges say about, and fill a box from end to end.
#[test]
fn a_lattice_on_a_mesh_ends_where_the_shape_does() {
    let text = r#"
title = "a block on a mesh"
dimension = 2
transfer = { kind = "apic" }
time = { end = 1e-6 }
output = { interval = 1e-6 }
materials.rubber = { law = "neo-hookean", density = 1.0, young_modulus = 1.0, poisson_ratio = 0.3 }
mesh = { generate = { kind = "rectangle", lower = [-1.0, -0.5], upper = [1.0, 0.5], size = 0.3 } }
bodies = [{ name = "block", material = "rubber", shape = { kind = "box", lower = [-1.0, -0.5], upper = [1.0, 0.3] } }]
"#;
    let scene = Scene::parse(text, Path::new("block.toml")).expect("a scene");
    let mut start = None;
    frames(&scene, &mut |snapshot| {
        start.get_or_insert(snapshot);
    })
    .expect("a run");
    let positions = start.expect("a frame").positions;
    for (axis, middle) in [(0, 0.0), (1, -0.1)] {
        let along = positions.iter().skip(axis).step_by(2);
        let (least, most) = along.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), &x| {
            (least.min(x), most.max(x))
        });
        assert!((0.5 * (least + most) - middle).abs() < 1e-9, "{least} to {most}");
    }
}
