//! Derivatives against finite differences, the inverse, and the maps of Gaussians.

use proptest::prelude::*;

use super::*;

/// Parameters that make everything bend, some log scales beyond the linear range when `wild`.
fn bent<const D: usize>(wild: bool) -> TriangularMap<D> {
    let covariance: Matrix<D> = Matrix::from_fn(|i, j| if i == j { 1.0 + i as f64 } else { 0.3 });
    let order = std::array::from_fn(|i| (i + 1) % D);
    let map = TriangularMap::gaussian(&[0.7; D], &covariance, order).unwrap();
    let size = if wild { 2.0 } else { 0.3 };
    let step: Vec<f64> = (0..map.parameters().len())
        .map(|k| size * (1.7 * k as f64).sin())
        .collect();
    map.moved(1.0, &step)
}

/// log p(x) = −½ Σ x² + sin x₁ and its score.
fn log_density<const D: usize>(x: &[f64; D]) -> f64 {
    -0.5 * vector::norm_squared(x) + x[0].sin()
}

fn score<const D: usize>(x: &[f64; D]) -> [f64; D] {
    let mut score = x.map(|c| -c);
    score[0] += x[0].cos();
    score
}

fn pulled_back<const D: usize>(map: &TriangularMap<D>, z: &[f64; D]) -> f64 {
    let image = map.image(z);
    log_density(&image.x) + map.log_determinant(&image)
}

fn close(found: f64, wanted: f64) -> bool {
    (found - wanted).abs() <= 1e-6 * (1.0 + wanted.abs())
}

#[test]
fn the_score_is_the_gradient_of_the_log_density() {
    let z = [0.4, -0.9, 1.1, 0.2];
    let map = bent::<4>(false);
    let image = map.image(&z);
    let pulled = map.pull_back_score(&z, &image, &score(&image.x));
    for axis in 0..4 {
        let moved = |step: f64| {
            let mut z = z;
            z[axis] += step;
            pulled_back(&map, &z)
        };
        let difference = (moved(1e-5) - moved(-1e-5)) / 2e-5;
        assert!(close(pulled[axis], difference), "{axis}: {pulled:?} {difference}");
    }
}

#[test]
fn sensitivities_give_the_gradient_by_the_parameters() {
    let z = [0.4, -0.9, 0.6];
    let map = bent::<3>(false);
    let image = map.image(&z);
    let pulled = map.pull_back_score(&z, &image, &score(&image.x));
    let mut gradient = Vec::new();
    for i in 0..3 {
        let (precision, slope, before) = map.sensitivity(i, &image);
        gradient.extend(features(before, true).map(|f| pulled[i] * precision * f));
        gradient.extend(features(before, false).map(|f| (pulled[i] * z[i] + 1.0) * slope * f));
    }
    assert_eq!(gradient.len(), map.parameters().len());
    for (k, &found) in gradient.iter().enumerate() {
        let mut step = vec![0.0; gradient.len()];
        step[k] = 1e-5;
        let difference = (pulled_back(&map.moved(1.0, &step), &z) - pulled_back(&map.moved(-1.0, &step), &z)) / 2e-5;
        assert!(close(found, difference), "{k}: {found} {difference}");
    }
}

#[test]
fn log_scales_level_off_smoothly() {
    for raw in [-30.0_f64, -9.0, -8.0, 0.3, 7.999, 8.001, 10.0, 1e6] {
        let (value, slope) = soft_clamp(raw);
        assert!(value.abs() <= LINEAR_LOG_SCALE + LOG_SCALE_MARGIN);
        let difference = (soft_clamp(raw + 1e-5).0 - soft_clamp(raw - 1e-5).0) / 2e-5;
        assert!((slope - difference).abs() < 1e-6, "{raw}: {slope} {difference}");
    }
    assert!(
        bent::<4>(true)
            .image(&[8.0, -8.0, 8.0, -8.0])
            .x
            .iter()
            .all(|x| x.is_finite())
    );
}

#[test]
fn the_map_of_a_gaussian_is_affine_and_has_its_density_in_any_order() {
    let covariance = Matrix([[4.0, 1.0, -0.5], [1.0, 2.0, 0.3], [-0.5, 0.3, 0.01 + 0.2]]);
    let centre = [1.0, -2.0, 0.5];
    let inverse = covariance.inverse().unwrap();
    for order in [[0, 1, 2], [2, 0, 1], [1, 2, 0]] {
        let map = TriangularMap::gaussian(&centre, &covariance, order).unwrap();
        for x in [[0.0; 3], [1.0, -1.0, 2.0], [-3.0, 0.5, 0.1]] {
            let offset = vector::subtract(&x, &centre);
            let square = vector::dot(&offset, &inverse.apply(&offset));
            let wanted = -0.5 * (square + covariance.determinant().ln());
            assert!((map.log_density(&x) - wanted).abs() < 1e-12);
        }
    }
    assert!(TriangularMap::gaussian(&[0.0; 2], &Matrix([[1.0, 1.0], [1.0, 1.0]]), [0, 1]).is_none());
}

#[test]
fn the_divergence_of_gaussians_is_the_closed_form() {
    // KL(N(1, 4) ‖ N(0, 1)) = ½ (1 + 4 − 1) − log 2.
    let wide = TriangularMap::gaussian(&[0.0], &Matrix([[1.0]]), [0]).unwrap();
    let moved = wide.moved(1.0, &[1.0, 2.0_f64.ln()]);
    let found = moved.conditional_divergence(&moved.image(&[0.3]), &wide);
    assert!((found - (2.0 - 2.0_f64.ln())).abs() < 1e-14);
}

proptest! {
    #[test]
    fn what_was_mapped_comes_back(z in prop::array::uniform4(-3.0..3.0_f64)) {
        let map = bent::<4>(false);
        let image = map.image(&z);
        let (back, log_determinant) = map.inverse(&image.x);
        for (a, b) in z.iter().zip(back) {
            prop_assert!((a - b).abs() < 1e-6, "{z:?} {back:?}");
        }
        prop_assert!((log_determinant - map.log_determinant(&image)).abs() < 1e-9);
    }
}
