//! Fit error against training time on a family of deformations known by formula, split into runs trained on and runs that were not.
//!
//!     cargo run --release -p mpm-rom --example bending -- [EPOCHS [BATCH [POINTS [RATE [COORDINATES [λ_F [λ_v [ADAM]]]]]]]]

#[path = "../tests/suite/common.rs"]
mod common;

use std::ops::ControlFlow;
use std::time::Instant;

use mpm_rom::snapshots::{Run, Snapshots};
use mpm_rom::training::{EpochReport, Optimizer, Trainer, Training};

#[allow(clippy::print_stdout)]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<f64> = std::env::args()
        .skip(1)
        .map(|text| text.parse())
        .collect::<Result<_, _>>()?;
    let or = |index: usize, default: f64| arguments.get(index).copied().unwrap_or(default);
    let standard = Training::default();
    let config = Training {
        epochs: or(0, 100.0) as u64,
        batch: or(1, standard.batch as f64) as usize,
        points: or(2, standard.points as f64) as usize,
        initial_rate: or(3, standard.initial_rate),
        coordinates: or(4, standard.coordinates as f64) as usize,
        gradient_weight: or(5, standard.gradient_weight),
        velocity_weight: or(6, standard.velocity_weight),
        optimizer: if or(7, 0.0) > 0.0 {
            Optimizer::Adam
        } else {
            Optimizer::Soap
        },
        ..standard
    };
    let all = common::bending_cylinder(1368, 30, 30);
    let part = |runs: &[Run<3>]| Snapshots::new(all.body().clone(), runs.to_vec());
    let (training, unseen) = (part(&all.runs()[..24])?, part(&all.runs()[24..])?);
    println!("{config:?}");
    let every = (config.epochs / 10).max(1);
    let mut observer = |report: &EpochReport| {
        if (report.epoch + 1).is_multiple_of(every) {
            let terms = report.terms;
            println!(
                "epoch {:6}  position {:.3e}  gradient {:.3e}  velocity {:.3e}  rate {:.1e}",
                report.epoch + 1,
                terms.position,
                terms.gradient,
                terms.velocity,
                report.rate
            );
        }
        ControlFlow::Continue(())
    };
    let mut trainer = Trainer::new(&training, config)?;
    let start = Instant::now();
    trainer.train(None, &mut observer)?;
    let seconds = start.elapsed().as_secs_f64();
    let model = trainer.model();
    let (fit, generalisation) = (
        model.reconstruction_error(&training)?,
        model.reconstruction_error(&unseen)?,
    );
    println!("{seconds:.1} s, position error {fit:.3} % on the runs trained on, {generalisation:.3} % on the others");
    Ok(())
}
