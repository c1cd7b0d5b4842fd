//! Rings of round shapes.

use std::f64::consts::PI;

use mpm_scenes::fill::rings;
use mpm_scenes::shape::{Ball, Bounds, Cuboid, Difference, Shape};

fn ball(radius: f64) -> Ball<2> {
    Ball {
        centre: [0.3, -0.2],
        radius,
    }
}

#[test]
fn volumes_add_up_to_the_area_and_the_centre_is_that_of_the_shape() {
    let annulus = Difference {
        from: Box::new(ball(1.25)),
        remove: vec![Box::new(ball(0.75))],
    };
    let disk = ball(0.2);
    let shapes: [(&dyn Shape<2>, f64); 2] = [(&annulus, 1.25f64.powi(2) - 0.75f64.powi(2)), (&disk, 0.04)];
    for (shape, square) in shapes {
        let filling = rings("a", shape, 0.03, &Bounds::EVERYWHERE).expect("round");
        let count = filling.positions.len() as f64;
        assert!((filling.volume() - PI * square).abs() < 1e-12);
        assert!(
            (filling.volume() / (count * 0.03 * 0.03) - 1.0).abs() < 0.1,
            "{}",
            filling.volume() / count
        );
        for (a, middle) in [0.3, -0.2].into_iter().enumerate() {
            let mean = filling.positions.iter().map(|x| x[a]).sum::<f64>() / count;
            assert!((mean - middle).abs() < 1e-12);
        }
        // The polar moment ∫ r² dA = π/2 (R⁴ − r⁴), to second order in the step.
        let moment = filling
            .positions
            .iter()
            .map(|x| (x[0] - 0.3).powi(2) + (x[1] + 0.2).powi(2));
        let exact = if square > 0.5 {
            1.25f64.powi(4) - 0.75f64.powi(4)
        } else {
            0.2f64.powi(4)
        };
        assert!((moment.sum::<f64>() * filling.volumes[0] / (0.5 * PI * exact) - 1.0).abs() < 0.02);
    }
}

#[test]
fn only_round_shapes_have_rings() {
    let square = Cuboid {
        lower: [0.0, 0.0],
        upper: [1.0, 1.0],
    };
    assert!(rings("a", &square, 0.1, &Bounds::EVERYWHERE).is_err());
    let space = Ball {
        centre: [0.0; 3],
        radius: 1.0,
    };
    assert!(rings("a", &space, 0.1, &Bounds::EVERYWHERE).is_err());
}

/// With coordinates of a map, in metres.
#[test]
fn a_disk_far_from_the_origin_is_a_disk() {
    let disk = Ball {
        centre: [500_000.3, 5_000_000.7],
        radius: 0.5,
    };
    let filling = rings("a", &disk, 0.05, &Bounds::EVERYWHERE).expect("round");
    assert!((filling.volume() - PI * 0.25).abs() < 1e-8);
}
