//! Lattices.

use mpm_scenes::SceneFault;
use mpm_scenes::fill::regular;
use mpm_scenes::shape::{Ball, Bounds, Cuboid, HalfSpace, Shape};

#[test]
fn whole_cells_get_all_their_particles() {
    let shape = Cuboid {
        lower: [0.5, -0.25],
        upper: [1.5, 0.5],
    };
    let filling = regular("block", &shape, &[0.0, 0.0], 0.125, &Bounds::EVERYWHERE).expect("few points");
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
    let filling = regular("block", &shape, &[0.0; 3], 0.025, &Bounds::EVERYWHERE).expect("few points");
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
    let filling = regular("block", &shape, &[0.0, 0.0], 0.25, &room).expect("few points");
    assert_eq!(filling.positions.len(), 8);
    let many = regular("block", &shape, &[0.0, 0.0], 1e-9, &room);
    assert!(matches!(many, Err(SceneFault::TooManyPoints { body, .. }) if body == "block"));
}
