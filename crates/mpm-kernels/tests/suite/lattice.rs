//! What every simplex lattice must do.

use mpm_kernels::{SimplexGeometry, SimplexPoint};
use mpm_tensor::{Matrix, vector};
use proptest::prelude::*;

/// The shape function of the node at 0 in lattice coordinates t: (1 + min(0, t) − max(0, t))₊ (docs/theory.md, Eq. 20).
fn hat<const D: usize>(t: &[f64; D]) -> f64 {
    let low = t.iter().fold(0.0, |low: f64, &c| low.min(c));
    let high = t.iter().fold(0.0, |high: f64, &c| high.max(c));
    (1.0 + low - high).max(0.0)
}

fn conforms<const D: usize>(geometry: &SimplexGeometry<D>, x: [f64; D], aligned: bool) {
    let h = geometry.spacing();
    let (bases, points) = geometry.simplices(&[x; 4]);
    assert!(points.iter().all(|point: &SimplexPoint<D>| *point == points[0]));
    let point = points[0];
    let u = geometry.coordinates(&[x; 4]).map(|c| c.to_array()[0]);
    let mut node = bases.map(|c| c.to_array()[0]);
    let mut nodes = vec![node];
    for k in 0..D {
        node[point.axis(k)] += 1.0;
        nodes.push(node);
    }
    let (mut sum, mut mean, mut slope, mut seen) = (0.0, [0.0; D], [0.0; D], 0);
    geometry.for_each(&point, |k, entry| {
        assert_eq!(k, seen);
        seen += 1;
        let t: [f64; D] = std::array::from_fn(|a| u[a] - nodes[k][a]);
        assert!(entry.weight >= 0.0);
        assert!(
            (entry.weight - hat(&t)).abs() < 1e-13,
            "{x:?}: {} for {}",
            entry.weight,
            hat(&t)
        );
        let expected = vector::subtract(&geometry.node_position(&nodes[k]), &x);
        let offset_error = vector::distance(&entry.offset, &expected);
        assert!(offset_error < 1e-12 * (h + vector::norm(&x)), "{offset_error}");
        sum += entry.weight;
        vector::accumulate(&mut mean, entry.weight, &entry.offset);
        vector::accumulate(&mut slope, 1.0, &entry.gradient);
    });
    assert_eq!(seen, D + 1);
    assert_eq!(sum, 1.0, "weights sum to one exactly");
    assert!(vector::norm(&mean) < 1e-13 * (h + vector::norm(&x)), "{mean:?}");
    assert!(vector::norm(&slope) < 1e-12 / h, "{slope:?}");
    if aligned {
        let at_node = |k: usize| (0..D).all(|a| (u[a] - nodes[k][a]).abs() < 1e-14);
        assert!((0..=D).any(at_node));
    }
}

fn in_dimension<const D: usize>(z: &[f64; 8], h: f64) {
    let x: [f64; D] = std::array::from_fn(|a| z[a]);
    let origin = std::array::from_fn(|a| 0.1 * a as f64 - 0.2);
    conforms(&SimplexGeometry::permutohedral(origin, h), x, false);
    conforms(&SimplexGeometry::kuhn(origin, h), x, false);
    let frame = Matrix::from_fn(|i, j| f64::from(u8::from(i == j)) + 0.1 * (i as f64 - 2.0 * j as f64).sin());
    let general = SimplexGeometry::new(frame, origin, h).expect("a regular frame");
    conforms(&general, x, false);
    let back = SimplexGeometry::kuhn(origin, h).turned(&Matrix::IDENTITY);
    assert_eq!(back, SimplexGeometry::kuhn(origin, h));
    for exact in [x.map(f64::round), x.map(|c| 0.5 * c.round()), [-1e-17; D]] {
        conforms(&SimplexGeometry::kuhn([0.0; D], 1.0), exact, false);
    }
    conforms(&SimplexGeometry::kuhn([0.0; D], 1.0), x.map(f64::round), true);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn lattices(z in prop::array::uniform8(-20.0..20.0f64), h in 0.05..3.0f64) {
        mpm_tensor::in_dimensions!(in_dimension(&z, h), 1, 2, 3, 4, 5, 6, 7, 8);
    }
}

#[test]
fn a_singular_frame_gives_no_lattice() {
    assert!(SimplexGeometry::new(Matrix([[1.0, 2.0], [2.0, 4.0]]), [0.0; 2], 1.0).is_none());
    assert!(SimplexGeometry::new(Matrix([[f64::NAN, 0.0], [0.0, 1.0]]), [0.0; 2], 1.0).is_none());
}

#[test]
fn a_place_that_is_none_gives_no_lattice() {
    for (origin, spacing) in [
        ([f64::NAN, 0.0], 1.0),
        ([0.0, f64::INFINITY], 1.0),
        ([0.0; 2], 0.0),
        ([0.0; 2], -1.0),
        ([0.0; 2], f64::NAN),
        ([0.0; 2], f64::INFINITY),
    ] {
        let lattice = SimplexGeometry::new(Matrix::IDENTITY, origin, spacing);
        assert!(lattice.is_none(), "{origin:?}, {spacing}");
    }
}

#[test]
fn cells_of_the_permutohedral_lattice_have_the_volume_of_cubes() {
    fn volume<const D: usize>() -> f64 {
        let lattice = SimplexGeometry::<D>::permutohedral([0.0; D], 0.5);
        Matrix::<D>::from_fn(|i, j| {
            let mut node = [0.0; D];
            node[j] = 1.0;
            lattice.node_position(&node)[i]
        })
        .determinant()
    }
    assert!((volume::<1>() - 0.5).abs() < 1e-14);
    assert!((volume::<3>() - 0.125).abs() < 1e-14);
    assert!((volume::<6>() - 0.5f64.powi(6)).abs() < 1e-15);
}
