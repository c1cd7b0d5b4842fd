//! How much nearer to random targets the points and free draws of `Condensation::Controlled` are than the points of `Condensation::Off`, the same evaluations: `cargo run --release --example weighted_samples -p parvi [-- FIRST_SEED COUNT PARTICLES]`.
//!
//! Energy distances against 65,536 quasi-random points, in the coordinates in which the target's standard deviations are one, over those of as many independent draws as there are particles.

#![allow(clippy::print_stdout)]

mod over_seeds;

use parvi::{AisOptions, Condensation, Run, Silent};
use parvi_metrics::yardstick::{Coordinates, TargetYardstick, YardstickOptions};
use parvi_targets::{Frame, RandomTarget};

const REFERENCE: usize = 65_536;

fn compare<const D: usize>(seed: u64, particles: usize) -> Result<(), Box<dyn std::error::Error>> {
    let yardstick = TargetYardstick::new(
        Box::new(RandomTarget::<D>::new(seed)?),
        &YardstickOptions::of_energy(REFERENCE, 12_345, Coordinates::Scaled),
    )?;
    let (mut distances, mut share) = ([0.0; 2], 0.0);
    for (distance, condense) in distances.iter_mut().zip([Condensation::Off, Condensation::Controlled]) {
        let (target, options) = (
            RandomTarget::<D>::new(seed)?,
            AisOptions {
                condense,
                ..AisOptions::default()
            },
        );
        let samples = options.sample(&target, &Frame::identity(), &Run::new(particles, 0), &mut Silent)?;
        let errors = yardstick.measure(&samples.positions, samples.weights.as_deref())?;
        *distance = errors.energy_distance_squared * particles as f64 / yardstick.mean_distance();
        share = samples.pool.map_or(f64::NAN, |pool| pool.verdict.effective_share);
    }
    let [off, controlled] = distances;
    println!("{D},{seed},{share:.2},{off:.5},{controlled:.5},{:.2}", off / controlled);
    Ok(())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    over_seeds::print(
        [0, 10, 1000],
        "dim,target_seed,effective_share,off,controlled,quotient",
        &[compare::<2>, compare::<3>, compare::<4>, compare::<6>],
    )
}
