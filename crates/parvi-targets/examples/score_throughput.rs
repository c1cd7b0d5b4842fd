//! Time of a batch of scores and of log densities of the wells posterior (n = 3,020 rows, M = 2,048 particles).
//!
//! `RAYON_NUM_THREADS=1 cargo run --release -p parvi-targets --example score_throughput`

#![allow(clippy::print_stdout)]

use std::time::Instant;

use parvi_targets::{Parameters, TargetError, build};

const PARTICLES: usize = 2048;
const REPETITIONS: usize = 100;

fn best_of(mut work: impl FnMut()) -> f64 {
    let time = |_| {
        let start = Instant::now();
        work();
        start.elapsed().as_secs_f64()
    };
    (0..REPETITIONS).map(time).fold(f64::INFINITY, f64::min)
}

fn measure<const D: usize>() -> Result<(), TargetError> {
    let target = build::<D>("wells", &Parameters::default())?;
    let frame = target.frame();
    let spread = |p: usize, k: usize| ((p * D + k + 1) as f64 * 0.618_033_988_75).fract() * 4.0 - 2.0;
    let xs: Vec<[f64; D]> = (0..PARTICLES)
        .map(|p| frame.to_target(&std::array::from_fn(|k| spread(p, k))))
        .collect();
    let (mut scores, mut densities) = (vec![[0.0; D]; PARTICLES], vec![0.0; PARTICLES]);
    let score_time = best_of(|| target.scores(&xs, &mut scores));
    let density_time = best_of(|| target.log_densities(&xs, &mut densities));
    let pairs = (3020 * PARTICLES) as f64;
    println!(
        "d = {D}: scores {:.1} ms ({:.0} ns per particle, {:.2} ns per row and particle), {} flops per row and \
         particle in products besides one exponential and one division; log densities {:.1} ms",
        1e3 * score_time,
        1e9 * score_time / PARTICLES as f64,
        1e9 * score_time / pairs,
        4 * D,
        1e3 * density_time,
    );
    Ok(())
}

fn main() -> Result<(), TargetError> {
    measure::<1>()?;
    measure::<3>()?;
    measure::<5>()?;
    measure::<6>()
}
