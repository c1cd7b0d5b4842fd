//! How far what pools say of a target is off, and how far they say it is: `cargo run --release --example stated_errors -p parvi [-- FIRST_SEED SEEDS PARTICLES]`.
//!
//! Of every coordinate the mean, the variance and the probabilities of being below the quantiles 0.1, 0.5 and 0.9, of runs that say `converged`; truth by 262,144 quasi-random points. On random targets runs whose log Z is
//! more than 0.1 off have missed a piece, and are counted but not judged.

#![allow(clippy::print_stdout)]

use parvi::{MpmOptions, Outcome, Run, Silent};
use parvi_targets::{Banana, CatalogueTarget, Frame, RandomTarget, Rosenbrock, SobolSequence};

const REFERENCE: u32 = 1 << 18;

/// What runs on one family of targets say.
#[derive(Default)]
struct Family {
    runs: usize,
    claims: usize,
    missed: usize,
    /// Evaluations per particle.
    evaluations: Vec<f64>,
    /// Errors of means in standard deviations, and of variances over these.
    means: Vec<f64>,
    variances: Vec<f64>,
    /// All errors over the stated ones.
    ratios: Vec<f64>,
}

impl Family {
    fn add<const D: usize>(
        &mut self,
        target: &dyn CatalogueTarget<D>,
        run: &Run,
    ) -> Result<(), Box<dyn std::error::Error>> {
        let samples = MpmOptions::default().sample(target, &Frame::identity(), run, &mut Silent)?;
        let evaluations = samples.density_evaluations + samples.score_evaluations;
        self.runs += 1;
        self.evaluations.push(evaluations as f64 / run.particles as f64);
        let certificate = samples.certificate.as_ref();
        let Some(pool) = samples
            .pool
            .filter(|_| certificate.is_some_and(|found| found.outcome == Outcome::Converged))
        else {
            return Ok(());
        };
        self.claims += 1;
        if target
            .log_evidence()
            .is_some_and(|truth| (pool.log_evidence - truth).abs() > 0.1)
        {
            self.missed += 1;
            return Ok(());
        }
        let cube = target.unit_cube_transport().ok_or("no map from the unit cube")?;
        let sequence = SobolSequence::scrambled(cube.cube_dimension(), 7)?;
        let points: Vec<[f64; D]> = (0..REFERENCE).map(|k| cube.transport(&sequence.point(k))).collect();
        for axis in 0..D {
            let mut places: Vec<f64> = points.iter().map(|x| x[axis]).collect();
            places.sort_by(f64::total_cmp);
            let average = |f: &dyn Fn(f64) -> f64| places.iter().map(|&t| f(t)).sum::<f64>() / f64::from(REFERENCE);
            let mut compare = |f: &dyn Fn(f64) -> f64| {
                let (found, truth) = (pool.expectation(|x| f(x[axis])), average(f));
                self.ratios.push((found.value - truth) / found.standard_error);
                found.value - truth
            };
            let mean = average(&|t| t);
            let square = |t: f64| (t - mean).powi(2);
            let variance = average(&square);
            self.means.push(compare(&|t| t) / variance.sqrt());
            self.variances.push(compare(&square) / variance);
            for probability in [0.1, 0.5, 0.9] {
                let cut = places[(probability * f64::from(REFERENCE)) as usize];
                compare(&|t| f64::from(u8::from(t < cut)));
            }
        }
        Ok(())
    }

    fn print(&mut self, name: &str) {
        let root_mean_square = |of: &[f64]| (of.iter().map(|e| e * e).sum::<f64>() / of.len() as f64).sqrt();
        let within = |limit: f64| {
            let count = self.ratios.iter().filter(|ratio| ratio.abs() <= limit).count();
            100.0 * count as f64 / self.ratios.len() as f64
        };
        self.evaluations.sort_by(f64::total_cmp);
        println!(
            "{name},{},{},{},{:.1},{:.5},{:.5},{:.0},{:.0},{:.0}",
            self.runs,
            self.claims,
            self.missed,
            self.evaluations.get(self.runs / 2).unwrap_or(&f64::NAN),
            root_mean_square(&self.means),
            root_mean_square(&self.variances),
            within(1.0),
            within(2.0),
            within(3.0)
        );
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let mut number = |default: u64| arguments.next().map_or(Ok(default), |text| text.parse());
    let (first, seeds, particles) = (number(0)?, number(20)?, number(1000)? as usize);
    let mut families: [(&str, Family); 8] = [
        "banana d=2",
        "rosenbrock d=2",
        "rosenbrock d=3",
        "random d=1",
        "random d=2",
        "random d=3",
        "random d=4",
        "random d=6",
    ]
    .map(|name| (name, Family::default()));
    for seed in first..first + seeds {
        let run = Run::new(particles, seed);
        let [banana, plane, space, one, two, three, four, six] = families.each_mut().map(|(_, family)| family);
        banana.add(&Banana::new(1.0, 0.5)?, &run)?;
        plane.add(&Rosenbrock::<2>::new(1.0, 0.1)?, &run)?;
        space.add(&Rosenbrock::<3>::new(1.0, 0.1)?, &run)?;
        one.add(&RandomTarget::<1>::new(seed)?, &run)?;
        two.add(&RandomTarget::<2>::new(seed)?, &run)?;
        three.add(&RandomTarget::<3>::new(seed)?, &run)?;
        four.add(&RandomTarget::<4>::new(seed)?, &run)?;
        six.add(&RandomTarget::<6>::new(seed)?, &run)?;
    }
    println!(
        "target,runs,claimed,of which missed a piece,evaluations per particle,error of means,error of variances,within 1,2,3 stated errors (%)"
    );
    for (name, family) in &mut families {
        family.print(name);
    }
    Ok(())
}
