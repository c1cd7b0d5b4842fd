//! Meshes whose edges are graded 1 : 8, kernels of local width.

#![allow(clippy::print_stdout, reason = "errors are reported")]

use mpm_mesh::generate::{Refinement, Scatter, SizeField, circle_outline, scattered};
use mpm_mesh::{KernelWidth, MeshBasis};
use mpm_tensor::Matrix;
use mpm_tensor::vector::{distance, norm, norm_squared};
use rand::RngExt;

use crate::basis_scenes::{cloud, generator};

/// Radii of the ring.
const INNER: f64 = 0.25;
const OUTER: f64 = 2.0;

/// A basis of local width on random points between polygons.
pub fn basis(polygons: &[Vec<[f64; 2]>], size: &SizeField) -> MeshBasis<2> {
    let mut random = generator(1);
    let scatter = Scatter { sweeps: 2, angle: 0.0 };
    let mesh = scattered(polygons, size, scatter, &mut || random.random()).unwrap();
    MeshBasis::new(&mesh).unwrap().with_kernel_width(KernelWidth::Local)
}

/// Edges of `least` up to `radius` from the origin, then growing to `base`.
pub fn sizes(base: f64, least: f64, radius: f64) -> SizeField {
    let place = Refinement {
        centre: [0.0; 2],
        radius,
        size: least,
        growth: 0.25,
    };
    SizeField::new(base, vec![place]).unwrap()
}

fn ring(size: &SizeField) -> MeshBasis<2> {
    basis(
        &[OUTER, INNER].map(|radius| circle_outline([0.0; 2], radius, size).unwrap()),
        size,
    )
}

#[test]
fn sides_of_a_circle_follow_the_size_field() {
    let place = Refinement {
        centre: [1.0, 0.0],
        radius: 0.1,
        size: 0.025,
        growth: 0.25,
    };
    let size = SizeField::new(0.2, vec![place]).unwrap();
    let corners = circle_outline([0.0; 2], 1.0, &size).unwrap();
    for (a, b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
        assert!((norm(a) - 1.0).abs() < 1e-14);
        let ratio = distance(a, b) / size.at(&[0, 1].map(|axis| 0.5 * (a[axis] + b[axis])));
        assert!((0.85..1.15).contains(&ratio), "{a:?}: {ratio}");
    }
    let equal = circle_outline([0.0; 2], 1.0, &SizeField::new(0.1, vec![]).unwrap()).unwrap();
    assert_eq!(equal.len(), 63);
    assert!(circle_outline([0.0; 2], -1.0, &size).is_err());
}

/// Root mean square error of Σ u_i g_iᵀ at random points, over the largest gradient, where the nodes have u = x / |x|², the second part of Lamé's displacements.
fn error_of_gradients(basis: &MeshBasis<2>) -> f64 {
    let (mut squares, mut count) = (0.0, 0);
    for x in cloud::<2>(20_000, -OUTER, OUTER, 3) {
        let square = norm_squared(&x);
        if !(INNER * INNER..(0.98 * OUTER).powi(2)).contains(&square) {
            continue;
        }
        let exact = (Matrix::IDENTITY - Matrix::outer(&x, &x) * (2.0 / square)) * (1.0 / square);
        let mut gradient = Matrix::ZERO;
        for weight in basis.weights_at(&x).unwrap() {
            let node = basis.mesh().vertices()[weight.vertex as usize];
            let u = node.map(|c| c / norm_squared(&node));
            gradient += Matrix::outer(&u, &weight.entry.gradient);
        }
        squares += (gradient - exact).frobenius_norm().powi(2);
        count += 1;
    }
    (squares / f64::from(count)).sqrt() * INNER * INNER / 2f64.sqrt()
}

/// Edges of 0.05 at the hole and 0.4 at the rim against 0.05 everywhere, and against equal ones with as many nodes.
#[test]
fn a_graded_mesh_has_the_error_of_a_fine_one_with_an_eighth_of_its_nodes() {
    let graded = ring(&sizes(0.4, 0.05, 2.0 * INNER));
    let lengths = graded.mesh().edge_lengths();
    assert!(lengths.longest > 8.0 * lengths.shortest, "{lengths:?}");
    let fine = ring(&SizeField::new(0.05, vec![]).unwrap());
    let nodes = |basis: &MeshBasis<2>| basis.mesh().vertices().len();
    let share = nodes(&graded) as f64 / nodes(&fine) as f64;
    let equal = ring(&SizeField::new(0.05 / share.sqrt(), vec![]).unwrap());
    let [error, least, most] = [&graded, &fine, &equal].map(error_of_gradients);
    println!(
        "{}, {}, {} nodes: errors {error}, {least}, {most}",
        nodes(&graded),
        nodes(&fine),
        nodes(&equal)
    );
    assert!(share < 0.125 && error < 1.25 * least && error < 0.5 * most);
}
