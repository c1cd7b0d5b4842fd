//! The sparse grid against integer node coordinates in a standard map.

use std::collections::{BTreeSet, HashMap};

use mpm_core::{Basis, NO_NODE, SplineGrid, UniformBasis};
use mpm_kernels::{Cubic, Linear, Quadratic, Spline};
use rand::RngExt;

use crate::scenes::{bits, gaussian_cloud, generator};

/// The first of the W nodes that u touches: the smallest i with u − i < W / 2.
fn first_node(u: f64, width: usize) -> i64 {
    (u - 0.5 * width as f64).floor() as i64 + 1
}

/// All W^D node coordinates of a stencil, the last axis fastest.
fn stencil_nodes<const D: usize>(u: [f64; D], width: usize) -> Vec<[i64; D]> {
    let base = u.map(|u| first_node(u, width));
    let decode = |index: usize| {
        let mut node = base;
        let mut rest = index;
        for a in (0..D).rev() {
            node[a] += (rest % width) as i64;
            rest /= width;
        }
        node
    };
    (0..width.pow(D as u32)).map(decode).collect()
}

fn numbers_agree<S: Spline<W>, const W: usize, const D: usize>(count: usize) {
    let (h, origin) = (0.37, [0.11; D]);
    let mut grid = SplineGrid::<S, W, D>::new(origin, h).unwrap();
    let mut positions = gaussian_cloud::<D>(count, 5);
    for (k, x) in positions.iter_mut().enumerate() {
        if k % 10 == 0 {
            *x = x.map(|c| 1e4 * c); // far away, on both sides of zero
        }
    }
    grid.rebuild(&positions).unwrap();
    let mut node_positions = Vec::new();
    grid.node_positions(&mut node_positions);

    let mut numbers = HashMap::new();
    let mut scratch = Vec::new();
    for cell in 0..grid.schedule().cell_count() {
        let cell_nodes = grid.cell_nodes(cell, &mut scratch);
        for place in grid.schedule().cell(cell) {
            let x = positions[grid.schedule().order()[place] as usize];
            let u = std::array::from_fn(|a| (x[a] - origin[a]) / h);
            let nodes = stencil_nodes::<D>(u, W);
            let mut seen = Vec::new();
            grid.for_each_node(place, &x, |index, _| seen.push(cell_nodes[index]));
            assert_eq!(nodes.len(), seen.len());
            for (node, number) in nodes.into_iter().zip(seen) {
                assert_ne!(number, NO_NODE);
                assert_eq!(
                    *numbers.entry(node).or_insert(number),
                    number,
                    "{}: node {node:?}",
                    S::NAME
                );
                for a in 0..D {
                    let expected = origin[a] + h * node[a] as f64;
                    assert!((node_positions[number as usize][a] - expected).abs() < 1e-9);
                }
            }
        }
    }
    let distinct: BTreeSet<u32> = numbers.values().copied().collect();
    assert_eq!(distinct.len(), numbers.len(), "{}: two nodes with one number", S::NAME);
    assert!(
        distinct.into_iter().eq(0..grid.node_count() as u32),
        "{}: gaps in the numbers",
        S::NAME
    );
}

#[test]
fn node_numbers_agree_with_integer_coordinates() {
    numbers_agree::<Linear, 2, 1>(300);
    numbers_agree::<Quadratic, 3, 1>(300);
    numbers_agree::<Cubic, 4, 1>(300);
    numbers_agree::<Linear, 2, 2>(1000);
    numbers_agree::<Quadratic, 3, 2>(1000);
    numbers_agree::<Cubic, 4, 2>(1000);
    numbers_agree::<Linear, 2, 3>(1000);
    numbers_agree::<Quadratic, 3, 3>(1000);
    numbers_agree::<Cubic, 4, 3>(500);
    numbers_agree::<Quadratic, 3, 4>(200);
    numbers_agree::<Quadratic, 3, 5>(100);
    numbers_agree::<Linear, 2, 6>(200);
    numbers_agree::<Quadratic, 3, 6>(50);
    numbers_agree::<Cubic, 4, 6>(10);
    numbers_agree::<Quadratic, 3, 7>(10);
    numbers_agree::<Quadratic, 3, 8>(3);
}

/// The layout is a function of the set of positions: another order gives the same nodes and the same cells.
fn order_does_not_matter<const D: usize>() {
    let positions = gaussian_cloud::<D>(3000, 11);
    let mut shuffled = positions.clone();
    let mut random = generator(12);
    for k in (1..shuffled.len()).rev() {
        shuffled.swap(k, random.random_range(0..=k));
    }
    let build = |positions: &[[f64; D]]| {
        let mut grid = SplineGrid::<Quadratic, 3, D>::new([0.2; D], 0.3).unwrap();
        grid.rebuild(positions).unwrap();
        let mut nodes = Vec::new();
        grid.node_positions(&mut nodes);
        let schedule = grid.schedule();
        let cells: Vec<BTreeSet<Vec<u64>>> = (0..schedule.cell_count())
            .map(|cell| {
                let particles = schedule.cell(cell).map(|k| schedule.order()[k] as usize);
                particles.map(|p| bits(&[positions[p]])).collect()
            })
            .collect();
        (bits(&nodes), cells, schedule.parts().to_vec())
    };
    assert!(build(&positions) == build(&shuffled), "D = {D}");
}

#[test]
fn the_rebuild_does_not_depend_on_the_order_of_the_particles() {
    mpm_tensor::in_dimensions!(order_does_not_matter(), 1, 2, 3, 6);
}

#[test]
fn a_grid_in_use_is_as_good_as_a_new_one() {
    let mut used = SplineGrid::<Quadratic, 3, 3>::new([0.0; 3], 0.2).unwrap();
    for seed in 0..4 {
        let positions = gaussian_cloud::<3>(500 * (4 - seed), seed as u64);
        let origin = [0.05 * seed as f64; 3];
        used.place(origin, 0.2 + 0.1 * seed as f64).unwrap();
        used.rebuild(&positions).unwrap();
        let mut new = SplineGrid::<Quadratic, 3, 3>::new(origin, 0.2 + 0.1 * seed as f64).unwrap();
        new.rebuild(&positions).unwrap();
        assert_eq!(used.schedule().order(), new.schedule().order());
        assert_eq!(used.node_count(), new.node_count());
        let (mut of_used, mut of_new) = (Vec::new(), Vec::new());
        for cell in 0..new.schedule().cell_count() {
            assert_eq!(used.cell_nodes(cell, &mut of_used), new.cell_nodes(cell, &mut of_new));
        }
    }
}

#[test]
fn no_particles_and_one_particle() {
    let mut grid = SplineGrid::<Quadratic, 3, 2>::new([0.0; 2], 1.0).unwrap();
    grid.rebuild(&[]).unwrap();
    assert_eq!(
        (
            grid.node_count(),
            grid.schedule().cell_count(),
            grid.schedule().parts().len()
        ),
        (0, 0, 0)
    );
    grid.rebuild(&[[0.3, -7.0]]).unwrap();
    assert_eq!(
        (
            grid.node_count(),
            grid.schedule().cell_count(),
            grid.schedule().parts().len()
        ),
        (9, 1, 1)
    );
    grid.rebuild(&[]).unwrap();
    assert_eq!(grid.node_count(), 0);
}
