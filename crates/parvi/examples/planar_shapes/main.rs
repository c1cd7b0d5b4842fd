//! Fifteen shapes of the plane and products of two and three of them, turned by random rotations: how far particles are from the target, what they cost, and whether
//! `converged` is right. `cargo run --release --example planar_shapes -p parvi [-- FIRST_SEED SEEDS PARTICLES]`.
//!
//! Shapes are ridges, rings, flat tops, spirals, cusps, tails, needles and lattices of modes, the thinnest a fiftieth as wide as the frame, which is the identity. ED² is the squared energy distance
//! from 16,384 exact draws, over its expectation for as many independent draws as there are particles.

#![allow(clippy::print_stdout)]

mod plane;
mod shapes;

use std::error::Error;

use mpm_tensor::Matrix;
use parvi::{MpmOptions, Outcome, Run, Silent};
use parvi_metrics::{Cloud, EnergyReference};
use parvi_targets::{Frame, Target, normal_quantile};
use rand::{RngExt, SeedableRng, rngs::ChaCha8Rng};

use plane::Plane;

const DRAWS: usize = 16_384;

/// Above it particles are farther from the target than independent draws.
const FAR: f64 = 1.0;

/// Planes side by side, turned: p(x) = Π_k f_k(z_2k, z_2k+1), z = Qᵀ x.
struct Product<'a, const D: usize> {
    planes: Vec<&'a Plane>,
    rotation: Matrix<D>,
}

impl<const D: usize> Product<'_, D> {
    fn draw(&self, rng: &mut ChaCha8Rng) -> [f64; D] {
        let mut z = [0.0; D];
        for (z, plane) in z.chunks_mut(2).zip(&self.planes) {
            z.copy_from_slice(&plane.draw(rng));
        }
        self.rotation.apply(&z)
    }
}

impl<const D: usize> Target<D> for Product<'_, D> {
    fn log_density(&self, x: &[f64; D]) -> f64 {
        let z = self.rotation.transpose().apply(x);
        let factors = self.planes.iter().zip(z.as_chunks().0);
        factors.map(|(plane, &z)| plane.log_density(z)).sum()
    }

    fn score(&self, x: &[f64; D]) -> [f64; D] {
        let mut z = self.rotation.transpose().apply(x);
        for (z, plane) in z.as_chunks_mut().0.iter_mut().zip(&self.planes) {
            *z = plane.score(*z);
        }
        self.rotation.apply(&z)
    }
}

/// ED², evaluations per particle, and whether the run claims.
type Reached = (f64, f64, bool);

/// A run on the product of these planes; prints its line.
fn run<const D: usize>(planes: Vec<&Plane>, seed: u64, particles: usize) -> Result<Reached, Box<dyn Error>> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut normal = || normal_quantile(rng.random_range(1e-12..1.0));
    let rotation = Matrix::orthogonal(1e-6, || std::array::from_fn(|_| normal()));
    let name: Vec<&str> = planes.iter().map(|plane| plane.name).collect();
    let log_evidence: f64 = planes.iter().map(|plane| plane.log_evidence).sum();
    let target = Product::<D> { planes, rotation };
    let draws: Vec<[f64; D]> = (0..DRAWS).map(|_| target.draw(&mut rng)).collect();
    let reference = EnergyReference::new(&Cloud::new(&draws)?)?;
    let run = Run::new(particles, seed);
    let samples = MpmOptions::default().sample(&target, &Frame::identity(), &run, &mut Silent)?;
    let count = particles as f64;
    let distance = reference.squared(&Cloud::new(&samples.positions)?)? * count / reference.mean_distance();
    let evaluations = (samples.density_evaluations + samples.score_evaluations) as f64 / count;
    let outcome = samples.certificate.ok_or("no certificate")?.outcome;
    let (found, error) = samples.log_evidence.zip(samples.log_evidence_error).ok_or("no log Z")?;
    println!(
        "{D},{},{seed},{distance:.3},{evaluations:.1},{:.4},{error:.4},{outcome},\"{}\"",
        name.join(" "),
        found - log_evidence,
        outcome.reason().unwrap_or_default()
    );
    Ok((distance, evaluations, outcome == Outcome::Converged))
}

/// Runs of one dimension: median and worst of ED², of evaluations per particle, and claims.
fn summary(dimension: usize, mut runs: Vec<Reached>) -> String {
    let claims = runs.iter().filter(|(_, _, is_claimed)| *is_claimed).count();
    let wrong = runs.iter().filter(|(far, _, is_claimed)| *is_claimed && *far > FAR);
    let wrong = wrong.count();
    let mut of = |by: fn(&Reached) -> f64| {
        runs.sort_by(|one, other| by(one).total_cmp(&by(other)));
        [runs.len() / 2, runs.len() - 1].map(|rank| by(&runs[rank]))
    };
    let ([far, farthest], [evaluations, most]) = (of(|run| run.0), of(|run| run.1));
    format!(
        "d = {dimension}: ED² {far:.3} in the median, {farthest:.3} at most; {evaluations:.0} evaluations per particle, {most:.0} at most; {claims} of {} claimed, {wrong} wrongly",
        runs.len()
    )
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let mut number = |default: u64| arguments.next().map_or(Ok(default), |text| text.parse());
    let [first, seeds, particles] = [number(0)?, number(2)?, number(500)?];
    let particles = usize::try_from(particles)?;
    let planes: Vec<Plane> = shapes::all().into_iter().map(Plane::new).collect();
    println!(
        "dimension,shapes,seed,energy_distance,evaluations,log_evidence_deviation,log_evidence_error,outcome,reason"
    );
    let [mut plane, mut space, mut six] = [const { Vec::new() }; 3];
    for seed in first..first + seeds {
        for index in 0..planes.len() {
            // A shape with itself, then with others.
            let other = |step: u64| &planes[(index + (step * (seed - first)) as usize) % planes.len()];
            let [a, b, c] = [0, 4, 7].map(other);
            plane.push(run::<2>(vec![a], seed, particles)?);
            space.push(run::<4>(vec![a, b], seed, particles)?);
            six.push(run::<6>(vec![a, b, c], seed, particles)?);
        }
    }
    for (dimension, runs) in [(2, plane), (4, space), (6, six)] {
        println!("{}", summary(dimension, runs));
    }
    Ok(())
}
