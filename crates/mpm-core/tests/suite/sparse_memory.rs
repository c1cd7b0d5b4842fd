//! Memory follows the active nodes: k = 10⁴ nodes per axis in D = 6 (k^D = 10²⁴) is a small grid.

use mpm_core::{Basis, Mpm, Particles, Pic, SplineGrid, UniformBasis};
use mpm_kernels::{Linear, Quadratic, Spline};
use mpm_materials::IsothermalGas;

use crate::scenes::{Pull, free, uniform_cloud};

const NODES_PER_AXIS: f64 = 1e4;

fn grid_of<S: Spline<W>, const W: usize, const D: usize>(positions: &[[f64; D]]) -> SplineGrid<S, W, D> {
    let mut grid = SplineGrid::new([0.0; D], 1.0).unwrap();
    grid.rebuild(positions).unwrap();
    grid
}

#[test]
fn a_step_among_ten_to_the_24_nodes() {
    let count = 300;
    let positions = uniform_cloud::<6>(count, NODES_PER_AXIS, 1);
    let grid = SplineGrid::<Quadratic, 3, 6>::new([0.0; 6], 1.0).unwrap();
    let centre = Pull::at_particles(|x: &[f64; 6]| x.map(|c| 0.5 * NODES_PER_AXIS - c));
    let mut mpm = Mpm::new(
        Particles::at_rest(positions, 1.0),
        grid,
        Pic,
        IsothermalGas::CALIBRATED,
        centre,
    );
    let mut control = free(0.1);
    control.displacement = 0.5;
    for _ in 0..3 {
        let report = mpm.step(&control).unwrap();
        assert!(report.active_nodes <= 729 * count && report.active_nodes > 700 * count);
    }
    let per_node = mpm.storage_bytes() as f64 / mpm.basis.node_count() as f64;
    assert!(per_node < 150.0, "{per_node} bytes per active node");
}

#[test]
fn storage_does_not_depend_on_the_extent() {
    fn per_extent<S: Spline<W>, const W: usize, const D: usize>(count: usize) {
        let storage = |edge: f64| {
            let grid = grid_of::<S, W, D>(&uniform_cloud(count, edge, 2));
            (grid.node_count() as f64, grid.storage_bytes() as f64)
        };
        let (nodes, bytes) = storage(NODES_PER_AXIS);
        let (far_nodes, far_bytes) = storage(1000.0 * NODES_PER_AXIS);
        assert!((far_nodes / nodes - 1.0).abs() < 0.02, "{nodes} and {far_nodes} nodes");
        assert!((far_bytes / bytes - 1.0).abs() < 0.05, "{bytes} and {far_bytes} bytes");
    }
    per_extent::<Quadratic, 3, 3>(2000);
    per_extent::<Quadratic, 3, 6>(300);
    per_extent::<Linear, 2, 6>(1000);
}

#[test]
fn a_rebuild_reuses_its_memory() {
    let positions = uniform_cloud::<3>(5000, 40.0, 3);
    let mut grid = grid_of::<Quadratic, 3, 3>(&positions);
    let mut round = || {
        for shift in 0..10 {
            grid.place([0.1 * f64::from(shift); 3], 1.0).unwrap();
            grid.rebuild(&positions).unwrap();
        }
        grid.storage_bytes()
    };
    let bytes = round();
    assert_eq!(round(), bytes);
}
