//! Standard deviations of Student laws by the pool and by particles, less the truth and over it (median and tenths), and how often `converged` is said of wrong ones:
//! `cargo run --release --example heavy_tails -p parvi [-- SEEDS [PARTICLES]]`.

#![allow(clippy::print_stdout)]

use parvi::{MpmOptions, Outcome, Run, Silent};
use parvi_targets::{Frame, Target};

/// How far off a standard deviation may be, relative to it, for a claim to be right.
const RIGHT: f64 = 0.1;

/// Student laws, up to a constant: of the distance from the centre, or of every coordinate by itself, of coordinates that are turned where D ≥ 2.
struct Tails {
    freedom: f64,
    is_product: bool,
}

/// An orthogonal matrix that mixes all axes: I − 2 e eᵀ, e the vector of ones over √D.
fn turned<const D: usize>(x: &[f64; D]) -> [f64; D] {
    let shift = 2.0 * x.iter().sum::<f64>() / D as f64;
    if D == 1 { *x } else { x.map(|c| c - shift) }
}

impl<const D: usize> Target<D> for Tails {
    fn log_density(&self, x: &[f64; D]) -> f64 {
        if self.is_product {
            let term = |y: f64| -0.5 * (self.freedom + 1.0) * (1.0 + y * y / self.freedom).ln();
            turned(x).into_iter().map(term).sum()
        } else {
            let square: f64 = x.iter().map(|c| c * c).sum();
            -0.5 * (self.freedom + D as f64) * (1.0 + square / self.freedom).ln()
        }
    }

    fn score(&self, x: &[f64; D]) -> [f64; D] {
        if self.is_product {
            turned(&turned(x).map(|y| -(self.freedom + 1.0) * y / (self.freedom + y * y)))
        } else {
            let square: f64 = x.iter().map(|c| c * c).sum();
            x.map(|c| -(self.freedom + D as f64) * c / (self.freedom + square))
        }
    }
}

/// What runs of one law say.
fn report<const D: usize>(
    freedom: f64,
    is_product: bool,
    seeds: u64,
    particles: usize,
) -> Result<(), Box<dyn std::error::Error>> {
    let target = Tails { freedom, is_product };
    let truth = (freedom / (freedom - 2.0)).sqrt();
    let [mut claims, mut wrong, mut evaluations] = [0, 0, 0];
    let [mut of_pool, mut of_particles] = [const { Vec::new() }; 2];
    for seed in 0..seeds {
        let samples = MpmOptions::default().sample(
            &target,
            &Frame::<D>::identity(),
            &Run::new(particles, seed),
            &mut Silent,
        )?;
        let (Some(certificate), Some(pool)) = (&samples.certificate, &samples.pool) else {
            return Err("no pool".into());
        };
        let mut worst: f64 = 0.0;
        for axis in 0..D {
            let square = pool.expectation(|x| x[axis] * x[axis]).value;
            let own = samples.positions.iter().map(|x| x[axis] * x[axis]).sum::<f64>() / particles as f64;
            of_pool.push(square.sqrt() / truth - 1.0);
            of_particles.push(own.sqrt() / truth - 1.0);
            worst = worst.max((own.sqrt() / truth - 1.0).abs());
        }
        let is_claimed = certificate.outcome == Outcome::Converged;
        claims += u64::from(is_claimed);
        wrong += u64::from(is_claimed && worst > RIGHT);
        evaluations += samples.density_evaluations + samples.score_evaluations;
    }
    let law = if is_product { "product" } else { "radial" };
    let [pool, points] = [&mut of_pool, &mut of_particles].map(|errors| {
        errors.sort_by(f64::total_cmp);
        [0.1, 0.5, 0.9]
            .map(|share| format!("{:.3}", errors[((errors.len() - 1) as f64 * share) as usize]))
            .join(",")
    });
    println!(
        "{law},{D},{freedom},{claims},{wrong},{pool},{points},{}",
        evaluations / seeds
    );
    Ok(())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let seeds = arguments.next().map_or(Ok(20), |seeds| seeds.parse())?;
    let particles = arguments.next().map_or(Ok(1000), |particles| particles.parse())?;
    println!(
        "law,dimension,freedom,claims,wrong,pool_low,pool,pool_high,particles_low,particles,particles_high,evaluations"
    );
    for is_product in [false, true] {
        for freedom in [3.0, 5.0, 10.0] {
            report::<1>(freedom, is_product, seeds, particles)?;
            report::<2>(freedom, is_product, seeds, particles)?;
            report::<3>(freedom, is_product, seeds, particles)?;
            report::<4>(freedom, is_product, seeds, particles)?;
            report::<6>(freedom, is_product, seeds, particles)?;
        }
    }
    Ok(())
}
