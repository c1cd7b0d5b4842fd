//! Determinant, inverse, Cholesky and the algebra of products, against mpm-dense and against their definitions, D = 1…8.

use crate::common::{Sample, condition, regular_sample, relative_error, sample, to_dense};
use mpm_tensor::{Cholesky, Matrix, vector};
use proptest::prelude::*;

const TOLERANCE: f64 = 1e-14;

fn determinant_agrees<const D: usize>(sample: &Sample) -> Result<(), TestCaseError> {
    let a = Sample {
        exponent: 0,
        ..sample.clone()
    }
    .general::<D>();
    let bound: f64 = a.0.iter().map(vector::norm).product();
    let oracle = to_dense(&a).determinant();
    // The oracle returns NaN for some exactly singular matrices.
    let oracle = if oracle.is_nan() { 0.0 } else { oracle };
    prop_assert!((a.determinant() - oracle).abs() <= TOLERANCE * bound);
    prop_assert!((a.determinant() - a.transpose().determinant()).abs() <= TOLERANCE * bound.max(1.0));
    Ok(())
}

fn inverse_agrees<const D: usize>(sample: &Sample) -> Result<(), TestCaseError> {
    let a = sample.general::<D>();
    let condition = condition(&a);
    let inverse = a.inverse().expect("regular");
    let oracle = to_dense(&a).inverse();
    let oracle = Matrix::<D>::from_fn(|i, j| oracle[(i, j)]);
    prop_assert!(relative_error(&inverse, &oracle) <= TOLERANCE * condition);
    prop_assert!((a * inverse - Matrix::IDENTITY).frobenius_norm() <= TOLERANCE * condition);
    Ok(())
}

fn cholesky_factorises<const D: usize>(sample: &Sample) -> Result<(), TestCaseError> {
    let root = sample.general::<D>();
    let a = (root * root.transpose()).symmetric_part() + 1e-3 * Matrix::IDENTITY;
    let condition = condition(&a);
    let factor = Cholesky::new(&a).expect("positive definite");
    let lower = *factor.lower();
    prop_assert!(relative_error(&(lower * lower.transpose()), &a) < TOLERANCE);
    let b = sample.vector::<D>();
    let x = factor.solve(&b);
    let residual = vector::distance(&(a * x), &b);
    prop_assert!(residual <= TOLERANCE * a.frobenius_norm() * vector::norm(&x));
    let determinant: f64 = (0..D).map(|i| lower.0[i][i] * lower.0[i][i]).product();
    prop_assert!((factor.log_determinant() - determinant.ln()).abs() < 1e-12);
    let lower_inverse = lower.lower_triangular_inverse().expect("regular");
    prop_assert!((lower_inverse * lower - Matrix::IDENTITY).frobenius_norm() <= TOLERANCE * condition);
    prop_assert!(vector::distance(&(lower_inverse * b), &factor.solve_lower(&b)) <= TOLERANCE * condition);
    let inverse = factor.inverse().expect("regular");
    prop_assert_eq!(inverse, inverse.transpose());
    prop_assert!((a * inverse - Matrix::IDENTITY).frobenius_norm() <= TOLERANCE * condition);
    Ok(())
}

/// The first row that spoils positive definiteness is the pivot named.
fn cholesky_rejects<const D: usize>(sample: &Sample) -> Result<(), TestCaseError> {
    let root = sample.general::<D>();
    let mut a = (root * root.transpose()).symmetric_part() + Matrix::IDENTITY;
    let bad = sample.numbers[0].to_bits() as usize % D;
    a.0[bad][bad] = -1.0;
    let error = Cholesky::new(&a).expect_err("a negative diagonal entry");
    prop_assert_eq!(error.index, bad);
    prop_assert!(error.pivot <= -1.0);
    Ok(())
}

fn products_are_consistent<const D: usize>(sample: &Sample) -> Result<(), TestCaseError> {
    let sample = Sample {
        exponent: sample.exponent / 3,
        ..sample.clone()
    };
    let (a, b) = (sample.general::<D>(), sample.symmetric::<D>());
    let x = sample.vector::<D>();
    let (y, z) = ((a * b) * x, a * (b * x));
    prop_assert!(vector::distance(&y, &z) <= TOLERANCE * a.frobenius_norm() * b.frobenius_norm() * 8.0);
    prop_assert_eq!((a * b).transpose(), b.transpose() * a.transpose());
    prop_assert_eq!(a.apply_transposed(&x), a.transpose().apply(&x));
    let scale = a.frobenius_norm() * b.frobenius_norm();
    prop_assert!((a.contract(&b) - (a.transpose() * b).trace()).abs() <= TOLERANCE * scale);
    prop_assert!((Matrix::outer(&x, &x).trace() - vector::norm_squared(&x)).abs() <= TOLERANCE);
    Ok(())
}

properties! {
    determinant: determinant_agrees of sample;
    inverse: inverse_agrees of regular_sample;
    cholesky: cholesky_factorises of regular_sample;
    cholesky_of_indefinite_matrices: cholesky_rejects of regular_sample;
    products: products_are_consistent of sample;
}
