//! Running a random configuration in a frame that is wrong on purpose.

use std::fmt::Debug;

use mpm_tensor::{Matrix, Polar, vector};
use parvi::{Method, Observer, Run, SampleError, Samples, defaults};
use parvi_targets::{CatalogueTarget, Frame, TargetError, normal_quantile};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

use super::draw::Configuration;
use crate::study::attempt::caught;
use crate::study::prelude::*;

/// Finite particles have escaped if one is this many times farther out than start and target could explain.
const ESCAPE: f64 = 10.0;
/// No target of the catalogue has particles in use farther out than this, in scales of its frame.
const TARGET_REACH: f64 = 10.0;

/// Runs a configuration; the observer may stop it.
pub fn run<const D: usize>(
    target: &dyn CatalogueTarget<D>,
    case: &Configuration,
    row: &mut Row,
    observer: &mut dyn Observer,
) -> Result<(), CommandError> {
    let own = target.frame();
    let frame = match wrong_frame(&own, case) {
        Ok(frame) => frame,
        Err(error) => {
            row.fail_in((&variant(&error), None), Failure::new(Status::Refused, error));
            return Ok(());
        }
    };
    let basis = case.basis.uniform().unwrap_or_default();
    let spacing = case.spacing_factor * defaults::spacing::<D>(basis, case.particles);
    let time_step = case.time_step_factor * defaults::time_step(spacing);
    row.set("spacing", spacing);
    row.set("time_step", time_step);
    let mut options = case.options.clone();
    (options.spacing, options.time_step) = (Some(spacing), Some(time_step));
    let method = options.method(case.method)?;
    let mut run = Run::new(case.particles, case.seed);
    run.start = options.start();

    let sampled = || match &method {
        Method::Mpm(options) => options.sample(target, &frame, &run, observer),
        Method::Paper(options) => options.sample(target, &frame, &run, observer),
        other => parvi::sample(target, other, &run, observer),
    };
    let (seconds, result) = timed(|| caught(sampled));
    row.set("wall_seconds", seconds);
    match result {
        Ok(Ok(samples)) => end(row, &own, &frame, &samples),
        Ok(Err(error @ SampleError::Interrupted { .. })) => return Err(error.into()),
        Ok(Err(error)) => fail(row, &error),
        Err(message) => {
            row.set("ending", Status::Panicked);
            row.set("message", message);
        }
    }
    Ok(())
}

/// The target's frame, larger or smaller by the case's factor and turned: μ + (s Q L) z, by its covariance.
fn wrong_frame<const D: usize>(own: &Frame<D>, case: &Configuration) -> Result<Frame<D>, TargetError> {
    let turn = case.turn.map_or(Matrix::IDENTITY, turn);
    let covariance = turn * own.covariance() * turn.transpose() * case.scale.powi(2);
    Frame::new(*own.centre(), covariance.symmetric_part())
}

/// The Frobenius norm of L⁻¹ L': no z is longer in scales of `own` than this times its length in scales of `frame`.
fn stretch<const D: usize>(own: &Frame<D>, frame: &Frame<D>) -> f64 {
    let image = |axis: usize| {
        let unit: [f64; D] = std::array::from_fn(|other| f64::from(u8::from(other == axis)));
        vector::norm(&own.to_reference(&frame.to_target(&unit))).powi(2)
    };
    (0..D).map(image).sum::<f64>().sqrt()
}

/// A uniformly random rotation: the nearest one to a matrix of normal draws.
fn turn<const D: usize>(seed: u64) -> Matrix<D> {
    let mut generator = ChaCha8Rng::seed_from_u64(seed);
    let draws = Matrix::from_fn(|_, _| normal_quantile(generator.random()));
    Polar::new(&draws).map_or(Matrix::IDENTITY, |polar| polar.rotation)
}

/// Notes particles.
fn end<const D: usize>(row: &mut Row, own: &Frame<D>, frame: &Frame<D>, samples: &Samples<D>) {
    let weights = samples.weights.iter().flatten();
    let mut numbers = samples.positions.as_flattened().iter().chain(weights);
    if let Some(value) = numbers.find(|value| !value.is_finite()) {
        row.set("ending", Status::NotFinite);
        row.set("message", format!("a particle has the value {value}"));
        return;
    }
    let root = (D as f64).sqrt();
    let [mean, sd] = ["start_mean", "start_sd"].map(|column| row.number(column).unwrap_or(0.0));
    let start_reach = (mean * root + sd * (root + 4.0)) * stretch(own, frame);
    let bound = ESCAPE * (start_reach + TARGET_REACH);
    let distances = || samples.positions.iter().map(|x| vector::norm(&own.to_reference(x)));
    // An overflow of the distance is an escape as well.
    let escaped = distances().any(|distance| distance.is_nan() || distance > bound);
    row.set("reach", distances().reduce(f64::max));
    row.set("escaped", escaped.to_string());
    row.set("residual", samples.residual.filter(|value| value.is_finite()));
}

/// Notes a typed error of the sampler.
fn fail(row: &mut Row, error: &SampleError) {
    let reason = match error {
        SampleError::Mechanics { source, .. } => variant(source),
        _ => variant(error),
    };
    row.fail_in((&reason, error.step()), Failure::new(Status::Refused, error));
}

/// The name of an error's variant.
fn variant(error: &impl Debug) -> String {
    let text = format!("{error:?}");
    let end = text.find(|character: char| !character.is_alphanumeric());
    text[..end.unwrap_or(text.len())].to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turn_is_a_rotation() {
        for seed in 0..20 {
            let turn: Matrix<4> = turn(seed);
            assert!((turn * turn.transpose() - Matrix::IDENTITY).maximum_norm() < 1e-14);
            assert!((turn.determinant() - 1.0).abs() < 1e-13);
        }
    }

    #[test]
    fn errors_have_names() {
        let error = SampleError::Diverged {
            step: 3,
            reason: String::new(),
        };
        assert_eq!(variant(&error), "Diverged");
    }
}
