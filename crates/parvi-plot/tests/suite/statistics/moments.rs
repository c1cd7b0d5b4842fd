//! Means and covariances.

use parvi_plot::statistics::{SampleMoments, StatisticsError};

#[test]
fn the_corners_of_a_square_have_unit_covariance() {
    let corners = [[4.0, 1.0], [4.0, -1.0], [2.0, 1.0], [2.0, -1.0]].map(Vec::from);
    let moments = SampleMoments::of(&corners, None).unwrap();
    assert_eq!(moments.mean, [3.0, 0.0]);
    assert_eq!(moments.distance_from_identity(), 0.0);
    assert_eq!(moments.largest_mean(), 3.0);
}

#[test]
fn weights_count() {
    let points = [vec![0.0], vec![4.0]];
    let moments = SampleMoments::of(&points, Some(&[0.75, 0.25])).unwrap();
    assert_eq!((moments.mean[0], moments.covariance[0][0]), (1.0, 3.0));
}

#[test]
fn what_has_not_the_same_length_is_refused() {
    let refused = |points: &[Vec<f64>], weights: Option<&[f64]>| {
        let refused = SampleMoments::of(points, weights);
        matches!(refused, Err(StatisticsError::Length { .. }))
    };
    assert!(refused(&[vec![0.0, 1.0], vec![4.0]], None));
    assert!(refused(&[vec![0.0], vec![4.0, 1.0]], None));
    assert!(refused(&[vec![0.0], vec![4.0]], Some(&[1.0])));
}
