//! Delaunay meshes of random points.

use mpm_mesh::SimplexMesh;
use mpm_mesh::generate::{
    GenerationError, Refinement, Scatter, SizeField, disk_outline, rectangle_outline, scattered, wavy_channel_outline,
    with_outer_layer,
};
use mpm_tensor::vector::{distance, norm_squared};
use rand::RngExt;

use crate::basis_scenes::generator;

fn mesh(polygons: &[Vec<[f64; 2]>], size: &SizeField, sweeps: usize, seed: u64) -> SimplexMesh<2> {
    let mut random = generator(seed);
    scattered(polygons, size, Scatter { sweeps, angle: 0.0 }, &mut || random.random()).expect("a mesh")
}

fn area(polygons: &[Vec<[f64; 2]>]) -> f64 {
    let signed = |corners: &Vec<[f64; 2]>| {
        let pairs = corners.iter().zip(corners.iter().cycle().skip(1));
        0.5 * pairs.map(|(a, b)| a[0] * b[1] - b[0] * a[1]).sum::<f64>().abs()
    };
    signed(&polygons[0]) - polygons[1..].iter().map(signed).sum::<f64>()
}

fn domains() -> Vec<Vec<Vec<[f64; 2]>>> {
    vec![
        vec![rectangle_outline([0.0, -1.0], [2.0, 1.0]).unwrap()],
        vec![disk_outline([0.3, 0.2], 1.0, 0.05).unwrap()],
        vec![wavy_channel_outline([0.0, 4.0], 0.05).unwrap()],
        vec![
            rectangle_outline([0.0, 0.0], [2.0, 2.0]).unwrap(),
            rectangle_outline([0.6, 0.6], [1.4, 1.4]).unwrap(),
        ],
    ]
}

#[test]
fn domains_are_covered_with_cells_of_the_stated_quality() {
    let size = SizeField::new(0.05, vec![]).unwrap();
    for polygons in domains() {
        for seed in 0..5 {
            for sweeps in [0, 2] {
                let mesh = mesh(&polygons, &size, sweeps, seed);
                assert!(
                    (mesh.total_volume() - area(&polygons)).abs() < 1e-9,
                    "conforms to its boundary"
                );
                let (quality, lengths) = (mesh.quality_summary(), mesh.edge_lengths());
                assert!(
                    quality.worst.smallest_angle.to_degrees() > 22.0,
                    "{sweeps} {seed} {quality:?}"
                );
                assert!((lengths.mean / 0.05 - 1.0).abs() < 0.06, "{lengths:?}");
                assert!(
                    lengths.shortest > 0.4 * 0.05 && lengths.longest < 1.75 * 0.05,
                    "{lengths:?}"
                );
                with_outer_layer(&mesh).expect("a layer");
            }
        }
    }
}

/// No point is in the circumscribed circle of a cell.
#[test]
fn meshes_are_delaunay() {
    let size = SizeField::new(0.2, vec![]).unwrap();
    let mesh = mesh(&domains()[0], &size, 1, 3);
    for cell in 0..mesh.cell_count() {
        let [a, b, c] = [0, 1, 2].map(|k| mesh.vertices()[mesh.cell(cell)[k] as usize]);
        let [u, v] = [b, c].map(|x| [x[0] - a[0], x[1] - a[1]]);
        let twice = 2.0 * (u[0] * v[1] - u[1] * v[0]);
        let [uu, vv] = [u, v].map(|x| x[0] * x[0] + x[1] * x[1]);
        let centre = [
            (v[1] * uu - u[1] * vv) / twice + a[0],
            (u[0] * vv - v[0] * uu) / twice + a[1],
        ];
        let radius = distance(&centre, &a);
        assert!(
            mesh.vertices()
                .iter()
                .all(|x| distance(x, &centre) > radius * (1.0 - 1e-9))
        );
    }
}

#[test]
fn edges_follow_the_size_field() {
    let place = Refinement {
        centre: [0.0, 0.0],
        radius: 0.2,
        size: 0.025,
        growth: 0.2,
    };
    let size = SizeField::new(0.2, vec![place]).unwrap();
    let mesh = mesh(&[rectangle_outline([-1.5; 2], [1.5; 2]).unwrap()], &size, 2, 1);
    assert!(mesh.quality_summary().worst.smallest_angle.to_degrees() > 20.0);
    // The points of this seed, whatever finds their neighbours.
    assert_eq!((mesh.vertices().len(), mesh.cell_count()), (969, 1876));
    let squares: f64 = mesh.vertices().iter().map(norm_squared).sum();
    assert!((squares - 591.777_842_200_381).abs() < 1e-9, "{squares}");
    for cell in mesh.cells() {
        for k in 0..3 {
            let [a, b] = [k, (k + 1) % 3].map(|k| mesh.vertices()[cell[k] as usize]);
            let middle = [0, 1].map(|axis| 0.5 * (a[axis] + b[axis]));
            let ratio = distance(&a, &b) / size.at(&middle);
            assert!((0.4..2.0).contains(&ratio), "{middle:?}: {ratio}");
        }
    }
}

/// What a mesh costs, and whether it is too fine, hangs on its points, not on its shortest edge.
#[test]
fn a_very_fine_place_is_a_few_more_points() {
    let around = |radius: f64| Refinement {
        centre: [0.5, 0.5],
        radius,
        size: 1e-5,
        growth: 0.2,
    };
    let square = [rectangle_outline([0.0; 2], [1.0; 2]).unwrap()];
    let field = |radius| SizeField::new(0.1, vec![around(radius)]).unwrap();
    let mesh = mesh(&square, &field(0.0), 2, 0);
    assert!(
        (1000..2500).contains(&mesh.vertices().len()),
        "{}",
        mesh.vertices().len()
    );
    let scatter = Scatter { sweeps: 0, angle: 0.0 };
    let error = scattered(&square, &field(0.2), scatter, &mut || 0.5).expect_err("too fine");
    assert!(
        matches!(error, GenerationError::TooFine { cells, .. } if cells > 1e9),
        "{error}"
    );
}

/// The edges alone would be more than memory has room for.
#[test]
fn a_length_that_is_too_short_is_refused_before_anything_is_divided() {
    let square = [rectangle_outline([0.0; 2], [1.0; 2]).unwrap()];
    let scatter = Scatter { sweeps: 0, angle: 0.0 };
    for length in [1e-9, 1e-8, 1e-5] {
        let field = SizeField::new(length, vec![]).unwrap();
        let error = scattered(&square, &field, scatter, &mut || 0.5).expect_err("too fine");
        let expected = 2.0 / 0.75f64.sqrt() / (length * length);
        assert!(
            matches!(error, GenerationError::TooFine { cells, .. } if (cells / expected - 1.0).abs() < 1e-9),
            "{error}"
        );
    }
}

#[test]
fn a_seed_is_a_mesh() {
    let size = SizeField::new(0.1, vec![]).unwrap();
    let of = |seed| mesh(&domains()[0], &size, 2, seed);
    assert_eq!(of(1), of(1));
    assert_ne!(of(1), of(2));
}

#[test]
fn angles_and_random_numbers_that_are_none_are_refused() {
    let size = SizeField::new(0.2, vec![]).unwrap();
    for (angle, number, name) in [
        (f64::NAN, 0.5, "angle"),
        (f64::INFINITY, 0.5, "angle"),
        (0.0, f64::NAN, "random number"),
        (0.0, 1.0, "random number"),
        (0.0, -0.1, "random number"),
    ] {
        let scatter = Scatter { sweeps: 0, angle };
        let result = scattered(&domains()[0], &size, scatter, &mut || number);
        assert!(
            matches!(result, Err(GenerationError::InvalidParameter { name: found, .. }) if found == name),
            "{angle}, {number}: {:?}",
            result.map(|mesh| mesh.cell_count())
        );
    }
}
