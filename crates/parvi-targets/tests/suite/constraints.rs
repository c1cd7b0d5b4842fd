//! What every transform promises, checked for each of them and for a list of all.

use mpm_tensor::Matrix;
use parvi_targets::{Constraints, ConstraintsBuilder, OutsideSupport, TargetError, Transform};
use proptest::prelude::*;

/// Largest dimension tested.
const MAXIMUM: usize = 8;

/// Central differences of fourth order of `f` on axis `axis`.
fn slope<const D: usize>(f: impl Fn(&[f64; D]) -> f64, y: &[f64; D], axis: usize) -> f64 {
    let step = 2e-3;
    let at = |multiple: f64| {
        let mut moved = *y;
        moved[axis] += multiple * step;
        f(&moved)
    };
    (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * step)
}

fn close(a: f64, b: f64, tolerance: f64, what: &str) -> Result<(), TestCaseError> {
    prop_assert!((a - b).abs() <= tolerance * (1.0 + b.abs()), "{what}: {a} for {b}");
    Ok(())
}

fn conforms<const N: usize, const D: usize>(
    list: impl Fn(ConstraintsBuilder<N, D>) -> ConstraintsBuilder<N, D>,
    numbers: &[f64],
    score: &[f64],
) -> Result<(), TestCaseError> {
    let constraints = list(Constraints::builder()).build().unwrap();
    let y: [f64; D] = std::array::from_fn(|k| numbers[k]);
    let x = constraints.constrain(&y);

    // There and back.
    let back = constraints.unconstrain(&x).unwrap();
    for k in 0..D {
        close(back[k], y[k], 1e-9, "round trip")?;
    }

    // The Jacobian of the independent coordinates.
    let slopes: [[f64; D]; N] =
        std::array::from_fn(|n| std::array::from_fn(|k| slope(|y| constraints.constrain(y)[n], &y, k)));
    let independent = constraints.independent_coordinates();
    prop_assert_eq!(independent.len(), D);
    let jacobian: [[f64; D]; D] = std::array::from_fn(|k| slopes[independent[k]]);
    let log_jacobian = constraints.log_jacobian(&y);
    close(
        log_jacobian,
        Matrix(jacobian).determinant().abs().ln(),
        1e-7,
        "log |det J|",
    )?;

    // Its gradient, and the pull-back of a score.
    let gradient = constraints.pull_back_score(&y, &[0.0; N]);
    let score: [f64; N] = std::array::from_fn(|n| score[n]);
    let pulled = constraints.pull_back_score(&y, &score);
    for k in 0..D {
        let expected = slope(|y| constraints.log_jacobian(y), &y, k);
        close(gradient[k], expected, 1e-9, "gradient of log |det J|")?;
        let moved: f64 = (0..N).map(|n| slopes[n][k] * score[n]).sum();
        close(pulled[k] - gradient[k], moved, 1e-8, "pull-back")?;
    }
    Ok(())
}

/// Whatever y is, x is in the support and the Jacobian a number.
fn holds_far_away<const N: usize, const D: usize>(
    list: impl Fn(ConstraintsBuilder<N, D>) -> ConstraintsBuilder<N, D>,
    numbers: &[f64],
) -> Result<(), TestCaseError> {
    let constraints = list(Constraints::builder()).build().unwrap();
    let y: [f64; D] = std::array::from_fn(|k| numbers[k]);
    let x = constraints.constrain(&y);
    prop_assert!(x.iter().all(|x| x.is_finite()), "{x:?} at {y:?}");
    if !format!("{constraints:?}").contains("Correlation {") {
        prop_assert!(constraints.unconstrain(&x).is_ok(), "{x:?} at {y:?}");
    }
    prop_assert!(constraints.log_jacobian(&y).is_finite(), "{y:?}");
    let score = constraints.pull_back_score(&y, &[0.0; N]);
    prop_assert!(score.iter().all(|s| s.is_finite()), "{score:?} at {y:?}");
    Ok(())
}

macro_rules! for_every_transform {
    ($check:ident, $($argument:expr),+) => {
        $check::<3, 3>(|list| list.free(3), $($argument),+)?;
        $check::<2, 2>(|list| list.positive(2), $($argument),+)?;
        $check::<2, 2>(|list| list.lower_bounded(2, -1.5), $($argument),+)?;
        $check::<2, 2>(|list| list.upper_bounded(2, 0.5), $($argument),+)?;
        $check::<2, 2>(|list| list.bounded(2, -1.0, 3.0), $($argument),+)?;
        $check::<1, 1>(|list| list.ordered(1), $($argument),+)?;
        $check::<4, 4>(|list| list.ordered(4), $($argument),+)?;
        $check::<3, 3>(|list| list.positive_ordered(3), $($argument),+)?;
        $check::<2, 1>(|list| list.simplex(2), $($argument),+)?;
        $check::<6, 5>(|list| list.simplex(6), $($argument),+)?;
        $check::<1, 1>(|list| list.correlation(2), $($argument),+)?;
        $check::<6, 6>(|list| list.correlation(4), $($argument),+)?;
        $check::<3, 1>(|list| list.correlation_cholesky(2), $($argument),+)?;
        $check::<10, 6>(|list| list.correlation_cholesky(4), $($argument),+)?;
        $check::<2, 2>(|list| list.transform(Cubed), $($argument),+)?;
        $check::<11, 8>(
            |list| list.simplex(3).positive(1).ordered(2).correlation_cholesky(2).bounded(1, 0.0, 1.0).free(1),
            $($argument),+
        )?;
    };
}

/// A transform from outside of the library: x = y + y³ on two coordinates.
#[derive(Debug)]
struct Cubed;

impl Transform for Cubed {
    fn name(&self) -> &str {
        "cubed"
    }

    fn constrained_dimension(&self) -> usize {
        2
    }

    fn unconstrained_dimension(&self) -> usize {
        2
    }

    fn constrain(&self, y: &[f64], x: &mut [f64]) {
        for (x, y) in x.iter_mut().zip(y) {
            *x = y + y.powi(3);
        }
    }

    fn log_jacobian(&self, y: &[f64], _x: &[f64]) -> f64 {
        y.iter().map(|y| (3.0 * y * y).ln_1p()).sum()
    }

    fn pull_back(&self, y: &[f64], _x: &[f64], score: &[f64], out: &mut [f64]) {
        for ((out, y), score) in out.iter_mut().zip(y).zip(score) {
            let slope = 1.0 + 3.0 * y * y;
            *out = slope * score + 6.0 * y / slope;
        }
    }

    /// Cardano's formula for y³ + y = x, in hyperbolic functions.
    fn unconstrain(&self, x: &[f64], y: &mut [f64]) -> Result<(), OutsideSupport> {
        for (y, x) in y.iter_mut().zip(x) {
            let third = 3_f64.sqrt().recip();
            *y = 2.0 * third * ((1.5 * x / third).asinh() / 3.0).sinh();
        }
        Ok(())
    }
}

/// ± 10^e.
fn coordinate() -> impl Strategy<Value = f64> {
    (-20.0..30.0_f64, any::<bool>()).prop_map(|(exponent, negative)| {
        let size = 10_f64.powf(exponent);
        if negative { -size } else { size }
    })
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn transforms_conform(
        y in prop::collection::vec(-3.0..3.0_f64, MAXIMUM),
        score in prop::collection::vec(-2.0..2.0_f64, 11),
    ) {
        for_every_transform!(conforms, &y, &score);
    }

    #[test]
    fn transforms_hold_far_away(y in prop::collection::vec(coordinate(), MAXIMUM)) {
        for_every_transform!(holds_far_away, &y);
    }
}

#[test]
fn values_are_the_textbook_ones() {
    let ordered = Constraints::<3, 3>::builder().ordered(3).build().unwrap();
    assert_eq!(ordered.constrain(&[-1.0, 0.0, 0.0]), [-1.0, 0.0, 1.0]);
    let positive = Constraints::<2, 2>::builder().positive_ordered(2).build().unwrap();
    assert_eq!(positive.constrain(&[0.0, 0.0]), [1.0, 2.0]);
    let even = Constraints::<4, 3>::builder().simplex(4).build().unwrap();
    assert_eq!(even.constrain(&[0.0; 3]), [0.25; 4]);
    // Bartlett: the factor of R₂₁ = 0.6, and correlations that multiply along a chain.
    let factor = Constraints::<3, 1>::builder().correlation_cholesky(2).build().unwrap();
    let x = factor.constrain(&[0.6_f64.atanh()]);
    assert!((x[1] - 0.6).abs() < 1e-15 && (x[2] - 0.8).abs() < 1e-15 && x[0] == 1.0);
    let correlations = Constraints::<3, 3>::builder().correlation(3).build().unwrap();
    let x = correlations.constrain(&[0.5_f64.atanh(), 0.5_f64.atanh(), 0.0]);
    assert!((x[2] - 0.25).abs() < 1e-15);
    let bounded = Constraints::<1, 1>::builder().bounded(1, -1.0, 0.0).build().unwrap();
    assert!((bounded.constrain(&[200.0])[0] / -(-200_f64).exp() - 1.0).abs() < 1e-14);
}

#[test]
fn nan_comes_out_as_nan() {
    let constraints = Constraints::<5, 4>::builder()
        .positive(1)
        .bounded(1, 0.0, 1.0)
        .simplex(3)
        .build();
    let x = constraints.unwrap().constrain(&[f64::NAN; 4]);
    assert!(x.iter().all(|x| x.is_nan()), "{x:?}");
}

fn error<const N: usize, const D: usize>(
    list: impl Fn(ConstraintsBuilder<N, D>) -> ConstraintsBuilder<N, D>,
) -> TargetError {
    list(Constraints::builder()).build().unwrap_err()
}

#[test]
fn lists_that_do_not_fit_are_refused() {
    let message = error::<6, 5>(|list| list.free(2).positive(1).simplex(4)).to_string();
    assert_eq!(
        message,
        "the list of constrained coordinates (free 1 to 2, positive 3 to 3, simplex 4 to 7) has length 7, expected 6"
    );
    let message = error::<7, 7>(|list| list.free(2).positive(1).simplex(4)).to_string();
    assert_eq!(
        message,
        "the list of unconstrained coordinates (free 1 to 2, positive 3 to 3, simplex 4 to 6) has length 6, expected 7"
    );
    assert!(matches!(
        error::<2, 2>(|list| list),
        TargetError::Length { found: 0, .. }
    ));
    for list in [
        (|list| list.free(0)) as fn(ConstraintsBuilder<1, 1>) -> ConstraintsBuilder<1, 1>,
        |list| list.simplex(1),
        |list| list.correlation(1),
        |list| list.correlation_cholesky(0),
        |list| list.bounded(1, 1.0, 1.0),
        |list| list.bounded(1, 1.0, 1.0_f64.next_up()),
        |list| list.bounded(1, 2.0, 1.0),
    ] {
        assert!(matches!(error(list), TargetError::OutOfRange { .. }));
    }
    for list in [
        (|list| list.lower_bounded(1, f64::NAN)) as fn(ConstraintsBuilder<1, 1>) -> ConstraintsBuilder<1, 1>,
        |list| list.upper_bounded(1, f64::INFINITY),
        |list| list.bounded(1, f64::NEG_INFINITY, 1.0),
        |list| list.bounded(1, -f64::MAX, f64::MAX),
    ] {
        assert!(matches!(error(list), TargetError::NotFinite { .. }));
    }
    for size in [4, 1 << 40, usize::MAX] {
        assert!(matches!(
            error::<2, 2>(|list| list.correlation(size)),
            TargetError::Length { .. }
        ));
        assert!(matches!(
            error::<2, 2>(|list| list.free(size)),
            TargetError::Length { .. }
        ));
    }
}

#[test]
fn points_outside_of_the_support_are_refused() {
    fn outside<const N: usize, const D: usize>(
        list: impl Fn(ConstraintsBuilder<N, D>) -> ConstraintsBuilder<N, D>,
        x: [f64; N],
        coordinate: usize,
    ) {
        let constraints = list(Constraints::builder()).build().unwrap();
        match constraints.unconstrain(&x).unwrap_err() {
            TargetError::OutOfRange { field, value, .. } => {
                assert!(field.starts_with(&format!("x{} (", coordinate + 1)), "{field}");
                assert!(value == x[coordinate] || value.is_nan());
            }
            other => panic!("{other}"),
        }
    }
    outside::<2, 2>(|list| list.free(1).positive(1), [1.0, 0.0], 1);
    outside::<2, 2>(|list| list.free(1).positive(1), [f64::INFINITY, 1.0], 0);
    outside::<1, 1>(|list| list.positive(1), [f64::NAN], 0);
    outside::<1, 1>(|list| list.lower_bounded(1, 2.0), [1.0], 0);
    outside::<1, 1>(|list| list.upper_bounded(1, 2.0), [3.0], 0);
    outside::<2, 2>(|list| list.bounded(2, 0.0, 1.0), [0.5, 1.0], 1);
    outside::<3, 3>(|list| list.ordered(3), [0.0, 1.0, 1.0], 2);
    outside::<3, 3>(|list| list.positive_ordered(3), [0.0, 1.0, 2.0], 0);
    outside::<3, 2>(|list| list.simplex(3), [0.5, 0.6, -0.1], 2);
    outside::<3, 2>(|list| list.simplex(3), [0.5, 0.2, 0.2], 2);
    outside::<3, 3>(|list| list.correlation(3), [1.0, 0.0, 0.0], 0);
    outside::<3, 3>(|list| list.correlation(3), [0.9, -0.9, 0.9], 2);
    outside::<3, 1>(|list| list.correlation_cholesky(2), [1.0, 0.6, -0.8], 2);
    outside::<3, 1>(|list| list.correlation_cholesky(2), [1.0, 0.6, 0.7], 2);
}
