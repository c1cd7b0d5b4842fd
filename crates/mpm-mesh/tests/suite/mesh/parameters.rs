//! What generators refuse, and with which error.

use mpm_mesh::MeshError;
use mpm_mesh::generate::{self, EdgeTarget, GenerationError};
use mpm_tensor::vector;

const TARGET: EdgeTarget = EdgeTarget {
    length: 0.1,
    angle: 0.0,
};

fn parameter<T>(result: Result<T, GenerationError>) -> &'static str {
    match result {
        Err(GenerationError::InvalidParameter { name, .. }) => name,
        Err(other) => panic!("{other}"),
        Ok(_) => panic!("accepted"),
    }
}

#[test]
fn numbers_out_of_range() {
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let target = |length, angle| EdgeTarget { length, angle };
    assert_eq!(parameter(generate::polygon(&square, &target(0.0, 0.0))), "length");
    assert_eq!(parameter(generate::polygon(&square, &target(f64::NAN, 0.0))), "length");
    assert_eq!(parameter(generate::polygon(&square, &target(1.0, f64::NAN))), "angle");
    assert_eq!(parameter(generate::rectangle([0.0; 2], [1.0, -1.0], &TARGET)), "height");
    assert_eq!(parameter(generate::rectangle([0.0; 2], [0.0, 1.0], &TARGET)), "width");
    assert_eq!(parameter(generate::disk([0.0; 2], -1.0, &TARGET)), "radius");
    assert_eq!(
        parameter(generate::wavy_channel([0.0, f64::INFINITY], &TARGET)),
        "height"
    );
    assert_eq!(parameter(generate::wavy_channel([0.5, 20.0], &TARGET)), "floor");
    assert_eq!(parameter(generate::wavy_channel([f64::NAN, 20.0], &TARGET)), "floor");
    assert_eq!(parameter(generate::segments(0.0, &[1.0, 0.0])), "size");
    assert_eq!(parameter(generate::cyclic_sizes(1.0, 0, &[1.0])), "count");
    assert_eq!(parameter(generate::cyclic_sizes(1.0, 2, &[])), "length of the pattern");
    assert_eq!(
        parameter(generate::cyclic_sizes(1.0, 2, &[-1.0])),
        "entry of the pattern"
    );
    assert_eq!(
        parameter(generate::cuboid([0.0; 3], [1.0, 0.0, 1.0], 0.1)),
        "extent along y"
    );
    assert_eq!(parameter(generate::cuboid([0.0; 3], [1.0; 3], -0.1)), "length");
    assert_eq!(parameter(generate::slope(1.0, 1.0, 1.0, 0.0, 0.1)), "width");
    let base = generate::polygon(&square, &TARGET).expect("a mesh");
    assert_eq!(parameter(generate::extruded(&base, -1.0, 0.1)), "width");
    assert_eq!(parameter(generate::extruded(&base, 1.0, f64::INFINITY)), "length");
    assert_eq!(parameter(generate::ball([0.0; 3], 0.0, 0.1)), "radius");
}

#[test]
fn moves_out_of_range() {
    let mesh = generate::rectangle([0.0; 2], [1.0; 2], &TARGET).expect("a mesh");
    for (amplitude, number, expected) in [
        (f64::NAN, 0.5, "amplitude"),
        (-0.1, 0.5, "amplitude"),
        (1.1, 0.5, "amplitude"),
        (1.0, f64::NAN, "random number"),
        (1.0, 1.0, "random number"),
        (1.0, -0.1, "random number"),
    ] {
        let result = mesh.jittered(amplitude, || number);
        assert!(
            matches!(result, Err(MeshError::InvalidParameter { name, .. }) if name == expected),
            "{amplitude}, {number}: {:?}",
            result.map(|mesh| mesh.cell_count())
        );
    }
    let error = mesh.jittered(f64::NAN, || 0.5).expect_err("no amplitude");
    assert_eq!(error.to_string(), "amplitude is NaN, it should be from 0 to 1");
}

#[test]
fn more_cells_than_are_sensible() {
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let fine = EdgeTarget {
        length: 1e-6,
        angle: 0.0,
    };
    let too_fine = |error| matches!(error, GenerationError::TooFine { .. });
    assert!(too_fine(generate::polygon(&square, &fine).expect_err("too many")));
    assert!(too_fine(
        generate::cuboid([0.0; 3], [1.0; 3], 1e-3).expect_err("too many")
    ));
    assert!(too_fine(generate::ball([0.0; 3], 1.0, 1e-3).expect_err("too many")));
}

#[test]
fn polygons_that_bound_nothing() {
    let line = [[0.0, 0.0], [1.0, 0.0]];
    let error = GenerationError::TooFewCorners { outline: 0, corners: 2 };
    assert_eq!(generate::polygon(&line, &TARGET), Err(error));
    let flat = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]];
    let crossing = |error: Result<_, _>| matches!(error, Err(GenerationError::CrossingOutlines { .. }));
    assert!(crossing(generate::polygon(&flat, &TARGET)));
    let bow = [[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
    assert!(crossing(generate::polygon(&bow, &TARGET)));
    let repeated = [[0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    assert!(crossing(generate::polygon(&repeated, &TARGET)));
    let pinched = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
    assert!(crossing(generate::polygon(&pinched, &TARGET)));
    // A length at which every side stays whole, and one at which all are divided.
    for length in [9.0, 0.13] {
        for (corners, place) in [
            (&bow[..], [0.5, 0.5]),
            (&[[0.0, 0.0], [3.0, 3.0], [3.0, 0.0], [0.0, 1.0]], [0.75, 0.75]),
            (&repeated, [1.0, 0.0]),
            (&pinched, [1.0, 0.0]),
        ] {
            let error = generate::polygon(corners, &EdgeTarget { length, angle: 0.0 });
            let Err(GenerationError::CrossingOutlines { position: Some(found) }) = error else {
                panic!("{corners:?}: {error:?}");
            };
            assert!(vector::distance(&found, &place) < 1e-12, "{corners:?}: {found:?}");
        }
    }
    let lost = [[0.0, 0.0], [1.0, 0.0], [f64::NAN, 1.0]];
    let error = generate::polygon(&lost, &TARGET);
    assert!(matches!(
        error,
        Err(GenerationError::InvalidCorner {
            outline: 0,
            corner: 2,
            ..
        })
    ));
    assert_eq!(
        generate::outlines(&[], &TARGET),
        Err(MeshError::Empty { what: "vertices" }.into())
    );
}
