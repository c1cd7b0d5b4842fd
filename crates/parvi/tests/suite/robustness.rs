//! What goes wrong on the way: scores that are not finite, energies that explode, processes that are killed, starts too far away.

use std::ops::ControlFlow;

use parvi::certificate::{Doubt, EstimatedMoment, MomentEstimate};
use parvi::{
    Annealing, Checkpoint, MpmOptions, NonFiniteScores, Observer, Outcome, ParticleView, Progress, Run, SampleError,
    Samples, ScoreLocation, Silent, Start, TransferChoice, expectation,
};
use parvi_targets::{CatalogueTarget, Frame, Gaussian, GaussianMixture, Target};

use crate::support::{Hiccup, Walled, body_alone};

fn from(mean: f64, standard_deviation: f64) -> Run {
    let mut run = Run::new(300, 5);
    run.start = Start {
        mean,
        standard_deviation,
        ..Start::default()
    };
    run
}

fn sample(options: &MpmOptions, target: &dyn Target<2>, run: &Run) -> Result<Samples<2>, SampleError> {
    options.sample(target, &Frame::identity(), run, &mut Silent)
}

#[test]
fn a_particle_without_a_score_is_pulled_back() {
    let samples = sample(&body_alone(), &Walled, &from(1.0, 1.5)).expect("particles");
    assert!(samples.scores_replaced > 0);
    assert!(samples.positions.iter().all(|x| x[0] <= 3.0));
    let mean = samples.positions.iter().map(|x| x[0]).sum::<f64>() / 300.0;
    assert!(mean.abs() < 0.02, "{mean}");
}

/// Without mass anywhere, and as good a score as any.
struct Nowhere;

impl Target<2> for Nowhere {
    fn log_density(&self, _: &[f64; 2]) -> f64 {
        f64::NEG_INFINITY
    }

    fn score(&self, _: &[f64; 2]) -> [f64; 2] {
        [0.0; 2]
    }
}

#[test]
fn where_neither_survey_nor_body_find_mass_there_are_no_particles() {
    let error = sample(&MpmOptions::default(), &Nowhere, &Run::new(100, 1)).expect_err("nothing");
    assert!(error.to_string().contains("log p was -inf"), "{error}");
}

#[test]
fn a_particle_without_a_score_is_reported_where_that_is_asked_for() {
    let options = MpmOptions {
        non_finite_scores: NonFiniteScores::Report,
        ..body_alone()
    };
    let error = sample(&options, &Walled, &from(1.0, 1.5)).expect_err("a wall in the way");
    assert!(matches!(error, SampleError::ScoreNotFinite { step: 1, .. }), "{error}");
    // There is no good state to go back to.
    let options = MpmOptions {
        non_finite_scores: NonFiniteScores::RejectStep,
        ..body_alone()
    };
    assert!(matches!(
        sample(&options, &Walled, &from(1.0, 1.5)),
        Err(SampleError::ScoreNotFinite { step: 1, .. })
    ));
}

#[test]
fn rejected_steps_are_made_again() {
    let options = MpmOptions {
        non_finite_scores: NonFiniteScores::RejectStep,
        ..body_alone()
    };
    let target = Hiccup::of(f64::INFINITY);
    let samples = sample(&options, &target, &from(0.0, 1.0)).expect("particles");
    assert_eq!(samples.steps, 97);
    assert!(samples.score_evaluations > 97 * 300, "steps 17 to 21 were made twice");
    assert!(samples.residual.is_some_and(|residual| residual < 0.8));
}

#[test]
fn an_energy_that_explodes_is_taken_back() {
    // FLIP keeps what it cannot resolve; with steps far too long it has nowhere to put it.
    let options = MpmOptions {
        transfer: TransferChoice::Flip(1.0),
        time_step: Some(20.0),
        friction: Some(0.0),
        ..body_alone()
    };
    match sample(&options, &Gaussian::<2>::standard(), &from(0.0, 1.0)) {
        Ok(samples) => {
            assert!(samples.score_evaluations > 110 * 300, "no step was taken back");
            assert!(samples.positions.as_flattened().iter().all(|c| c.abs() < 1e3));
        }
        Err(error) => assert!(matches!(error, SampleError::Diverged { .. }), "{error}"),
    }
}

#[test]
fn particles_on_their_way_get_more_rounds() {
    let target = Gaussian::<2>::standard();
    let far = from(400.0, 0.1);
    let one = MpmOptions {
        rounds: Some(1),
        ..body_alone()
    };
    let stopped = sample(&one, &target, &far)
        .expect("particles")
        .certificate
        .expect("a certificate");
    assert!(
        matches!(stopped.outcome, Outcome::BudgetExhausted { .. }),
        "{:?}",
        stopped.outcome
    );
    let more = sample(&body_alone(), &target, &far).expect("particles");
    assert!(more.steps > 97);
    assert!(more.certificate.expect("a certificate").drift < stopped.drift);
}

#[test]
fn convergence_is_claimed_with_a_survey_only() {
    let target = Gaussian::<2>::standard();
    let run = from(0.0, 1.0);
    let surveyed = sample(&MpmOptions::default(), &target, &run).expect("particles");
    let certificate = surveyed.certificate.as_ref().expect("a certificate");
    assert_eq!(certificate.outcome, Outcome::Converged);
    assert!(certificate.mean_error().is_some_and(|error| error < 0.02));
    let square = expectation(&target, &surveyed, |x| x[0] * x[0]).expect("an expectation");
    assert!((square.estimate - 1.0).abs() < 1e-9);
    let blind = sample(&body_alone(), &target, &run)
        .expect("particles")
        .certificate
        .expect("a certificate");
    assert_eq!(blind.outcome, Outcome::Stalled(Doubt::NotSurveyed));
}

#[test]
fn one_mode_of_two_is_not_called_converged() {
    let target = GaussianMixture::<2>::two_unequal(0.5).expect("a mixture");
    let certificate = sample(&body_alone(), &target, &from(1.5, 0.3))
        .expect("particles")
        .certificate;
    assert_ne!(certificate.expect("a certificate").outcome, Outcome::Converged);
}

#[test]
fn annealing_ends_at_the_target() {
    let options = MpmOptions {
        annealing: Annealing::Geometric { from: 0.1, to: 1.0 },
        ..MpmOptions::default()
    };
    let samples = sample(&options, &Gaussian::<2>::standard(), &from(0.0, 1.0)).expect("particles");
    assert_eq!(samples.certificate.expect("a certificate").outcome, Outcome::Converged);
    let options = MpmOptions {
        annealing: Annealing::Constant { alpha: -1.0 },
        ..MpmOptions::default()
    };
    assert!(matches!(
        sample(&options, &Gaussian::<2>::standard(), &from(0.0, 1.0)),
        Err(SampleError::InvalidOption { field: "alpha", .. })
    ));
}

/// Stops after so many steps in all.
pub struct Killer(pub usize);

impl Observer for Killer {
    fn after_step(&mut self, _: Progress) -> ControlFlow<()> {
        self.0 -= 1;
        if self.0 == 0 {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }
}

fn in_a_directory(every: usize) -> (tempfile::TempDir, MpmOptions) {
    let directory = tempfile::tempdir().expect("a directory");
    let options = MpmOptions {
        checkpoint: Some(Checkpoint {
            path: directory.path().join("run.checkpoint"),
            every,
        }),
        ..MpmOptions::default()
    };
    (directory, options)
}

#[test]
fn a_run_that_was_stopped_anywhere_ends_with_the_same_bits() {
    let target = GaussianMixture::<2>::two_unequal(0.5).expect("a mixture");
    let run = from(0.0, 1.0);
    for transfer in [TransferChoice::Pic, TransferChoice::Apic] {
        let whole = MpmOptions {
            transfer,
            steps: Some(40),
            rounds: Some(2),
            ..MpmOptions::default()
        };
        let expected = sample(&whole, &target, &run).expect("particles");
        for stops in [vec![1], vec![2], vec![30], vec![1, 40, 7], vec![3, 1, 1, 20]] {
            let (_directory, options) = in_a_directory(8);
            let options = MpmOptions {
                checkpoint: options.checkpoint,
                ..whole.clone()
            };
            for &stop in &stops {
                let stopped = options.sample(&target, &Frame::identity(), &run, &mut Killer(stop));
                assert!(matches!(stopped, Err(SampleError::Interrupted { .. })), "{stops:?}");
            }
            let resumed = sample(&options, &target, &run).expect("particles");
            assert_eq!(resumed.positions, expected.positions, "{stops:?}");
            assert_eq!(resumed.score_evaluations, expected.score_evaluations, "{stops:?}");
            assert_eq!(resumed.certificate, expected.certificate, "{stops:?}");
            let checkpoint = options.checkpoint.as_ref().expect("a checkpoint");
            assert!(checkpoint.path.exists(), "it stays until what the run gave is safe");
            checkpoint.remove().expect("removed");
            assert!(!checkpoint.path.exists());
            checkpoint.remove().expect("nothing is there to remove");
        }
    }
}

#[test]
fn the_checkpoint_of_a_finished_run_gives_the_same_bits_without_a_step() {
    let target = GaussianMixture::<2>::two_unequal(0.5).expect("a mixture");
    let run = from(0.0, 1.0);
    let short = MpmOptions {
        steps: Some(40),
        ..MpmOptions::default()
    };
    let alone = MpmOptions {
        survey: false,
        rounds: Some(2),
        ..short.clone()
    };
    let cached = MpmOptions {
        score_location: ScoreLocation::Cached,
        ..short.clone()
    };
    let pool_alone = MpmOptions {
        rounds: Some(0),
        ..short.clone()
    };
    for whole in [short, alone, cached, pool_alone] {
        let (_directory, options) = in_a_directory(8);
        let options = MpmOptions {
            checkpoint: options.checkpoint,
            ..whole
        };
        let first = sample(&options, &target, &run).expect("particles");
        let mut seen = Steps::default();
        let again = options
            .sample(&target, &Frame::identity(), &run, &mut seen)
            .expect("particles");
        assert_eq!(seen.moved, 0, "nothing moves");
        assert_eq!(format!("{again:?}"), format!("{first:?}"));
    }
}

/// Counts what was moved.
#[derive(Default)]
struct Steps {
    moved: usize,
}

impl Observer for Steps {
    fn see(&mut self, _: &ParticleView<'_>) -> ControlFlow<()> {
        self.moved += 1;
        ControlFlow::Continue(())
    }
}

#[test]
fn a_checkpoint_of_another_run_is_refused() {
    let target = Gaussian::<2>::standard();
    let (_directory, options) = in_a_directory(8);
    let run = from(0.0, 1.0);
    assert!(
        options
            .sample(&target, &Frame::identity(), &run, &mut Killer(1))
            .is_err()
    );
    let path = options.checkpoint.clone().expect("a checkpoint").path;
    assert!(path.exists());
    let mut other = run.clone();
    other.seed += 1;
    let error = sample(&options, &target, &other).expect_err("another seed");
    assert!(error.to_string().contains("another run"), "{error}");
    assert!(path.exists(), "nothing is lost");
    assert!(
        sample(
            &options,
            &Gaussian::<2>::new([0.1, 0.0], mpm_tensor::Matrix::IDENTITY).expect("a Gaussian"),
            &run
        )
        .is_err()
    );
    std::fs::write(&path, b"not a checkpoint").expect("written");
    assert!(matches!(
        sample(&options, &target, &run),
        Err(SampleError::Checkpoint { .. })
    ));
}

#[test]
fn checkpoint_options_out_of_range_are_named() {
    let (_directory, options) = in_a_directory(0);
    assert!(matches!(
        sample(&options, &Gaussian::<2>::standard(), &from(0.0, 1.0)),
        Err(SampleError::InvalidOption {
            field: "steps between checkpoints",
            ..
        })
    ));
    let nowhere = MpmOptions {
        checkpoint: Some(Checkpoint {
            path: "/nonexistent/directory/run.checkpoint".into(),
            every: 8,
        }),
        ..MpmOptions::default()
    };
    assert!(matches!(
        sample(&nowhere, &Gaussian::<2>::standard(), &from(0.0, 1.0)),
        Err(SampleError::Checkpoint { .. })
    ));
}

#[test]
fn few_particles_on_many_pieces_are_described_as_they_are() {
    let target = GaussianMixture::<2>::three_far().expect("a mixture");
    for count in [3, 20] {
        let samples = MpmOptions::default()
            .sample(&target, &target.frame(), &Run::new(count, 2), &mut Silent)
            .expect("particles");
        let certificate = samples.certificate.expect("a certificate");
        for axis in 0..2 {
            let mean = samples.positions.iter().map(|x| x[axis]).sum::<f64>() / count as f64;
            assert!((certificate.moments[axis].mean.value - mean).abs() < 1e-9);
        }
    }
}

#[test]
fn a_tempered_target_is_not_called_converged() {
    let options = MpmOptions {
        annealing: Annealing::Constant { alpha: 0.5 },
        ..MpmOptions::default()
    };
    let samples = sample(&options, &Gaussian::<2>::standard(), &from(0.0, 1.0)).expect("particles");
    let outcome = samples.certificate.expect("a certificate").outcome;
    assert!(
        matches!(outcome, Outcome::Stalled(Doubt::Tempered { .. })),
        "{outcome:?}"
    );
}

#[test]
fn a_start_whose_distances_have_no_squares_is_no_obstacle() {
    for (mean, standard_deviation) in [(1e200, 1.0), (1e308, 1e50), (0.0, 1e154), (0.0, 1e300)] {
        let run = from(mean, standard_deviation);
        let samples = sample(&MpmOptions::default(), &Gaussian::standard(), &run).unwrap();
        assert_eq!(samples.positions.len(), 300, "{mean:e} {standard_deviation:e}");
        assert!(samples.log_evidence.is_some_and(|log| log.abs() < 0.02), "{samples:?}");
    }
}

#[test]
fn errors_that_are_no_numbers_are_infinite() {
    let nothing = EstimatedMoment {
        value: 0.0,
        estimate: 0.0,
        standard_error: 0.0,
        unexplained: 0.0,
    };
    let point = MomentEstimate {
        mean: nothing,
        standard_deviation: nothing,
    };
    let errors = [point.mean_error(), point.standard_deviation_error()];
    assert_eq!(errors, [f64::INFINITY; 2]);
}
