//! Linear least squares over points.

use mpm_rom::least_squares::{LeastSquares, LeastSquaresError};
use proptest::prelude::*;

/// Jᵀ (J w − y), which vanishes at the minimum.
fn gradient(jacobians: &[[f64; 3]], targets: &[[f64; 3]], w: &[f64]) -> Vec<f64> {
    let mut sum = vec![0.0; w.len()];
    for (row, y) in jacobians.chunks(w.len()).zip(targets) {
        for a in 0..3 {
            let residual: f64 = row.iter().zip(w).map(|(column, w)| column[a] * w).sum::<f64>() - y[a];
            row.iter()
                .zip(&mut sum)
                .for_each(|(column, sum)| *sum += column[a] * residual);
        }
    }
    sum
}

proptest! {
    #[test]
    fn the_normal_equations_hold(values in prop::collection::vec(-1.0..1.0f64, 5 * 3 * 7 * 2)) {
        let vectors: Vec<[f64; 3]> = values.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect();
        let (jacobians, targets) = (&vectors[..35], &vectors[35..42]);
        let (mut solver, mut w) = (LeastSquares::default(), vec![0.0; 5]);
        solver.solve(jacobians, targets, &mut w).expect("of full rank");
        let scale = w.iter().fold(1.0, |m: f64, w| m.max(w.abs()));
        prop_assert!(gradient(jacobians, targets, &w).iter().all(|g| g.abs() < 1e-11 * scale));
    }
}

#[test]
fn a_point_of_weight_three_is_three_points() {
    let (jacobians, targets) = (
        [[1.0, 0.2], [0.3, -1.0], [2.0, 0.5], [0.1, 0.4], [-1.0, 0.7], [0.6, 0.9]],
        [[1.0, -0.5], [0.2, 0.8], [-0.3, 0.4]],
    );
    let (mut found, mut expected) = ([0.0; 2], [0.0; 2]);
    let weighted = LeastSquares::weighted(&[1.0, 3.0, 0.0]).solve(&jacobians, &targets, &mut found);
    weighted.expect("of full rank");
    let [a, b, c, d, ..] = jacobians;
    let [first, second, _] = targets;
    LeastSquares::default()
        .solve(
            &[a, b, c, d, c, d, c, d],
            &[first, second, second, second],
            &mut expected,
        )
        .expect("of full rank");
    assert!(
        found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-14),
        "{found:?} {expected:?}"
    );
}

#[test]
fn what_cannot_be_solved_is_said() {
    let (mut solver, mut w) = (LeastSquares::default(), [0.0; 2]);
    let error = solver
        .solve(&[[1.0], [2.0]], &[[1.0]], &mut w)
        .expect_err("one equation");
    assert_eq!(
        error,
        LeastSquaresError::TooFewEquations {
            equations: 1,
            unknowns: 2
        }
    );
    let jacobians = [[1.0, 2.0], [2.0, 4.0], [0.5, 1.0], [1.0, 2.0]];
    let error = solver
        .solve(&jacobians, &[[1.0, 1.0]; 2], &mut w)
        .expect_err("parallel");
    assert!(
        matches!(error, LeastSquaresError::RankDeficient { coordinate: 1, .. }),
        "{error}"
    );
    let error = solver.solve(&[[f64::NAN]], &[[1.0]], &mut w[..1]).expect_err("NaN");
    assert_eq!(error, LeastSquaresError::NotFinite);
    let error = LeastSquares::weighted(&[1.0; 3])
        .solve(&[[1.0]], &[[1.0]], &mut w[..1])
        .expect_err("one point");
    assert_eq!(error, LeastSquaresError::Weights { found: 1, expected: 3 });
}
