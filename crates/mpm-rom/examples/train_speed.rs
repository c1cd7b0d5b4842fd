//! What an evaluation and a training step cost: milliseconds for 10⁴ points on one thread.
//!
//!     cargo run --release -p mpm-rom --example train_speed

#[path = "../tests/suite/common.rs"]
mod common;

use std::ops::ControlFlow;
use std::time::Instant;

use mpm_rom::manifold::{Evaluation, Manifold, Wanted};
use mpm_rom::training::{Trainer, Training};

/// The least of a few timings, in milliseconds.
fn least(mut work: impl FnMut()) -> f64 {
    let mut least = f64::INFINITY;
    for _ in 0..7 {
        let start = Instant::now();
        work();
        least = least.min(1e3 * start.elapsed().as_secs_f64());
    }
    least
}

#[allow(clippy::print_stdout)]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global()?;
    let snapshots = common::bending_cylinder(1368, 2, 15);
    let one = Training {
        coordinates: 1,
        ..Training::default()
    };
    let model = Trainer::new(&snapshots, one)?.model();
    let points: Vec<_> = snapshots.reference().iter().copied().cycle().take(10_000).collect();
    let mut out = Evaluation::default();
    let mut evaluate = |gradients, jacobians| {
        let wanted = Wanted { gradients, jacobians };
        least(|| model.network().evaluate(&points, &[0.3], wanted, &mut out))
    };
    println!(
        "values                                  {:8.2} ms / 10⁴ points",
        evaluate(false, false)
    );
    println!(
        "values and 4 tangents                   {:8.2} ms / 10⁴ points",
        evaluate(true, true)
    );
    for points in [1368, 256, 64, 32] {
        let config = Training {
            points,
            epochs: 1,
            ..Training::default()
        };
        let samples = (30 * points) as f64;
        let trained = least(|| {
            let mut trainer = Trainer::new(&snapshots, config.clone()).ok();
            let _ = trainer
                .as_mut()
                .map(|trainer| trainer.train(None, &mut |_| ControlFlow::Continue(())));
        });
        println!(
            "step with {points:4} points of a frame          {:8.2} ms / 10⁴ points, {:.2} ms / 16 frames",
            trained * 1e4 / samples,
            trained * 16.0 / 30.0
        );
    }
    Ok(())
}
