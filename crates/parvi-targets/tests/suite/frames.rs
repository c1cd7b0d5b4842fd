//! Properties of frames, for random centres and covariances.

use mpm_tensor::Matrix;
use parvi_targets::{Frame, Gaussian, Target, TargetError};
use proptest::prelude::*;

/// A A ᵀ plus a little of the identity, scaled per axis by powers of ten.
fn covariance(entries: [[f64; 4]; 4], exponents: [f64; 4]) -> Matrix<4> {
    Matrix::from_fn(|i, j| {
        let product: f64 = (0..4).map(|k| entries[i][k] * entries[j][k]).sum();
        let scale = 10_f64.powf(exponents[i] + exponents[j]);
        scale * (product + if i == j { 0.05 } else { 0.0 })
    })
}

fn entries() -> impl Strategy<Value = [[f64; 4]; 4]> {
    prop::array::uniform4(prop::array::uniform4(-1.0..1.0_f64))
}

fn four(range: std::ops::Range<f64>) -> impl Strategy<Value = [f64; 4]> {
    prop::array::uniform4(range)
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn frames_invert_and_pull_back(
        entries in entries(),
        exponents in four(-3.0..3.0),
        centre in four(-10.0..10.0),
        z in four(-5.0..5.0),
        score in four(-5.0..5.0),
    ) {
        let covariance = covariance(entries, exponents);
        let frame = Frame::new(centre, covariance).unwrap();
        let x = frame.to_target(&z);
        let back = frame.to_reference(&x);
        // Digits of x − μ are lost where the centre is far larger than the scale.
        for k in 0..4 {
            let lost = (0..4).map(|i| centre[i].abs() / frame.factor().0[i][i]).fold(1.0, f64::max);
            prop_assert!((back[k] - z[k]).abs() < 1e-12 * lost);
        }
        let rebuilt = frame.covariance();
        for i in 0..4 {
            for j in 0..4 {
                let unit = (covariance.0[i][i] * covariance.0[j][j]).sqrt();
                prop_assert!((rebuilt.0[i][j] - covariance.0[i][j]).abs() < 1e-13 * unit);
            }
        }
        // z · Lᵀs = (L z) · s.
        let pulled = frame.pull_back_score(&score);
        let left: f64 = pulled.iter().zip(z).map(|(a, b)| a * b).sum();
        let moved: [f64; 4] = std::array::from_fn(|i| (0..4).map(|j| frame.factor().0[i][j] * z[j]).sum());
        let size: f64 = moved.iter().zip(score).map(|(a, b)| (a * b).abs()).sum();
        let right: f64 = moved.iter().zip(score).map(|(a, b)| a * b).sum();
        prop_assert!((left - right).abs() < 1e-12 * (1.0 + size) * 10.0);
        let again = frame.pull_back_score(&frame.push_forward_score(&score));
        for k in 0..4 {
            prop_assert!((again[k] - score[k]).abs() < 1e-10);
        }
        // log det L = ½ log det C, and in the frame the Gaussian is standard: score −z.
        prop_assert!((frame.log_determinant() - 0.5 * covariance.determinant().ln()).abs() < 1e-9);
        let gaussian = Gaussian::new(centre, covariance).unwrap();
        let standard = frame.pull_back_score(&gaussian.score(&x));
        for k in 0..4 {
            prop_assert!((standard[k] + back[k]).abs() < 1e-9 * (1.0 + back[k].abs()));
        }
    }
}

#[test]
fn identity_and_scales() {
    let identity = Frame::<3>::identity();
    assert_eq!(identity.to_target(&[1.0, 2.0, 3.0]), [1.0, 2.0, 3.0]);
    assert_eq!(identity.log_determinant(), 0.0);
    let frame = Frame::from_scales([1.0, -1.0], [2.0, 0.5]).unwrap();
    assert_eq!(frame.to_target(&[1.0, 2.0]), [3.0, 0.0]);
    assert_eq!(frame.to_reference(&[3.0, 0.0]), [1.0, 2.0]);
    assert_eq!(frame.pull_back_score(&[1.0, 2.0]), [2.0, 1.0]);
    assert_eq!(frame.covariance(), Matrix([[4.0, 0.0], [0.0, 0.25]]));
    assert_eq!(*frame.centre(), [1.0, -1.0]);
}

/// As in the headers of files, x1 is the first axis.
#[test]
fn messages_count_axes_from_one() {
    let scales = Frame::from_scales([0.0; 2], [1.0, -1.0]).unwrap_err().to_string();
    assert!(scales.contains("of x2"), "{scales}");
    let centre = Frame::from_scales([f64::NAN, 0.0], [1.0; 2]).unwrap_err().to_string();
    assert!(centre.contains("x1 of the centre"), "{centre}");
    let covariance = |a, b, c, d| Frame::new([0.0; 2], Matrix([[a, b], [c, d]])).unwrap_err().to_string();
    assert!(covariance(1.0, 2.0, 2.0, 1.0).ends_with("of x2)"));
    assert!(covariance(1.0, 0.5, 0.0, 1.0).contains("x1 and x2"));
}

#[test]
fn the_frame_of_points_has_their_units() {
    let points = [[0.0, 1.0], [2.0, 0.5], [-1.0, 3.0]];
    let frame = Frame::of_points(&points, None).unwrap();
    let units = [2f64.powi(-700), 2f64.powi(700)];
    let in_units = |x: &[f64; 2]| [x[0] * units[0], x[1] * units[1]];
    let scaled = Frame::of_points(&points.map(|x| in_units(&x)), None).unwrap();
    assert_eq!(*scaled.centre(), in_units(frame.centre()));
    for axis in 0..2 {
        assert_eq!(scaled.factor().0[axis], frame.factor().0[axis].map(|c| c * units[axis]));
    }
}

#[test]
fn bad_frames_are_refused() {
    let covariance = |a, b, c, d| Frame::new([0.0; 2], Matrix([[a, b], [c, d]])).unwrap_err();
    assert!(matches!(
        covariance(1.0, 2.0, 2.0, 1.0),
        TargetError::NotPositiveDefinite { axis: 1, .. }
    ));
    assert!(matches!(
        covariance(1.0, 1.0, 1.0, 1.0),
        TargetError::NotPositiveDefinite { axis: 1, .. }
    ));
    assert!(matches!(
        covariance(-1.0, 0.0, 0.0, 1.0),
        TargetError::NotPositiveDefinite { axis: 0, .. }
    ));
    assert!(matches!(
        covariance(1.0, 0.1, 0.2, 1.0),
        TargetError::NotSymmetric { row: 1, column: 0, .. }
    ));
    assert!(matches!(
        covariance(1.0, f64::NAN, 0.0, 1.0),
        TargetError::NotFinite { .. }
    ));
    assert!(matches!(
        Frame::from_scales([0.0; 2], [1.0, 0.0]),
        Err(TargetError::OutOfRange { .. })
    ));
    assert!(matches!(
        Frame::from_scales([f64::INFINITY], [1.0]),
        Err(TargetError::NotFinite { .. })
    ));
    for weights in [&[0.5][..], &[0.25; 4]] {
        assert!(matches!(
            Frame::of_points(&[[0.0], [1.0], [2.0]], Some(weights)),
            Err(TargetError::Length { expected: 3, .. })
        ));
    }
    for weights in [[1.0, 2.0, 1.0], [0.25, 0.5, 0.26]] {
        assert!(matches!(
            Frame::of_points(&[[0.0], [1.0], [2.0]], Some(&weights)),
            Err(TargetError::OutOfRange { value, .. }) if value == weights.iter().sum()
        ));
    }
    assert!(matches!(
        Frame::of_points(&[[0.0], [1.0], [2.0]], Some(&[0.5, f64::NAN, 0.5])),
        Err(TargetError::OutOfRange { .. })
    ));
    let weighted = Frame::of_points(&[[0.0], [1.0], [2.0]], Some(&[0.25, 0.5, 0.25])).unwrap();
    assert_eq!(*weighted.centre(), [1.0]);
    assert!((weighted.factor().0[0][0] - 0.5f64.sqrt()).abs() < 1e-15);
    // Scales from 1e-150 to 1e150 are no obstacle.
    assert!(Frame::new([0.0; 2], Matrix([[1e-300, 0.0], [0.0, 1e300]])).is_ok());
}
