//! A log density without a score: its gradient by central differences.
//!
//! Waiting times of 1.2, 0.4, 3.1, 0.9 and 2.0 minutes, exponential with rate λ > 0 under the prior Gamma(2, 1): the posterior is
//! Gamma(7, 8.6), of mean 0.814 and standard deviation 0.308.
//!
//! `cargo run --release --example finite_difference -p parvi`

#![allow(clippy::print_stdout)]

use std::error::Error;

use parvi::{MpmOptions, Run, Silent};
use parvi_targets::{Constraints, FiniteDifferenceScore, Frame};

const WAITING_TIMES: [f64; 5] = [1.2, 0.4, 3.1, 0.9, 2.0];

fn log_density(&[rate]: &[f64; 1]) -> f64 {
    let prior = rate.ln() - rate;
    let likelihood: f64 = WAITING_TIMES.iter().map(|time| rate.ln() - rate * time).sum();
    prior + likelihood
}

fn main() -> Result<(), Box<dyn Error>> {
    let constraints = Constraints::<1, 1>::builder().positive(1).build()?;
    // Differences are taken in log λ, where no step leaves the support.
    let target = FiniteDifferenceScore::new(constraints.log_density(log_density));

    let frame = Frame::from_scales(constraints.unconstrain(&[1.0])?, [0.5])?;
    println!(
        "estimated error of the score at the start: {:.1e}",
        target.error(frame.centre())[0]
    );
    let samples = MpmOptions::default().sample(&target, &frame, &Run::new(500, 1), &mut Silent)?;

    let rates = constraints.constrain_all(&samples.positions);
    let count = rates.len() as f64;
    let mean = rates.iter().map(|x| x[0]).sum::<f64>() / count;
    let variance = rates.iter().map(|x| (x[0] - mean).powi(2)).sum::<f64>() / count;
    println!("rate: {mean:.3} ± {:.3} per minute", variance.sqrt());
    Ok(())
}
