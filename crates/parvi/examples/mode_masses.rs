//! Masses of eight modes, 1 : 2 : … : 8: `cargo run --release --example mode_masses -p parvi [-- FIRST_SEED COUNT PARTICLES]`.
//!
//! Normal laws of standard deviation 0.3 whose centres are drawn in (−5, 5)ᴰ, no two nearer than 2.4; the frame is that of nothing known, N(0, 4² I).

#![allow(clippy::print_stdout)]

mod over_seeds;

use mpm_tensor::vector;
use parvi::{MpmOptions, Run, Silent};
use parvi_metrics::{Cloud, ModeMasses};
use parvi_targets::{CatalogueTarget, Frame, GaussianMixture, Mode};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

const WIDTH: f64 = 0.3;
const APART: f64 = 8.0 * WIDTH;

fn modes<const D: usize>(seed: u64) -> Vec<Mode<D>> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut modes = Vec::<Mode<D>>::new();
    while modes.len() < 8 {
        let centre = std::array::from_fn(|_| rng.random_range(-5.0..5.0));
        if modes.iter().all(|mode| vector::distance(&mode.centre, &centre) > APART) {
            modes.push(Mode {
                centre,
                width: WIDTH,
                mass: (modes.len() + 1) as f64,
            });
        }
    }
    modes
}

fn measure<const D: usize>(seed: u64, particles: usize) -> Result<(), Box<dyn std::error::Error>> {
    let target = GaussianMixture::new("eight", &modes::<D>(seed))?;
    let frame = Frame::from_scales([0.0; D], [4.0; D])?;
    let samples = MpmOptions::default().sample(&target, &frame, &Run::new(particles, seed), &mut Silent)?;
    let masses = ModeMasses::new(&Cloud::new(&samples.positions)?, target.modes())?;
    let evaluations = samples.score_evaluations + samples.density_evaluations;
    let outcome = samples
        .certificate
        .map_or("none", |certificate| certificate.outcome.name());
    println!(
        "{D},{seed},{outcome},{:.5},{:.1}",
        masses.largest_error,
        evaluations as f64 / particles as f64
    );
    Ok(())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    over_seeds::print(
        [0, 20, 4096],
        "dim,seed,outcome,largest_error,evaluations_per_particle",
        &[measure::<2>, measure::<4>, measure::<6>],
    )
}
