//! Does a regression with flat priors have a proper posterior?
//!
//! A coefficient with a Gaussian prior is always identified; those with a flat one need linearly independent columns
//! and responses that no combination of these columns separates: for a yes or no A. Albert, J. A. Anderson, *Biometrika*
//! 71 (1984) 1–10; for counts a combination that is constant 0 where events occurred and negative somewhere else
//! (J. M. C. Santos Silva, S. Tenreyro, *Economics Letters* 107 (2010) 310–312).

use mpm_tensor::vector;

use crate::laplace::Curved;
use crate::posterior::Posterior;
use crate::{Curvature, Link, RegressionTable, Response, Target, TargetError};

/// A column whose part outside of the span of the others is smaller than this fraction of its length depends on them.
const DEPENDENCE: f64 = 1e-10;

/// Newton steps of the search for a finite mode.
const MAXIMUM_STEPS: usize = 100;

/// The error that the columns with a flat prior (`flat[k]`) are linearly dependent, naming those involved.
pub(crate) fn check_independence<Y: Response, const D: usize>(
    data: &RegressionTable<Y>,
    rows: &[[f64; D]],
    flat: &[bool; D],
) -> Result<(), TargetError> {
    // Modified Gram–Schmidt, twice; `combinations[k]` writes the k-th basis vector in the unit-length columns.
    let mut basis: Vec<(Vec<f64>, [f64; D])> = Vec::new();
    for column in (0..D).filter(|&column| flat[column]) {
        let mut rest: Vec<f64> = rows.iter().map(|row| row[column]).collect();
        let largest = rest.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
        if largest > 0.0 {
            rest.iter_mut().for_each(|x| *x /= largest);
            let length = norm(&rest);
            rest.iter_mut().for_each(|x| *x /= length);
        }
        let mut combination = [0.0; D];
        combination[column] = 1.0;
        for _ in 0..2 {
            for (direction, of_columns) in &basis {
                let part: f64 = direction.iter().zip(&rest).map(|(a, b)| a * b).sum();
                rest.iter_mut().zip(direction).for_each(|(x, d)| *x -= part * d);
                vector::accumulate(&mut combination, -part, of_columns);
            }
        }
        let left = norm(&rest);
        if left <= DEPENDENCE {
            let columns = named(data, &combination.map(|weight| weight.abs() > 1e-6));
            return Err(TargetError::DataCollinear {
                file: data.source().to_owned(),
                columns,
            });
        }
        rest.iter_mut().for_each(|x| *x /= left);
        basis.push((rest, combination.map(|weight| weight / left)));
    }
    Ok(())
}

/// The error that columns with a flat prior separate the responses.
///
/// Newton's method is run from 0; where a mode exists its steps vanish, where the likelihood rises for ever each step moves
/// some predictor by about 1. Such a step is a direction of separation if it takes no row's predictor where its likelihood
/// falls ([`Response::free_side`]) and moves no coefficient with a proper prior.
pub(crate) fn check_overlap<L: Link, const D: usize>(
    data: &RegressionTable<L::Response>,
    posterior: &Posterior<L, D>,
) -> Result<(), TargetError> {
    let scale: [f64; D] = std::array::from_fn(|k| {
        posterior
            .rows
            .iter()
            .fold(0.0_f64, |largest, row| largest.max(row[k].abs()))
    });
    let mut coefficients = [0.0; D];
    for _ in 0..MAXIMUM_STEPS {
        let Ok(factor) = Curved::new(data.source(), &posterior.negative_hessian(&coefficients)) else {
            break;
        };
        let step = factor.solve(&posterior.score(&coefficients));
        let predictors = || posterior.rows.iter().map(|row| vector::dot(row, &step));
        let largest = predictors().fold(0.0_f64, |largest, t| largest.max(t.abs()));
        if largest < 1e-6 {
            return Ok(());
        }
        let sides = || data.responses().iter().map(|response| response.free_side());
        let lowest = predictors()
            .zip(sides())
            .map(|(t, side)| side.map_or(-t.abs(), |side| side * t))
            .fold(f64::INFINITY, f64::min);
        let moved: [bool; D] = std::array::from_fn(|k| (step[k] * scale[k]).abs() > 1e-5 * largest);
        let only_flat = (0..D).all(|k| !moved[k] || posterior.precision[k] == 0.0);
        // Early steps may look like a separation by chance; at a predictor of 12 the rows it leaves alone have settled.
        let far = (posterior.rows.iter().zip(sides()))
            .any(|(row, side)| side.is_some_and(|side| side * vector::dot(row, &coefficients) > 12.0));
        if far && only_flat && lowest > -1e-6 * largest {
            let columns = named(data, &moved);
            return Err(TargetError::DataSeparated {
                file: data.source().to_owned(),
                columns,
            });
        }
        // The log posterior is concave: halve a step that overshoots.
        let density = posterior.log_density(&coefficients);
        let mut trials = (0..60).map(|halvings| vector::add_scaled(&coefficients, 0.5_f64.powi(halvings), &step));
        match trials.find(|trial| posterior.log_density(trial) >= density) {
            Some(trial) => coefficients = trial,
            None => break,
        }
    }
    Ok(())
}

fn norm(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn named<Y: Response, const D: usize>(data: &RegressionTable<Y>, chosen: &[bool; D]) -> String {
    let names: Vec<&str> = (0..D)
        .filter(|&k| chosen[k])
        .map(|k| data.names()[k].as_str())
        .collect();
    names.join(", ")
}
