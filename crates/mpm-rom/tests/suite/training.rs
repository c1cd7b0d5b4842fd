//! Training on snapshots known by formula: what it reaches, and that it can be interrupted, repeated and refused.

use std::ops::ControlFlow;

use mpm_rom::snapshots::{Run, Snapshots};
use mpm_rom::training::{EpochReport, Optimizer, Trainer, Training, TrainingError};

fn small() -> (Snapshots<3>, Training) {
    let config = Training {
        coordinates: 3,
        width: 8,
        depth: 2,
        encoder_width: 6,
        epochs: 8,
        batch: 5,
        points: 20,
        checkpoint_interval: 2,
        ..Training::default()
    };
    (crate::common::bending_cylinder(60, 3, 4), config)
}

fn go_on(_: &EpochReport) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

#[test]
fn a_resumed_training_has_the_bits_of_an_uninterrupted_one() {
    for optimizer in [Optimizer::Soap, Optimizer::Adam] {
        resumed_and_whole(optimizer);
    }
}

fn resumed_and_whole(optimizer: Optimizer) {
    let (snapshots, config) = small();
    let config = Training { optimizer, ..config };
    let mut whole = Trainer::new(&snapshots, config.clone()).unwrap();
    whole.train(None, &mut go_on).unwrap();
    let directory = tempfile::tempdir().unwrap();
    for last in [0, 2, 5, 7] {
        let path = directory.path().join(format!("{last}.safetensors"));
        let mut stop = |report: &EpochReport| {
            if report.epoch == last {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        };
        Trainer::new(&snapshots, config.clone())
            .unwrap()
            .train(Some(&path), &mut stop)
            .unwrap();
        let mut resumed = Trainer::resume(&snapshots, config.clone(), &path).unwrap();
        assert_eq!(resumed.history().len() as u64, last + 1);
        resumed.train(None, &mut go_on).unwrap();
        assert_eq!(resumed.history(), whole.history());
        assert_eq!(resumed.model(), whole.model(), "stopped after epoch {last}");
    }
}

#[test]
fn the_number_of_threads_does_not_matter() {
    let (snapshots, config) = small();
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut trainer = Trainer::new(&snapshots, config.clone()).unwrap();
            trainer.train(None, &mut go_on).unwrap();
            trainer.model()
        })
    };
    assert_eq!(on(1), on(3));
}

#[test]
fn more_steps_than_can_be_counted_begin_with_the_first_rate() {
    let (snapshots, config) = small();
    let config = Training {
        epochs: 1 << 62,
        batch: 3,
        ..config
    };
    let mut trainer = Trainer::new(&snapshots, config.clone()).unwrap();
    trainer.train(None, &mut |_| ControlFlow::Break(())).unwrap();
    let rate = trainer.history()[0].rate;
    assert!((rate / config.initial_rate - 1.0).abs() < 1e-12, "{rate}");
}

#[test]
fn another_checkpoint_is_refused() {
    let (snapshots, config) = small();
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("checkpoint.safetensors");
    Trainer::new(&snapshots, config.clone())
        .unwrap()
        .write_checkpoint(&path)
        .unwrap();
    let refused = |snapshots: &Snapshots<3>, config: Training| match Trainer::resume(snapshots, config, &path) {
        Err(TrainingError::OtherCheckpoint { what, .. }) => what,
        other => panic!("{other:?}"),
    };
    let other = Training {
        seed: 1,
        ..config.clone()
    };
    assert_eq!(refused(&snapshots, other), "configuration");
    assert_eq!(
        refused(&crate::common::bending_cylinder(60, 2, 4), config.clone()),
        "snapshots"
    );
    let rarer = Training {
        checkpoint_interval: 3,
        ..config
    };
    assert!(Trainer::resume(&snapshots, rarer, &path).is_ok());
}

#[test]
fn a_loss_that_is_not_finite_has_its_error() {
    let (snapshots, config) = small();
    let wild = Training {
        initial_rate: 1e200,
        ..config
    };
    let result = Trainer::new(&snapshots, wild).unwrap().train(None, &mut go_on);
    assert!(
        matches!(result, Err(TrainingError::NotFinite { epoch: 0, .. })),
        "{result:?}"
    );
}

/// The example `bending` in small, with as many steps as 48 epochs of it have. Without any motion the error would be tens of per cent.
#[test]
fn unseen_runs_are_reproduced() {
    let all = crate::common::bending_cylinder(110, 16, 12);
    let part = |runs: &[Run<3>]| Snapshots::new(all.body().clone(), runs.to_vec()).unwrap();
    let (seen, unseen) = (part(&all.runs()[..12]), part(&all.runs()[12..]));
    let config = Training {
        epochs: 60,
        ..Training::default()
    };
    let mut trainer = Trainer::new(&seen, config).unwrap();
    trainer.train(None, &mut go_on).unwrap();
    let error = trainer.model().reconstruction_error(&unseen).unwrap();
    assert!(error < 1.0, "{error} %");
}
