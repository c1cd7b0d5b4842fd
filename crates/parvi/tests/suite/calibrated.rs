//! What the calibrated sampler must reach.

use mpm_tensor::vector;
use parvi::{
    BasisChoice, Method, MomentCorrection, MpmOptions, Run, Samples, ScoreLocation, Settling, Silent, Start,
    StartDraws, TransferChoice, sample,
};
use parvi_metrics::{Cloud, GaussianEnergy};
use parvi_targets::{CatalogueTarget, Gaussian};

use crate::support::{assert_correlated, body_alone};

fn mpm<const D: usize>(target: &dyn CatalogueTarget<D>, options: MpmOptions, run: &Run) -> Samples<D> {
    sample(target, &Method::Mpm(options), run, &mut Silent).expect("a run that ends well")
}

/// ED².
fn squared(energy: &GaussianEnergy<2>, samples: &Samples<2>) -> f64 {
    let cloud = Cloud::new(&samples.positions).expect("finite particles");
    energy.squared(&cloud).expect("ED²")
}

#[test]
fn energy_distance_is_a_small_share_of_the_independent_one() {
    let target = Gaussian::<2>::standard();
    let energy = GaussianEnergy::<2>::standard().expect("a Gaussian");
    let mut residual = 0.0;
    for seed in 1..=5 {
        let samples = mpm(&target, body_alone(), &Run::new(512, seed));
        let squared = squared(&energy, &samples);
        // Independent draws: 1.772 / 512 = 3.5e-3 on average.
        // Scrambled Sobol points: 0.156e-3.
        assert!(squared <= 0.15e-3, "seed {seed}: ED² = {squared}");
        assert!(samples.score_evaluations <= 100 * 512);
        residual += samples.residual.expect("a residual") / 5.0;
    }
    assert!(residual < 0.6, "{residual}");
}

#[test]
fn bases_transfers_and_score_locations_all_converge() {
    let target = Gaussian::<2>::standard();
    let energy = GaussianEnergy::<2>::standard().expect("a Gaussian");
    let bases = [
        BasisChoice::Lattice,
        BasisChoice::Linear,
        BasisChoice::Quadratic,
        BasisChoice::Cubic,
    ];
    for basis in bases {
        for transfer in [TransferChoice::Pic, TransferChoice::Apic, TransferChoice::Flip(0.9)] {
            let options = MpmOptions {
                basis,
                transfer,
                ..body_alone()
            };
            let samples = mpm(&target, options, &Run::new(512, 2));
            let squared = squared(&energy, &samples);
            assert!(squared <= 0.4e-3, "{basis:?}, {transfer:?}: {squared}");
        }
    }
    // At the nodes the covariance shrinks by the kernel's variance; the correction repairs it.
    let at_nodes = MpmOptions {
        score_location: ScoreLocation::Nodes,
        moment_correction: MomentCorrection::Affine,
        ..body_alone()
    };
    let samples = mpm(&target, at_nodes, &Run::new(512, 2));
    let squared = squared(&energy, &samples);
    assert!(squared <= 1e-3, "score at nodes: {squared}");
}

#[test]
fn far_and_narrow_starts_arrive() {
    let target = Gaussian::<2>::autoregressive(0.5).expect("a correlation below one");
    let energy = GaussianEnergy::new([0.0; 2], &target.frame().covariance()).expect("a Gaussian");
    for (mean, standard_deviation) in [(0.7, 0.6), (5.0, 0.5), (0.0, 0.1)] {
        let run = Run {
            start: Start {
                mean,
                standard_deviation,
                ..Start::default()
            },
            ..Run::new(512, 3)
        };
        let samples = mpm(&target, body_alone(), &run);
        let squared = squared(&energy, &samples);
        assert!(
            squared <= 0.5e-3,
            "start {mean} ± {standard_deviation}: ED² = {squared}"
        );
    }
}

#[test]
fn covariance_at_rest_without_shifts_and_correction() {
    let target = Gaussian::<2>::standard();
    for seed in 0..4 {
        let options = MpmOptions {
            shifts: false,
            moment_correction: MomentCorrection::Off,
            basis: BasisChoice::Quadratic,
            spacing: Some(1.2),
            steps: Some(400),
            ..body_alone()
        };
        let samples = mpm(&target, options, &Run::new(1000, seed));
        assert_correlated(&samples.positions, 0.0, 1e-3, &seed);
    }
}

#[test]
fn the_trace_has_the_steps_asked_for() {
    let target = Gaussian::<2>::standard();
    let options = MpmOptions {
        trace_every: 10,
        steps: Some(40),
        ..body_alone()
    };
    let samples = mpm(&target, options, &Run::new(300, 1));
    let steps: Vec<usize> = samples.trace.iter().map(|point| point.step).collect();
    assert_eq!(steps, [1, 10, 20, 30, 40]);
    assert!(
        samples
            .trace
            .iter()
            .all(|point| point.residual.is_some_and(f64::is_finite))
    );
    let (first, last) = (samples.trace[0], samples.trace[4]);
    assert!(last.residual < first.residual, "the residual falls");
    assert!(last.kinetic_energy < first.kinetic_energy, "the cloud comes to rest");
}

#[test]
fn the_residual_does_not_depend_on_the_trace() {
    let target = Gaussian::<2>::standard();
    for (basis, shifts) in [(BasisChoice::Lattice, true), (BasisChoice::Quadratic, false)] {
        let residual = |trace_every| {
            let options = MpmOptions {
                basis,
                shifts,
                trace_every,
                steps: Some(20),
                ..MpmOptions::default()
            };
            let samples = mpm(&target, options, &Run::new(400, 4));
            samples.residual.expect("a residual")
        };
        let plain = residual(0);
        for trace_every in [3, 10] {
            assert!((residual(trace_every) / plain - 1.0).abs() < 1e-12, "{basis:?}");
        }
    }
}

#[test]
fn without_shifts_the_body_moves_far_less() {
    let target = Gaussian::<2>::standard();
    let spread = |shifts| {
        // Hat functions leave a tremor on any one lattice (docs/theory.md, section 8); quadratic splines do not.
        let options = |steps| MpmOptions {
            survey: false,
            basis: BasisChoice::Quadratic,
            shifts,
            steps: Some(steps),
            settling: Settling {
                share: 0.0,
                ..Settling::default()
            },
            moment_correction: MomentCorrection::Off,
            ..MpmOptions::default()
        };
        let run = Run::new(300, 5);
        let (one, other) = (mpm(&target, options(1000), &run), mpm(&target, options(1001), &run));
        let pairs = one.positions.iter().zip(&other.positions);
        pairs.map(|(a, b)| vector::distance(a, b)).fold(0.0, f64::max)
    };
    let (resting, moving) = (spread(false), spread(true));
    assert!(resting < 0.3 * moving, "{resting} with one lattice, {moving} with many");
}

#[test]
fn quasi_random_starts_have_the_moments_asked_for_and_are_not_the_yardstick() {
    let target = Gaussian::<3>::standard();
    let at = |draws| {
        let options = MpmOptions {
            steps: Some(1),
            time_step: Some(1e-9),
            moment_correction: MomentCorrection::Off,
            ..body_alone()
        };
        let start = Start {
            mean: 2.0,
            standard_deviation: 0.5,
            draws,
        };
        let run = Run {
            start,
            ..Run::new(1024, 8)
        };
        mpm(&target, options, &run).positions
    };
    let quiet = at(StartDraws::QuasiRandom);
    for axis in 0..3 {
        let mean = quiet.iter().map(|x| x[axis]).sum::<f64>() / 1024.0;
        let variance = quiet.iter().map(|x| (x[axis] - mean).powi(2)).sum::<f64>() / 1024.0;
        assert!(
            (mean - 2.0).abs() < 1e-2 && (variance - 0.25).abs() < 5e-3,
            "{mean}, {variance}"
        );
    }
    assert_ne!(quiet, at(StartDraws::Independent));
    let yardstick = sample(&target, &Method::Sobol, &Run::new(1024, 8), &mut Silent).expect("points");
    let same = |x: &[f64; 3], y: &[f64; 3]| (0..3).all(|a| (x[a] - 2.0 - 0.5 * y[a]).abs() < 1e-6);
    assert!(!quiet.iter().zip(&yardstick.positions).any(|(x, y)| same(x, y)));
}
