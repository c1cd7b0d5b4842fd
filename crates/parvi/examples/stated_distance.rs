//! How far particles are from random targets, and how far the sampler says they are: `cargo run --release --example stated_distance -p parvi [-- FIRST_SEED COUNT PARTICLES]`.
//!
//! Energy distances over those of as many independent draws, in the coordinates in which the target's standard deviations are one; the true ones against 16,384 quasi-random points.

#![allow(clippy::print_stdout)]

mod over_seeds;

use parvi::{MpmOptions, Run, Silent};
use parvi_metrics::yardstick::{Coordinates, TargetYardstick, YardstickOptions};
use parvi_targets::{Frame, RandomTarget};

const REFERENCE: usize = 16_384;

fn compare<const D: usize>(seed: u64, particles: usize) -> Result<(), Box<dyn std::error::Error>> {
    let target = RandomTarget::<D>::new(seed)?;
    let samples = MpmOptions::default().sample(&target, &Frame::identity(), &Run::new(particles, 0), &mut Silent)?;
    let yardstick = TargetYardstick::new(
        Box::new(target),
        &YardstickOptions::of_energy(REFERENCE, 12_345, Coordinates::Scaled),
    )?;
    let errors = yardstick.measure(&samples.positions, None)?;
    let distance = errors.energy_distance_squared * particles as f64 / yardstick.mean_distance();
    let stated = samples.relative_energy_distance.unwrap_or(f64::NAN);
    let outcome = samples
        .certificate
        .map_or("none", |certificate| certificate.outcome.name());
    println!("{D},{seed},{outcome},{stated:.5},{distance:.5}");
    Ok(())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    over_seeds::print(
        [0, 20, 1000],
        "dim,target_seed,outcome,stated,true",
        &[compare::<1>, compare::<2>, compare::<3>, compare::<4>, compare::<6>],
    )
}
