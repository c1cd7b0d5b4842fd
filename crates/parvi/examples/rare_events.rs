//! How far stated errors of probabilities can be trusted, by what carries them: `cargo run --release --example rare_events -p parvi [-- SEEDS]`.
//!
//! P(x > c) for c of which it is 0.1 to 10⁻⁵, of N(0, 1) and of a t law with ν = 3, by the pools and, with `parvi::expectation`, by the particles of the runs that say `converged`. All
//! estimates together by their `carriers` (of particles: how many meet the event): how many there are, the mean of the estimate over the truth, the root of the mean square of its error over the
//! stated one, and the share that is off by more than three stated errors, all of those of 0 ± 0 included.

#![allow(clippy::print_stdout)]

use parvi::{MpmOptions, Outcome, Run, Samples, Silent};
use parvi_targets::{Frame, Gaussian, StudentT, Target, TargetError, normal_quantile};

/// Where classes of carriers begin.
const CLASSES: [f64; 8] = [0.0, 1e-9, 10.0, 50.0, 100.0, 200.0, 500.0, 1000.0];

/// What one run says of an event.
struct Said {
    /// Over the truth.
    ratio: f64,
    /// Error over the stated one.
    off: f64,
    carriers: f64,
}

impl Said {
    fn new(truth: f64, value: f64, error: f64, carriers: f64) -> Self {
        Self {
            ratio: value / truth,
            off: (value - truth) / error,
            carriers,
        }
    }
}

/// A law in one dimension and the place above which it has a probability.
struct Law {
    name: &'static str,
    target: Box<dyn Target<1>>,
    cut: fn(f64) -> f64,
}

/// What the pools and the particles of converged runs say of all events.
fn said(law: &Law, seeds: u64) -> Result<[Vec<Said>; 2], Box<dyn std::error::Error>> {
    let (mut by_pool, mut by_particles) = (Vec::new(), Vec::new());
    let target = law.target.as_ref();
    for (particles, seed) in [200, 2000]
        .into_iter()
        .flat_map(|particles| (0..seeds).map(move |seed| (particles, seed)))
    {
        let samples =
            MpmOptions::default().sample(target, &Frame::identity(), &Run::new(particles, seed), &mut Silent)?;
        if !converged(&samples) {
            continue;
        }
        for power in 2..=10 {
            let truth = 10_f64.powf(-0.5 * f64::from(power));
            let cut = (law.cut)(truth);
            let event = |x: &[f64; 1]| f64::from(u8::from(x[0] > cut));
            if let Some(pool) = &samples.pool {
                let found = pool.expectation(event);
                by_pool.push(Said::new(truth, found.value, found.standard_error, found.carriers));
            }
            if let Some(found) = parvi::expectation(target, &samples, event) {
                let met = samples.positions.iter().map(event).sum();
                by_particles.push(Said::new(truth, found.average, found.standard_error, met));
            }
        }
    }
    Ok([by_pool, by_particles])
}

fn converged(samples: &Samples<1>) -> bool {
    let certificate = samples.certificate.as_ref();
    certificate.is_some_and(|certificate| certificate.outcome == Outcome::Converged)
}

fn table(name: &str, said: &[Said]) {
    for (index, from) in CLASSES.iter().enumerate() {
        let below = CLASSES.get(index + 1).copied().unwrap_or(f64::INFINITY);
        let here: Vec<&Said> = said
            .iter()
            .filter(|said| (*from..below).contains(&said.carriers))
            .collect();
        if here.is_empty() {
            continue;
        }
        let count = here.len() as f64;
        let mean = |of: &dyn Fn(&Said) -> f64| here.iter().map(|said| of(said)).sum::<f64>() / count;
        let square = mean(&|said| said.off * said.off).sqrt();
        let far = mean(&|said| f64::from(u8::from(said.off.abs() > 3.0)));
        println!(
            "{name},{from},{},{:.3},{square:.2},{far:.3}",
            here.len(),
            mean(&|said| said.ratio)
        );
    }
}

/// c with P(x > c) = p of a t law with ν = 3, by bisection of its distribution function.
fn cut_of_t(p: f64) -> f64 {
    let above = |c: f64| {
        let t = c / 3_f64.sqrt();
        0.5 - (t.atan() + t / (1.0 + t * t)) / std::f64::consts::PI
    };
    let (mut low, mut high) = (0.0, 1e4);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if above(middle) > p {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

fn laws() -> Result<[Law; 2], TargetError> {
    Ok([
        Law {
            name: "normal",
            target: Box::new(Gaussian::<1>::standard()),
            cut: |p| -normal_quantile(p),
        },
        Law {
            name: "t3",
            target: Box::new(StudentT::<1>::new(3.0)?),
            cut: cut_of_t,
        },
    ])
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let seeds = std::env::args().nth(1).map_or(Ok(100), |seeds| seeds.parse())?;
    println!("estimate,carriers_from,estimates,ratio,error_over_stated,beyond_three");
    for law in laws()? {
        let [by_pool, by_particles] = said(&law, seeds)?;
        table(&format!("{} pool", law.name), &by_pool);
        table(&format!("{} particles", law.name), &by_particles);
    }
    Ok(())
}
