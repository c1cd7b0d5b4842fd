//! Nanoseconds per pair and per particle of the quadratic metrics, on this machine with this number of threads.
#![allow(clippy::print_stdout)]

use std::hint::black_box;
use std::time::Instant;

use parvi_metrics::{
    Cloud, Directions, EnergyReference, GaussianEnergy, InverseMultiquadric, MetricError, RadialKernel,
    SlicedReference, kernel_stein_discrepancy, maximum_mean_discrepancy_squared, mean_pair_distance,
};
use rand::{RngExt, SeedableRng, rngs::ChaCha12Rng};
use rand_distr::StandardNormal;

/// Seconds of the fastest of many runs.
fn seconds<T>(run: impl Fn() -> T) -> f64 {
    (0..50)
        .map(|_| {
            let start = Instant::now();
            black_box(run());
            start.elapsed().as_secs_f64()
        })
        .fold(f64::INFINITY, f64::min)
}

fn measure<const D: usize>(count: usize) -> Result<(), MetricError> {
    let mut rng = ChaCha12Rng::seed_from_u64(1);
    let mut points = || -> Vec<[f64; D]> {
        (0..count)
            .map(|_| std::array::from_fn(|_| rng.sample(StandardNormal)))
            .collect()
    };
    let (points, reference_points) = (points(), points());
    let cloud = Cloud::new(&points)?;
    let reference = EnergyReference::new(&Cloud::new(&reference_points)?)?;
    let gaussian = GaussianEnergy::<D>::standard()?;
    let n = count as f64;
    println!("d = {D}, {count} points");
    let own = seconds(|| mean_pair_distance(&cloud));
    println!(
        "  own term           {:8.3} ns per distinct pair",
        own / (n * (n - 1.0) / 2.0) * 1e9
    );
    let all = seconds(|| reference.squared(&cloud));
    println!(
        "  against reference  {:8.3} ns per evaluated pair",
        all / (1.5 * n * n) * 1e9
    );
    let one = seconds(|| gaussian.expected_distances(&cloud));
    println!(
        "  E|x - Y|, Gaussian {:8.1} ns per particle (one thread)",
        one / n * 1e9
    );
    let one = seconds(|| gaussian.squared(&cloud));
    println!("  ED2 from Gaussian  {:8.3} ms in all", one * 1e3);
    let kernel = RadialKernel::new(1.5)?;
    let other = Cloud::new(&reference_points)?;
    let all = seconds(|| maximum_mean_discrepancy_squared(&cloud, &other, &kernel));
    println!(
        "  MMD, radial kernel {:8.3} ns per evaluated pair",
        all / (2.0 * n * n) * 1e9
    );
    let all = seconds(|| kernel_stein_discrepancy(&cloud, &points, &InverseMultiquadric::default()));
    println!(
        "  KSD                {:8.3} ns per distinct pair",
        all / (n * (n - 1.0) / 2.0) * 1e9
    );
    let sliced = SlicedReference::new(&other, Directions::evenly_spread(64)?);
    let all = seconds(|| sliced.distance(&cloud));
    println!(
        "  sliced W2          {:8.1} ns per particle and direction",
        all / (n * if D == 1 { 1.0 } else { 64.0 }) * 1e9
    );
    Ok(())
}

fn main() -> Result<(), MetricError> {
    println!("{} threads", rayon::current_num_threads());
    mpm_tensor::in_dimensions!(measure(2048)?, 1, 2, 4);
    measure::<6>(2048)
}
