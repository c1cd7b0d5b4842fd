//! Targets that are bent, long, thin or heavy.

use parvi::{Doubt, Method, MpmOptions, Outcome, Pool, Run, Samples, Silent, Start, sample};
use parvi_metrics::{Cloud, CloudMoments, EnergyReference, Standardiser};
use parvi_targets::{Banana, CatalogueTarget, Cross, Funnel, Moments, Ring, Rosenbrock};
use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;

const PARTICLES: usize = 600;

fn from_start<const D: usize>(target: &dyn CatalogueTarget<D>, (mean, sd): (f64, f64), seed: u64) -> Samples<D> {
    let options = MpmOptions {
        evaluations: Some(80 * PARTICLES as u64),
        ..MpmOptions::default()
    };
    let run = Run {
        start: Start {
            mean,
            standard_deviation: sd,
            ..Start::default()
        },
        ..Run::new(PARTICLES, seed)
    };
    sample(target, &Method::Mpm(options), &run, &mut Silent).expect("particles")
}

/// Exact draws, in units of their own covariance.
struct Draws<const D: usize> {
    standardiser: Standardiser<D>,
    reference: EnergyReference<D>,
}

impl<const D: usize> Draws<D> {
    fn of(target: &dyn CatalogueTarget<D>) -> Self {
        let mut generator = ChaCha8Rng::seed_from_u64(5);
        let exact = target.exact_draws().expect("exact draws");
        let draws: Vec<[f64; D]> = (0..8000).map(|_| exact.draw(&mut generator)).collect();
        let standardiser = Standardiser::whitening(&moments(&draws)).expect("a covariance");
        let draws = standardiser.points(&draws);
        let reference = EnergyReference::new(&Cloud::new(&draws).expect("finite")).expect("a reference");
        Self {
            standardiser,
            reference,
        }
    }

    /// ED² of particles over the expectation of as many independent draws.
    fn energy_ratio(&self, positions: &[[f64; D]]) -> f64 {
        let points = self.standardiser.points(positions);
        let squared = self.reference.squared(&Cloud::new(&points).expect("finite"));
        squared.expect("a distance") * positions.len() as f64 / self.reference.mean_distance()
    }
}

fn moments<const D: usize>(points: &[[f64; D]]) -> Moments<D> {
    CloudMoments::new(&Cloud::new(points).expect("finite"))
        .expect("moments")
        .moments()
}

const SEEDS: std::ops::Range<u64> = 2..6;

/// On these axes means within 0.05 standard deviations of the truth and standard deviations within `tolerance`, and an ED² below `ratio` of that of
/// independent draws, in the mean over the seeds: one run's tail is what its few farthest points make of it. From near and far, each run at a price below 110 evaluations per particle.
fn check<const D: usize>(target: &dyn CatalogueTarget<D>, axes: &[usize], tolerance: f64, ratio: f64) {
    let truth = target.moments().expect("moments");
    let draws = Draws::of(target);
    let share = 1.0 / SEEDS.count() as f64;
    for start in [(0.0, 1.0), (3.0, 0.1)] {
        let (mut shifts, mut widenings, mut reached) = ([0.0; D], [0.0; D], 0.0);
        for seed in SEEDS {
            let samples = from_start(target, start, seed);
            let found = moments(&samples.positions);
            for &axis in axes {
                let spread = truth.covariance.0[axis][axis].sqrt();
                shifts[axis] += share * (found.mean[axis] - truth.mean[axis]) / spread;
                widenings[axis] += share * (found.covariance.0[axis][axis].sqrt() / spread - 1.0);
            }
            reached += share * draws.energy_ratio(&samples.positions);
            let price = (samples.score_evaluations + samples.density_evaluations) as f64 / PARTICLES as f64;
            assert!(price < 110.0, "{} {start:?}: {price}", target.name());
        }
        let name = target.name();
        assert!(
            shifts.iter().all(|shift| shift.abs() < 0.05),
            "{name} {start:?}: {shifts:?}"
        );
        assert!(
            widenings.iter().all(|widening| widening.abs() < tolerance),
            "{name} {start:?}: {widenings:?}"
        );
        assert!(reached < ratio, "{name} {start:?}: {reached}");
    }
}

#[test]
fn funnels_are_better_than_independent_draws() {
    // The other axes have tails whose moments 600 points do not hold.
    check(&Funnel::<4>::new(1.5).expect("a width"), &[0], 0.05, 0.4);
}

#[test]
fn rosenbrock_chains_are_better_than_independent_draws() {
    // x₃ ~ N(x₂², 0.3²) has a fourth power of x₁ in it: its standard deviation over 600 points is 16 % small in the mean of twenty seeds.
    check(&Rosenbrock::<4>::new(1.0, 0.3).expect("scales"), &[0, 1, 3], 0.12, 0.4);
}

#[test]
fn a_long_thin_banana_is_filled() {
    // x₂ is the square of a normal variable and more, whose tail 600 points cut off.
    check(&Banana::new(2.0, 0.2).expect("scales"), &[0, 1], 0.12, 0.2);
}

#[test]
fn a_ring_has_its_centre_in_the_middle() {
    let target = Ring::new(2.0, 0.2).expect("radii");
    for start in [(0.0, 1.0), (3.0, 0.1)] {
        let samples = from_start(&target, start, 2);
        let found = moments(&samples.positions);
        assert!(found.mean.iter().all(|c| c.abs() < 0.05), "{start:?}: {:?}", found.mean);
    }
}

#[test]
fn a_cross_is_better_than_independent_draws() {
    let target = Cross::<3>::new(2.0, 0.2).expect("scales");
    let samples = from_start(&target, (0.0, 1.0), 2);
    let reached = Draws::of(&target).energy_ratio(&samples.positions);
    assert!(reached < 0.5, "{reached}");
}

/// The pool of 1,000 particles, and why they are not vouched for.
fn of_parabola_over_parabola(width: f64, seed: u64) -> (Rosenbrock<3>, Pool<3>, Option<Doubt>) {
    let target = Rosenbrock::new(1.0, width).expect("scales");
    let samples = MpmOptions::default()
        .sample(&target, &target.frame(), &Run::new(1000, seed), &mut Silent)
        .expect("particles");
    let doubt = match samples.certificate.expect("a certificate").outcome {
        Outcome::Stalled(doubt) => Some(doubt),
        _ => None,
    };
    (target, *samples.pool.expect("a pool"), doubt)
}

/// The standard deviation of x₃ by the pool, and its stated error, over the truth.
fn of_last(target: &Rosenbrock<3>, pool: &Pool<3>) -> (f64, f64) {
    let truth = target.moments().expect("a closed form").covariance.0[2][2].sqrt();
    let (deviation, error) = pool.marginals()[2].deviation();
    (deviation / truth, error / truth)
}

/// The first pools have standard deviations a fifth too low, by few points: what is left of the evaluations follows these.
#[test]
fn a_tail_that_hangs_on_few_points_is_followed() {
    for seed in [8, 9] {
        let (target, pool, _) = of_parabola_over_parabola(0.3, seed);
        let (deviation, _) = of_last(&target, &pool);
        assert!((deviation - 1.0).abs() < 0.05, "{seed}: {deviation}");
    }
}

/// Where the parabolas are so thin that all evaluations do not suffice the standard deviation is more than a tenth low, and its stated error may be less than 4 %.
#[test]
fn a_tail_of_which_few_points_are_known_is_not_vouched_for() {
    let stated = [12, 17].map(|seed| {
        let (target, pool, doubt) = of_parabola_over_parabola(0.05, seed);
        let (deviation, stated) = of_last(&target, &pool);
        assert!(deviation < 0.9, "{seed}: {deviation} ± {stated}");
        let doubt = doubt.expect("a doubt").to_string();
        assert!(doubt.contains("x3 hangs on few points"), "{seed}: {doubt}");
        stated
    });
    assert!(stated.iter().any(|&stated| stated < 0.04), "{stated:?}");
}
