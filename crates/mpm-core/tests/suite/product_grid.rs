//! Splines of run-time degree against those that are compiled for their width.

use std::collections::HashMap;

use mpm_core::conformance::AnyBasis;
use mpm_core::{MpmError, ProductGrid, SplineDegree, SplineGrid};
use mpm_kernels::{Cubic, Entry, Linear, Quadratic, Spline};

use crate::scenes::gaussian_cloud;

/// Every particle's nodes: weight, gradient, offset and affine direction by position, in units of a ten-thousandth of the spacing.
fn entries<const D: usize>(basis: &mut dyn AnyBasis<D>, cloud: &[[f64; D]]) -> Vec<HashMap<[i64; D], [f64; 10]>> {
    let sorted = basis.rebuild(cloud).unwrap();
    let (mut nodes, mut scratch) = (Vec::new(), Vec::new());
    basis.node_positions(&mut nodes);
    let mut found = vec![HashMap::new(); cloud.len()];
    for cell in 0..basis.schedule().cell_count() {
        let numbers = basis.cell_nodes(cell, &mut scratch).to_vec();
        for particle in basis.schedule().cell(cell) {
            let of = &mut found[basis.schedule().order()[particle] as usize];
            basis.for_each_node(particle, &sorted[particle], &mut |index, entry: &Entry<D>| {
                let place = nodes[numbers[index] as usize].map(|c| (1e4 * c).round() as i64);
                let direction = basis.affine_direction(particle, &sorted[particle], entry);
                let mut numbers = [0.0; 10];
                numbers[0] = entry.weight;
                for (to, from) in numbers[1..]
                    .iter_mut()
                    .zip(entry.gradient.iter().chain(&entry.offset).chain(&direction))
                {
                    *to = *from;
                }
                of.insert(place, numbers);
            });
        }
    }
    found
}

fn agrees<S: Spline<W>, const W: usize, const D: usize>(degree: SplineDegree) {
    let (origin, h) = ([0.3; D], 0.7);
    let cloud = gaussian_cloud::<D>(60, 5);
    // Of the second a box around all nodes would be large.
    let with_one_afar = [&cloud[..], &[[2e4; D]]].concat();
    for cloud in [cloud, with_one_afar] {
        agrees_on::<S, W, D>(degree, (origin, h), &cloud);
    }
}

fn agrees_on<S: Spline<W>, const W: usize, const D: usize>(
    degree: SplineDegree,
    (origin, h): ([f64; D], f64),
    cloud: &[[f64; D]],
) {
    let compiled = entries(&mut SplineGrid::<S, W, D>::new(origin, h).unwrap(), cloud);
    let looped = entries(&mut ProductGrid::<D>::new(degree, origin, h).unwrap(), cloud);
    for (a, b) in compiled.iter().zip(&looped) {
        assert_eq!(a.len(), W.pow(D as u32));
        for (place, numbers) in a {
            let other = b.get(place).expect("the same nodes");
            let apart = numbers.iter().zip(other).map(|(a, b)| (a - b).abs());
            assert!(apart.fold(0.0, f64::max) < 1e-13, "{degree:?}, D = {D}");
        }
    }
}

#[test]
fn a_loop_gives_the_stencils_of_compiled_splines() {
    agrees::<Linear, 2, 1>(SplineDegree::Linear);
    agrees::<Linear, 2, 3>(SplineDegree::Linear);
    agrees::<Quadratic, 3, 2>(SplineDegree::Quadratic);
    agrees::<Quadratic, 3, 3>(SplineDegree::Quadratic);
    agrees::<Cubic, 4, 2>(SplineDegree::Cubic);
    agrees::<Cubic, 4, 3>(SplineDegree::Cubic);
}

#[test]
fn what_a_grid_refuses_a_loop_refuses() {
    let mut grid = ProductGrid::<2>::new(SplineDegree::Cubic, [0.0; 2], 0.1).unwrap();
    for bad in [f64::NAN, f64::INFINITY, 1e300] {
        let error = grid.rebuild(&[[0.0, 0.0], [bad, 0.0]]).unwrap_err();
        assert!(
            matches!(error, MpmError::PositionOutOfRange { particle: 1, .. }),
            "{error}"
        );
    }
    assert!(grid.rebuild(&[]).unwrap().is_empty());
    assert!(ProductGrid::<2>::new(SplineDegree::Linear, [0.0; 2], 0.0).is_err());
}
