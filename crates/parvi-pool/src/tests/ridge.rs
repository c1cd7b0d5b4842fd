//! Walks along a ridge.

use mpm_tensor::Matrix;
use parvi_targets::{Frame, Target};

use crate::density::Density;
use crate::fold::Fold;
use crate::sample::Sample;
use crate::walk::outposts;
use crate::{Kernel, Mixture};

/// A ring of radius 10 and width 0.1, three times as high as wide.
struct Ring;

const HEIGHT: f64 = 3.0;

impl Target<2> for Ring {
    fn log_density(&self, x: &[f64; 2]) -> f64 {
        let radius = x[0].hypot(x[1] / HEIGHT);
        -50.0 * (radius - 10.0).powi(2)
    }

    fn score(&self, x: &[f64; 2]) -> [f64; 2] {
        let radius = x[0].hypot(x[1] / HEIGHT);
        let along = -100.0 * (radius - 10.0) / radius;
        [along * x[0], along * x[1] / (HEIGHT * HEIGHT)]
    }
}

#[test]
fn walks_follow_a_ridge_beyond_what_was_covered_and_spend_no_more_than_they_may() {
    let frame = Frame::identity();
    let mut density = Density::of(&Ring, &frame);
    let near = Kernel {
        centre: [10.0, 0.0],
        factor: Matrix::diagonal(&[0.1, 2.0]),
        share: 1.0,
    };
    let mut fold = Fold::new();
    fold.draw(&mut density, Mixture::new(vec![near]).unwrap(), 400, 1);
    let high: Vec<usize> = (0..400).filter(|&i| fold.log_densities[i] > -4.0).collect();
    let sample = Sample {
        points: high.iter().map(|&i| fold.positions[i]).collect(),
        weights: vec![1.0; high.len()],
        logs: high.iter().map(|&i| fold.log_densities[i]).collect(),
        precisions: vec![None; high.len()],
    };
    let before = density.evaluations();
    let found = outposts(&fold, &sample, -4.0, 4_000, &mut density);
    assert!(density.evaluations() - before < 4_100);
    assert!(found.points.len() > 8, "{}", found.points.len());
    for (x, log) in found.points.iter().zip(&found.logs) {
        assert!(*log == Ring.log_density(x) && *log > -4.0);
    }
    let farthest = found.points.iter().map(|x| x[1].abs()).fold(0.0, f64::max);
    assert!(farthest > 12.0, "{farthest}");
    let before = density.evaluations();
    outposts(&fold, &sample, -4.0, 10, &mut density);
    assert!(density.evaluations() - before < 20);
}
