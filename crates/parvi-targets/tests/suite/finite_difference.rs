//! Scores by central differences against exact ones.

use parvi_targets::{Banana, Constraints, FiniteDifferenceScore, Gaussian, StudentT, Target, TargetError};
use proptest::prelude::*;

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    /// Units from 10⁻⁶ to 10⁶, and coordinates up to 10⁶ units from zero.
    #[test]
    fn scores_are_right_in_every_unit(
        z in prop::array::uniform3(-4.0..4.0_f64),
        exponent in -6.0..6.0_f64,
        shift in -6.0..6.0_f64,
    ) {
        let unit = 10_f64.powf(exponent);
        let centre = unit * 10_f64.powf(shift);
        let log_density = move |x: &[f64; 3]| -> f64 {
            x.iter().map(|x| -(0.25 * ((x - centre) / unit).powi(4)) - (x - centre) / unit).sum()
        };
        let target = FiniteDifferenceScore::with_scales(log_density, [unit; 3]).unwrap();
        let x = z.map(|z| centre + unit * z);
        let (score, error) = (target.score(&x), target.error(&x));
        let size = 1.0 + log_density(&x).abs();
        for k in 0..3 {
            // What z is after rounding of x.
            let z = (x[k] - centre) / unit;
            let exact = -(z * z * z + 1.0) / unit;
            let difference = (score[k] - exact).abs();
            // h² z is the truncation; from 10³ units away the step is up to 10² times as long.
            let far = (1.0 + 10_f64.powf(shift)).cbrt();
            prop_assert!(difference * unit < 4e-10 * far * far * size, "{} for {}", score[k], exact);
            prop_assert!(error[k] * unit < 4e-9 * far * far * size);
        }
    }
}

#[test]
fn known_targets_get_their_scores() {
    let gaussian = Gaussian::<4>::standard();
    let banana = Banana::default();
    let student = StudentT::<3>::new(5.0).unwrap();
    fn check<const D: usize>(target: &(impl Target<D> + ?Sized), x: [f64; D]) {
        let differences = FiniteDifferenceScore::new(|x: &[f64; D]| target.log_density(x));
        assert_eq!(differences.log_density(&x), target.log_density(&x));
        let (mut scores, mut densities) = ([[0.0; D]; 2], [0.0; 2]);
        differences.scores(&[x, x], &mut scores);
        differences.log_densities(&[x, x], &mut densities);
        assert_eq!(scores[1], differences.score(&x));
        assert_eq!(densities[1], target.log_density(&x));
        let (exact, error) = (target.score(&x), differences.error(&x));
        for k in 0..D {
            let difference = (scores[0][k] - exact[k]).abs();
            assert!(difference < 1e-8 * (1.0 + exact[k].abs()));
            // The estimate is of the right size: neither too good nor useless.
            assert!(difference < 4.0 * error[k] && error[k] < 1e-7 * (1.0 + exact[k].abs()));
        }
    }
    check(&gaussian, [0.3, -1.0, 2.0, 5.0]);
    check(&banana, [0.7, 1.5]);
    check(&student, [3.0, 0.1, -0.4]);
}

/// A million scales away there are digits left; where rounding hides every change of the density, the score is finite.
#[test]
fn far_away_scores_stay_finite() {
    let cauchy = |x: &[f64; 1]| -(x[0] * x[0]).ln_1p();
    let target = FiniteDifferenceScore::new(cauchy);
    for x in [1e6, -1e6, 1e8] {
        let score = target.score(&[x])[0];
        assert!((score * x + 2.0).abs() < 0.01, "{score} at {x}");
    }
    for x in [1e30, -1e100, 1e150] {
        assert!(target.score(&[x])[0].is_finite() && target.error(&[x])[0].is_finite());
    }
}

#[test]
fn constraints_and_differences_compose() {
    let constraints = Constraints::<2, 2>::builder().free(1).positive(1).build().unwrap();
    // A gamma density of shape 2 and rate 1 in x₂: in y = log x₂ the score is 2 − e^y.
    let log_density = |x: &[f64; 2]| -0.5 * x[0] * x[0] + x[1].ln() - x[1];
    let target = FiniteDifferenceScore::new(constraints.log_density(log_density));
    let score = target.score(&[0.5, 1.0]);
    assert!((score[0] + 0.5).abs() < 1e-9);
    assert!((score[1] - (2.0 - 1_f64.exp())).abs() < 1e-9);
}

#[test]
fn bad_scales_are_refused() {
    let flat = |_: &[f64; 2]| 0.0;
    let with = |scale| FiniteDifferenceScore::with_scales(flat, [1.0, scale]).err().unwrap();
    assert!(matches!(with(0.0), TargetError::OutOfRange { .. }));
    assert!(matches!(with(f64::NAN), TargetError::NotFinite { .. }));
}

#[test]
fn a_slow_density_is_asked_for_few_points_in_a_call() {
    let quick = FiniteDifferenceScore::new(|x: &[f64; 1]| -0.5 * x[0] * x[0]);
    assert_eq!(quick.points_per_call(), Gaussian::<1>::standard().points_per_call());
    let slow = quick.with_points_per_call(1);
    assert_eq!(slow.points_per_call(), 1);
    let constraints = Constraints::<1, 1>::builder().positive(1).build().unwrap();
    assert_eq!(constraints.target(slow).points_per_call(), 1);
}
