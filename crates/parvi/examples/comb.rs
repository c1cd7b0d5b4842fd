//! How often a survey loses a tooth of a comb of narrow normal laws in one dimension, and whether it says so: `cargo run --example comb -p parvi [-- SEEDS]`.

#![allow(clippy::print_stdout)]

use parvi::{MpmOptions, Run, Silent};
use parvi_targets::{Frame, Target};

/// Normal laws of equal masses at 0, 1, 2, …
struct Comb;

const TEETH: usize = 40;
const WIDTH: f64 = 0.01;

impl Comb {
    /// The tooth beside which the others count for nothing.
    fn nearest(x: f64) -> f64 {
        x.round().clamp(0.0, TEETH as f64 - 1.0)
    }
}

impl Target<1> for Comb {
    fn log_density(&self, x: &[f64; 1]) -> f64 {
        let z = (x[0] - Self::nearest(x[0])) / WIDTH;
        -0.5 * z * z - (TEETH as f64 * WIDTH * std::f64::consts::TAU.sqrt()).ln()
    }

    fn score(&self, x: &[f64; 1]) -> [f64; 1] {
        [(Self::nearest(x[0]) - x[0]) / (WIDTH * WIDTH)]
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let seeds = std::env::args().nth(1).map_or(Ok(20), |seeds| seeds.parse())?;
    let middle = 0.5 * (TEETH as f64 - 1.0);
    let frame = Frame::from_scales([middle], [TEETH as f64 / 12_f64.sqrt()])?;
    println!("seed,outcome,empty_teeth,log_evidence,log_evidence_error,evaluations");
    for seed in 0..seeds {
        let samples = MpmOptions::default().sample(&Comb, &frame, &Run::new(1000, seed), &mut Silent)?;
        let mut particles = [0; TEETH];
        for x in &samples.positions {
            particles[Comb::nearest(x[0]) as usize] += 1;
        }
        let empty = particles.iter().filter(|&&count| count == 0).count();
        let outcome = samples
            .certificate
            .map_or("none", |certificate| certificate.outcome.name());
        let [log, error] = [samples.log_evidence, samples.log_evidence_error].map(|value| value.unwrap_or(f64::NAN));
        let evaluations = samples.density_evaluations + samples.score_evaluations;
        println!("{seed},{outcome},{empty},{log:.5},{error:.5},{evaluations}");
    }
    Ok(())
}
