//! Signed distances.

use mpm_scenes::shape::{Ball, Capsule, Cuboid, Difference, HalfSpace, Intersection, Polygon, Shape, Twisted, Union};
use proptest::prelude::*;

fn shapes() -> Vec<Box<dyn Shape<2>>> {
    let square = || Cuboid {
        lower: [-1.0, -0.5],
        upper: [0.5, 1.0],
    };
    let ball = || Ball {
        centre: [0.3, 0.2],
        radius: 0.6,
    };
    vec![
        Box::new(square()),
        Box::new(ball()),
        Box::new(Capsule {
            start: [-0.5, -0.5],
            end: [0.7, 0.1],
            radius: 0.25,
        }),
        Box::new(Polygon {
            corners: vec![[-1.0, -1.0], [1.0, -0.8], [0.2, 0.0], [0.9, 1.0], [-0.7, 0.6]],
        }),
        Box::new(HalfSpace {
            point: [0.1, 0.1],
            normal: [0.6, 0.8],
        }),
        Box::new(Union(vec![Box::new(square()), Box::new(ball())])),
        Box::new(Intersection(vec![Box::new(square()), Box::new(ball())])),
        Box::new(Difference {
            from: Box::new(square()),
            remove: vec![Box::new(ball())],
        }),
    ]
}

proptest! {
    /// |d(x) − d(y)| ≤ |x − y|, with which no surface point can be nearer than |d|.
    #[test]
    fn distances_never_grow_faster_than_the_way(x in [-2.0..2.0, -2.0..2.0], y in [-2.0..2.0, -2.0..2.0]) {
        for shape in shapes() {
            let change = (shape.distance(&x) - shape.distance(&y)).abs();
            prop_assert!(change <= mpm_tensor::vector::distance(&x, &y) + 1e-12, "{shape:?}");
            prop_assert!(shape.distance(&x) > 0.0 || shape.bounds().contains(&x), "{shape:?}");
        }
    }

    /// Of convex shapes, whose outsides have no ridges.
    #[test]
    fn normals_point_to_larger_distances(x in [-2.0..2.0, -2.0..2.0]) {
        for index in [0, 1, 2, 4] {
            let shape = &shapes()[index];
            let n = shape.normal(&x);
            prop_assert!((mpm_tensor::vector::norm(&n) - 1.0).abs() < 1e-12);
            let further = std::array::from_fn(|a| x[a] + 1e-4 * n[a]);
            prop_assert!(shape.distance(&further) > shape.distance(&x), "{shape:?} at {x:?}");
        }
    }
}

#[test]
fn volumes_agree_with_counting_points() {
    for shape in shapes() {
        let Some(volume) = shape.volume() else { continue };
        let count = (0..400 * 400)
            .filter(|k| {
                shape.distance(&[
                    -2.0 + 0.01 * (f64::from(k % 400) + 0.5),
                    -2.0 + 0.01 * (f64::from(k / 400) + 0.5),
                ]) < 0.0
            })
            .count();
        assert!(
            (count as f64 * 1e-4 - volume).abs() < 5e-3 * volume,
            "{shape:?}: {volume}"
        );
    }
    let ball = Ball {
        centre: [0.0; 3],
        radius: 2.0,
    };
    assert!((ball.volume().expect("known") - 33.510321638291124).abs() < 1e-13);
}

#[test]
fn normals_of_combinations_are_those_of_the_surface_at_hand() {
    let ring = Difference {
        from: Box::new(Ball {
            centre: [0.0, 0.0],
            radius: 2.0,
        }),
        remove: vec![Box::new(Ball {
            centre: [0.0, 0.0],
            radius: 1.0,
        })],
    };
    assert_eq!(ring.normal(&[1.1, 0.0]), [-1.0, 0.0]);
    assert_eq!(ring.normal(&[0.0, 1.9]), [0.0, 1.0]);
    let [.., union, intersection, _] = &shapes()[..] else {
        panic!("eight shapes")
    };
    assert_eq!(union.normal(&[2.3, 0.2]), [1.0, 0.0]);
    assert!((intersection.normal(&[-1.5, 0.2])[0] + 1.0).abs() < 1e-9);
}

/// With coordinates of a map, in metres, and in a scene of nanometres.
#[test]
fn normals_do_not_hang_on_the_size_of_coordinates() {
    for (origin, size) in [([5e5, 5e6], 1.0), ([0.0, 0.0], 1e-9)] {
        let at = |x: f64, y: f64| [origin[0] + size * x, origin[1] + size * y];
        let slab = Cuboid {
            lower: at(0.0, 0.0),
            upper: at(4.0, 0.5),
        };
        let ramp = Polygon {
            corners: vec![at(0.0, 0.0), at(4.0, 0.0), at(0.0, 3.0)],
        };
        assert_eq!(slab.normal(&at(2.0, 0.45)), [0.0, 1.0], "{origin:?}");
        assert_eq!(slab.normal(&at(0.1, 0.25)), [-1.0, 0.0], "{origin:?}");
        let normal = ramp.normal(&at(2.0, 1.4));
        assert!(
            (normal[0] - 0.6).hypot(normal[1] - 0.8) < 1e-2,
            "{origin:?}: {normal:?}"
        );
    }
}

#[test]
fn areas_of_polygons_do_not_cancel_far_from_the_origin() {
    let at = |x: f64, y: f64| [5e5 + x, 5e6 + y];
    let corners = vec![at(0.1, 0.3), at(0.9, 0.3), at(0.9, 0.7), at(0.1, 0.7)];
    let area = Shape::<2>::volume(&Polygon { corners }).expect("closed form");
    assert!((area - 0.32).abs() < 1e-8, "{area}");
}

#[test]
fn distances_follow_the_hand_calculation() {
    let square = Cuboid {
        lower: [0.0, 0.0],
        upper: [2.0, 1.0],
    };
    assert_eq!(square.distance(&[5.0, 5.0]), 5.0);
    assert_eq!(square.distance(&[1.0, 0.75]), -0.25);
    let triangle = Polygon {
        corners: vec![[0.0, 0.0], [4.0, 0.0], [0.0, 3.0]],
    };
    assert_eq!(Shape::<2>::distance(&triangle, &[-1.0, 1.0]), 1.0);
    assert!((Shape::<2>::distance(&triangle, &[1.0, 1.0]) + 1.0).abs() < 1e-15);
    assert_eq!(Shape::<2>::volume(&triangle), Some(6.0));
}

proptest! {
    /// As above, for a twist, at points of a path that leaves the shape's bounds.
    #[test]
    fn a_twist_turns_sections_and_never_promises_too_much(x in [-2.0..2.0, -2.0..2.0, -1.5..3.0], rate in -2.0..2.0) {
        let straight = Cuboid { lower: [-0.5, -0.25, 0.0], upper: [0.5, 0.25, 2.0] };
        let shape = Twisted::new(Box::new(straight), rate);
        // The corner (½, ¼) of the section at this height is on the surface.
        let height = f64::clamp(x[2], 0.0, 2.0);
        let (sine, cosine) = (rate * height).sin_cos();
        let corner = [0.5 * cosine - 0.25 * sine, 0.5 * sine + 0.25 * cosine, height];
        prop_assert!(shape.distance(&corner).abs() < 1e-12);
        prop_assert!(shape.distance(&[0.0, 0.0, 1.0]) < 0.0 && shape.distance(&[0.0, 0.0, 2.1]) > 0.0);
        prop_assert!(shape.bounds().contains(&corner));
        prop_assert!(shape.distance(&x).abs() <= mpm_tensor::vector::distance(&x, &corner) + 1e-12);
    }
}
