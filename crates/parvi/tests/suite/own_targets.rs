//! Targets that a user brings: with constraints, without a gradient, with many rows of data.

use mpm_tensor::vector;
use parvi::{MpmOptions, Run, Samples, Silent};
use parvi_metrics::{Cloud, CloudMoments};
use parvi_targets::{
    Constraints, FiniteDifferenceScore, Frame, LogisticRegression, MinibatchScore, RegressionData, Target,
};

use crate::support::{body_alone, on_threads};

fn sample<const D: usize>(target: &dyn Target<D>, frame: &Frame<D>, particles: usize) -> Samples<D> {
    let run = Run::new(particles, 2);
    MpmOptions::default()
        .sample(target, frame, &run, &mut Silent)
        .expect("a run that ends well")
}

fn moments<const N: usize>(particles: &[[f64; N]]) -> ([f64; N], [f64; N]) {
    let cloud = Cloud::new(particles).expect("finite particles");
    let moments = CloudMoments::new(&cloud).expect("moments");
    (moments.mean, std::array::from_fn(|k| moments.covariance.0[k][k].sqrt()))
}

/// Counts of three kinds under a uniform prior, times a gamma density: ∝ Π p_k^(a_k − 1) · t e^(−t).
struct CountsAndTime;

const EXPONENTS: [f64; 3] = [6.0, 3.0, 10.0];

impl Target<4> for CountsAndTime {
    fn log_density(&self, x: &[f64; 4]) -> f64 {
        let counts: f64 = (0..3).map(|k| (EXPONENTS[k] - 1.0) * x[k].ln()).sum();
        counts + x[3].ln() - x[3]
    }

    fn score(&self, x: &[f64; 4]) -> [f64; 4] {
        let count = |k: usize| (EXPONENTS[k] - 1.0) / x[k];
        [count(0), count(1), count(2), 1.0 / x[3] - 1.0]
    }
}

fn counts_and_time() -> (Constraints<4, 3>, Frame<3>) {
    let constraints = Constraints::<4, 3>::builder().simplex(3).positive(1).build().unwrap();
    let centre = constraints.unconstrain(&[0.3, 0.2, 0.5, 1.5]).unwrap();
    (constraints, Frame::from_scales(centre, [0.5, 0.5, 0.8]).unwrap())
}

#[test]
fn particles_have_the_moments_in_the_users_coordinates() {
    let (constraints, frame) = counts_and_time();
    let target = constraints.target(CountsAndTime);
    let samples = sample(&target, &frame, 2000);
    let particles = constraints.constrain_all(&samples.positions);
    let (mean, sd) = moments(&particles);
    let total: f64 = EXPONENTS.iter().sum();
    for k in 0..4 {
        let (exact, exact_sd) = if k == 3 {
            (2.0, 2_f64.sqrt())
        } else {
            let p = EXPONENTS[k] / total;
            (p, (p * (1.0 - p) / (total + 1.0)).sqrt())
        };
        // Independent draws: 0.022 standard deviations.
        assert!(
            (mean[k] - exact).abs() < 0.02 * exact_sd,
            "mean {k}: {} for {exact}",
            mean[k]
        );
        assert!(
            (sd[k] / exact_sd - 1.0).abs() < 0.05,
            "sd {k}: {} for {exact_sd}",
            sd[k]
        );
    }
    for x in particles {
        assert!((x[0] + x[1] + x[2] - 1.0).abs() < 1e-12 && x.iter().all(|&x| x > 0.0));
    }
}

#[test]
fn differences_do_as_well_as_the_score() {
    let (constraints, frame) = counts_and_time();
    let exact = constraints.target(CountsAndTime);
    let differences = FiniteDifferenceScore::new(constraints.log_density(|x| CountsAndTime.log_density(x)));
    let (mean, sd) = moments(&sample(&exact, &frame, 500).positions);
    let (mean_of_differences, sd_of_differences) = moments(&sample(&differences, &frame, 500).positions);
    // In the unconstrained coordinates, of scale 0.5. Errors of 1e-9 can choose another kernel.
    for k in 0..3 {
        assert!((mean[k] - mean_of_differences[k]).abs() < 0.02);
        assert!((sd[k] - sd_of_differences[k]).abs() < 0.02);
    }
}

#[test]
fn minibatches_of_a_large_regression_give_its_posterior() {
    let data = RegressionData::synthetic(&[0.5, -1.0, 0.8], 5_000, 3).unwrap();
    let posterior = LogisticRegression::<3>::with_prior("synthetic", data, 10.0).unwrap();
    let frame = *posterior.laplace().frame();
    let minibatch = || {
        MinibatchScore::new(&posterior, 250, 4)
            .unwrap()
            .with_control_variate(*frame.centre())
            .unwrap()
    };
    let reference = |x: &[f64; 3]| frame.to_reference(x);
    let in_frame = |samples: &Samples<3>| moments(&samples.positions.iter().map(reference).collect::<Vec<_>>());

    // Its log density is the whole sum: no survey, which would spend more on that than batches save.
    let sample = |target: &dyn Target<3>| {
        body_alone()
            .sample(target, &frame, &Run::new(500, 2), &mut Silent)
            .expect("a run that ends well")
    };
    let (mean, sd) = in_frame(&sample(&posterior));
    let estimated = minibatch();
    let samples = sample(&estimated);
    let (mean_of_batches, sd_of_batches) = in_frame(&samples);
    assert!(vector::distance(&mean, &mean_of_batches) < 0.1);
    for k in 0..3 {
        assert!(
            (sd_of_batches[k] / sd[k] - 1.0).abs() < 0.05,
            "{sd_of_batches:?} for {sd:?}"
        );
    }
    // One call per step, and those of the moment correction.
    assert_eq!(samples.score_evaluations, 500 * estimated.calls());

    // The same seed, the same bits; on one thread and on two.
    for threads in [1, 2] {
        let again = minibatch();
        let positions = on_threads(threads, || sample(&again)).positions;
        assert_eq!(positions, samples.positions);
    }
}

/// A density with a score that need not be its gradient.
struct Own<L, S>(L, S);

impl<L: Fn(&[f64; 2]) -> f64 + Sync, S: Fn(&[f64; 2]) -> [f64; 2] + Sync> Target<2> for Own<L, S> {
    fn log_density(&self, x: &[f64; 2]) -> f64 {
        (self.0)(x)
    }

    fn score(&self, x: &[f64; 2]) -> [f64; 2] {
        (self.1)(x)
    }
}

/// What is said of particles from this target.
fn reason<L: Fn(&[f64; 2]) -> f64 + Sync, S: Fn(&[f64; 2]) -> [f64; 2] + Sync>(log_density: L, score: S) -> String {
    let samples = sample(&Own(log_density, score), &Frame::identity(), 500);
    // Log p alone is enough.
    let (mean, sd) = moments(&samples.positions);
    assert!(mean.iter().all(|m| m.abs() < 0.05), "{mean:?}");
    assert!(sd.iter().all(|s| (s - sd[0]).abs() < 0.05), "{sd:?}");
    let outcome = samples.certificate.expect("a certificate").outcome;
    outcome.reason().unwrap_or_default()
}

#[test]
fn a_score_that_is_not_the_gradient_is_told() {
    let normal = |x: &[f64; 2]| -0.5 * vector::norm_squared(x);
    let error = "the score is not the gradient of log p";
    for (wrong, factors) in [("sign", [1.0, 1.0]), ("twice", [-2.0, -2.0]), ("an axis", [-1.0, 0.0])] {
        let said = reason(normal, |x| [factors[0] * x[0], factors[1] * x[1]]);
        assert!(said.starts_with(error), "{wrong}: {said}");
    }
}

#[test]
fn a_score_that_is_the_gradient_is_not_doubted() {
    let signs = |x: &[f64; 2]| x.map(|c| -c.signum());
    // Kinks; a flat top with edges; a log density in single precision.
    assert_eq!(reason(|x| -x[0].abs() - x[1].abs(), signs), "");
    let inside = |x: &[f64; 2]| {
        if vector::maximum_norm(x) < 1.0 {
            0.0
        } else {
            f64::NEG_INFINITY
        }
    };
    assert_eq!(reason(inside, |_| [0.0; 2]), "");
    let single = |x: &[f64; 2]| f64::from((-0.5 * vector::norm_squared(x) + 1e3) as f32);
    assert_eq!(reason(single, |x| x.map(|c| -c)), "");
}
