//! No input panics or hangs: every bit pattern of `f64` as an entry.

use mpm_tensor::{Cholesky, Matrix, Polar, SingularValues, SymmetricEigen};
use proptest::prelude::*;

/// Zero, subnormal, huge, infinite and NaN entries among ordinary ones.
fn entry() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => -2.0..2.0,
        1 => any::<u64>().prop_map(f64::from_bits),
        1 => prop::sample::select(vec![0.0, -0.0, 5e-324, -1e-310, 1e-300, 1e300, f64::MAX, f64::MIN]),
    ]
}

fn survives<const D: usize>(numbers: &[f64], spoil: Option<f64>) -> Result<(), TestCaseError> {
    let mut a = Matrix::<D>::from_fn(|i, j| numbers[D * i + j]);
    if let Some(spoil) = spoil {
        a.0[numbers[0].to_bits() as usize % D][numbers[1].to_bits() as usize % D] = spoil;
    }
    let finite = a.is_finite();
    let has_nan = a.maximum_norm().is_nan();
    if has_nan {
        prop_assert!(a.determinant().is_nan());
    }
    let inverse = a.inverse();
    prop_assert!(inverse.is_none_or(|inverse| finite && inverse.is_finite()));
    prop_assert!(a.lower_triangular_inverse().is_none_or(|inverse| inverse.is_finite()));
    let svd = SingularValues::new(&a);
    prop_assert_eq!(svd.is_some(), finite);
    if let Some(svd) = svd {
        prop_assert!(crate::common::orthogonality_error(&svd.left) < 1e-14);
        prop_assert!(crate::common::orthogonality_error(&svd.right) < 1e-14);
    }
    let polar = Polar::new(&a);
    prop_assert_eq!(polar.is_some(), finite);
    prop_assert!(polar.is_none_or(|polar| crate::common::orthogonality_error(&polar.rotation) < 1e-14));
    let eigen = SymmetricEigen::new(&a);
    prop_assert_eq!(eigen.is_some(), finite);
    prop_assert!(eigen.is_none_or(|eigen| crate::common::orthogonality_error(&eigen.vectors) < 1e-14));
    if let Ok(factor) = Cholesky::new(&a) {
        prop_assert!((0..D).all(|i| factor.lower().0[i][i] > 0.0));
        prop_assert!(factor.log_determinant().is_finite());
    }
    Ok(())
}

proptest! {
    #[test]
    fn any_entries(numbers in prop::collection::vec(entry(), 64)) {
        mpm_tensor::in_dimensions!(survives(&numbers, None)?, 1, 2, 3, 4, 5, 6, 7, 8);
    }

    #[test]
    fn one_spoiled_entry(
        numbers in prop::collection::vec(-1.0..1.0, 64),
        spoil in prop::sample::select(vec![f64::NAN, f64::INFINITY, f64::NEG_INFINITY]),
    ) {
        mpm_tensor::in_dimensions!(survives(&numbers, Some(spoil))?, 1, 2, 3, 4, 5, 6, 7, 8);
    }
}

#[test]
fn dimension_zero_is_harmless() {
    let empty = Matrix::<0>::IDENTITY;
    assert_eq!(empty.inverse(), Some(empty));
    assert!(Cholesky::new(&empty).is_ok() && SingularValues::new(&empty).is_some());
    assert!(Polar::new(&empty).is_some() && SymmetricEigen::new(&empty).is_some());
}
