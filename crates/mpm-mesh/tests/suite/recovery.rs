//! Smooth fields from scattered values.

use mpm_mesh::{CellSearch, SimplexMesh, recovered};
use mpm_tensor::Matrix;
use rand::RngExt;

use crate::basis_scenes::{cloud, cube, generator};

fn linear<const D: usize>(x: &[f64; D]) -> Matrix<D> {
    Matrix::from_fn(|i, j| 0.3 + i as f64 - 0.7 * j as f64 + x[i] * (1.0 + j as f64) - 0.4 * x[j])
}

fn keeps_linear_fields<const D: usize>(mesh: SimplexMesh<D>, size: f64) {
    let search = CellSearch::new(mesh);
    let points = cloud::<D>(40 * search.mesh().cell_count(), 0.0, size, 1);
    let mut random = generator(2);
    let weights: Vec<f64> = points.iter().map(|_| random.random_range(0.5..1.5)).collect();
    let values: Vec<Matrix<D>> = points.iter().map(linear).collect();
    let found = recovered(&search, &points, &weights, &values);
    for (found, value) in found.iter().zip(&values) {
        assert!((*found - *value).maximum_norm() < 1e-11, "{found:?} for {value:?}");
    }
}

#[test]
fn linear_fields_come_back() {
    keeps_linear_fields(cube::<1>(6, 0.3, 0.25, 3), 1.8);
    keeps_linear_fields(cube::<2>(6, 0.3, 0.25, 3), 1.8);
    keeps_linear_fields(cube::<3>(3, 2.0, 0.15, 4), 6.0);
}

/// Independent errors of ± 1 with about eight points per cell: fits of 50 points leave a sixth to a third of them.
#[test]
fn noise_is_averaged() {
    let search = CellSearch::new(cube::<2>(8, 0.25, 0.2, 3));
    let points = cloud::<2>(8 * search.mesh().cell_count(), 0.0, 2.0, 1);
    let mut random = generator(2);
    let mut noise = || if random.random::<bool>() { 1.0 } else { -1.0 };
    let values: Vec<Matrix<2>> = points.iter().map(|_| Matrix::from_fn(|_, _| noise())).collect();
    let found = recovered(&search, &points, &vec![1.0; points.len()], &values);
    let squares = found.iter().map(|value| value.frobenius_norm().powi(2) / 4.0);
    let left = (squares.sum::<f64>() / points.len() as f64).sqrt();
    assert!((0.1..0.33).contains(&left), "{left}");
}

#[test]
fn few_points_have_their_mean_and_those_outside_stay() {
    let search = CellSearch::new(cube::<2>(4, 1.0, 0.0, 3));
    let points = [[0.1, 0.2], [0.3, 0.6], [9.0, 9.0], [f64::NAN, 0.0]];
    let values = [1.0, 3.0, 7.0, 8.0].map(|value| Matrix::IDENTITY * value);
    let found = recovered(&search, &points, &[1.0, 3.0, 1.0, 1.0], &values);
    for (found, expected) in found.iter().zip([2.5, 2.5, 7.0, 8.0]) {
        assert!(
            (*found - Matrix::IDENTITY * expected).maximum_norm() < 1e-14,
            "{found:?}"
        );
    }
    assert!(recovered(&search, &[], &[], &[]).is_empty());
}
