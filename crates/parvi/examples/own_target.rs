//! An own density in two functions, with a parameter that must be positive.
//!
//! H. Cavendish weighed the earth in 1798: 29 determinations of its density, relative to water. Taken as draws of a normal law of
//! unknown mean μ and standard deviation σ > 0 with the prior 1/σ, they have a posterior whose moments are known: μ = 5.448 ±
//! 0.043, σ = 0.227 ± 0.032.
//!
//! `cargo run --release --example own_target -p parvi`

#![allow(clippy::print_stdout)]

use std::error::Error;

use parvi::{MpmOptions, Run, Silent};
use parvi_targets::{Constraints, Frame, Target};

/// Philosophical Transactions of the Royal Society of London 88 (1798).
const DENSITIES: [f64; 29] = [
    5.50, 5.61, 4.88, 5.07, 5.26, 5.55, 5.36, 5.29, 5.58, 5.65, 5.57, 5.53, 5.62, 5.29, 5.44, 5.34, 5.79, 5.10, 5.27,
    5.39, 5.42, 5.47, 5.63, 5.34, 5.46, 5.30, 5.75, 5.68, 5.85,
];

/// log p(μ, σ) = −(n + 1) log σ − Σ (x_i − μ)² / 2σ², in the user's own coordinates.
struct Posterior;

impl Target<2> for Posterior {
    fn log_density(&self, &[mean, sd]: &[f64; 2]) -> f64 {
        let squares: f64 = DENSITIES.iter().map(|x| (x - mean).powi(2)).sum();
        -(DENSITIES.len() as f64 + 1.0) * sd.ln() - 0.5 * squares / (sd * sd)
    }

    fn score(&self, &[mean, sd]: &[f64; 2]) -> [f64; 2] {
        let sum: f64 = DENSITIES.iter().map(|x| x - mean).sum();
        let squares: f64 = DENSITIES.iter().map(|x| (x - mean).powi(2)).sum();
        let by_sd = -(DENSITIES.len() as f64 + 1.0) / sd + squares / sd.powi(3);
        [sum / (sd * sd), by_sd]
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    // The first coordinate is free, the second positive; the sampler moves (μ, log σ).
    let constraints = Constraints::<2, 2>::builder().free(1).positive(1).build()?;
    let target = constraints.target(Posterior);

    // Where the posterior is, and how wide in the sampler's coordinates: a guess within a factor of two is enough.
    let frame = Frame::from_scales(constraints.unconstrain(&[5.4, 0.2])?, [0.05, 0.15])?;
    let samples = MpmOptions::default().sample(&target, &frame, &Run::new(1000, 1), &mut Silent)?;

    // Back to (μ, σ).
    let particles = constraints.constrain_all(&samples.positions);
    for (axis, name) in ["mean", "standard deviation"].into_iter().enumerate() {
        let count = particles.len() as f64;
        let mean = particles.iter().map(|x| x[axis]).sum::<f64>() / count;
        let variance = particles.iter().map(|x| (x[axis] - mean).powi(2)).sum::<f64>() / count;
        println!("{name}: {mean:.3} ± {:.3}", variance.sqrt());
    }
    Ok(())
}
