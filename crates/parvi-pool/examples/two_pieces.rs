//! How often a survey misses one of two pieces, and says nothing of it.
//!
//! A normal law of standard deviation 1 and mass 0.7 about (−5, …) and one of standard deviation s and mass 0.3 about (5, …), from a frame of standard deviation 4
//! about the middle, for 1,000 particles unless said: of 40 seeds, those without an objection whose log Z, of which the truth is 0, is off by more than four standard errors.
//!
//! `cargo run --release --example two_pieces -p parvi-pool -- [SEARCH_EFFORT] [PARTICLES]`

#![allow(clippy::print_stdout)]

use std::error::Error;
use std::ops::ControlFlow;

use parvi_pool::{Beginning, PoolOptions, Report, explore};
use parvi_targets::{Frame, GaussianMixture, Mode};

const WIDTHS: [f64; 5] = [1.0, 0.5, 0.3, 0.2, 0.1];
const SEEDS: u64 = 40;

fn main() -> Result<(), Box<dyn Error>> {
    let search_effort = std::env::args().nth(1).map_or(Ok(1.0), |effort| effort.parse())?;
    let particles = std::env::args().nth(2).map_or(Ok(1000), |count| count.parse())?;
    println!("d, then for s = {WIDTHS:?}: false claims, evaluations per particle");
    row::<1>(search_effort, particles)?;
    row::<2>(search_effort, particles)?;
    row::<3>(search_effort, particles)?;
    row::<4>(search_effort, particles)?;
    row::<5>(search_effort, particles)
}

fn row<const D: usize>(search_effort: f64, particles: usize) -> Result<(), Box<dyn Error>> {
    let frame = Frame::from_scales([0.0; D], [4.0; D])?;
    print!("{D}");
    for width in WIDTHS {
        let pieces = [(-5.0, 1.0, 0.7), (5.0, width, 0.3)].map(|(mean, width, mass)| Mode {
            centre: [mean; D],
            width,
            mass,
        });
        let target = GaussianMixture::new("two pieces", &pieces)?;
        let (mut wrong, mut evaluations) = (0, 0);
        for seed in 0..SEEDS {
            let options = PoolOptions {
                search_effort,
                ..PoolOptions::default()
            };
            let go_on = &mut |_: &Report<'_>| ControlFlow::Continue(());
            let pool = explore(
                &target,
                Beginning::in_frame(&frame).with_seed(seed),
                particles,
                &options,
                go_on,
            )?;
            let is_off = pool.log_evidence.abs() > 4.0 * pool.log_evidence_error;
            wrong += u32::from(is_off && pool.objection(particles).is_none());
            evaluations += pool.density_evaluations + pool.score_evaluations;
        }
        print!(
            "  {wrong:2} {:5.1}",
            evaluations as f64 / (SEEDS as f64 * particles as f64)
        );
    }
    println!();
    Ok(())
}
