//! Study `random-targets`: methods on targets that nobody has tuned anything to.
//!
//! A seed makes a [`RandomTarget`](parvi_targets::RandomTarget), of which the methods know nothing, or its rough frame. Particles are
//! compared with quasi-random draws of it, in standard deviations per axis, and log Z with the exact one.

mod configuration;
mod figure;
mod identity_frame;
mod report;
mod row;

use parvi::{Method, Run};
use parvi_targets::BoxedTarget;

use configuration::KnownFrame;
pub use configuration::RandomTargets;
use identity_frame::InIdentityFrame;
use row::Row;

use super::attempt::{Attempt, Status, attempt};
use super::definition::{self, Report, Study};
use super::directory::StudyDirectory;
use super::results::single_line;
use super::yardstick::CurrentYardstick;
use crate::CommandError;
use crate::dispatch::{TargetTask, with_target};
use crate::options::{Bounded, MethodSpecification, TargetSpecification};
use crate::progress::CaseObserver;
use crate::sampling::{Outcome, sample_target};

/// A method on a target.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    target: TargetSpecification,
    dim: usize,
    target_seed: u64,
    method: MethodSpecification,
}

impl definition::Case for Case {
    fn id(&self) -> String {
        format!("{}-{}", self.target.label(), self.method.label())
    }

    fn method(&self) -> Option<&MethodSpecification> {
        Some(&self.method)
    }
}

impl Study for RandomTargets {
    type Case = Case;
    type Row = Row;
    type Shared = CurrentYardstick;

    const KIND: &'static str = "random-targets";

    fn seeds(&self) -> Vec<u64> {
        vec![self.seed]
    }

    fn threads(&self) -> Option<usize> {
        self.threads.map(Bounded::get)
    }

    fn cases(&self) -> Result<Vec<Case>, CommandError> {
        self.all_cases()
    }

    fn run(
        &self,
        case: &Case,
        yardstick: &mut CurrentYardstick,
        _directory: &StudyDirectory,
        observer: &mut CaseObserver,
    ) -> Result<Row, CommandError> {
        let yardstick = yardstick.of(&case.target, &self.yardstick())?;
        let mut run = Run::new(self.particles.get(), self.seed);
        run.start = case.method.options.start();
        let mut row = Row::new(case, yardstick.mean_distance() / run.particles as f64);
        let task = Sampled {
            frame: self.frame,
            method: &case.method.method(None)?,
            run: &run,
            observer,
        };
        match attempt(with_target(&case.target, task))? {
            Attempt::Failed(status, reason) => (row.status, row.reason) = (status, reason),
            Attempt::Finished((outcome, log_evidence)) => {
                row.take(&outcome, log_evidence);
                match yardstick.measure(&outcome.particles) {
                    Ok(errors) => row.energy_distance_squared = Some(errors.energy_distance_squared),
                    // So far out that a distance overflows.
                    Err(CommandError::Metric(error)) => {
                        (row.status, row.reason) = (Status::Diverged, single_line(error));
                    }
                    Err(error) => return Err(error),
                }
            }
        }
        Ok(row)
    }

    fn report(&self, rows: &[Row], directory: &StudyDirectory) -> Result<Report, CommandError> {
        report::report(self, rows, directory)
    }
}

/// A run, with the target's own log Z.
struct Sampled<'a> {
    frame: KnownFrame,
    method: &'a Method,
    run: &'a Run,
    observer: &'a mut CaseObserver,
}

impl TargetTask for Sampled<'_> {
    type Output = (Outcome, Option<f64>);

    fn run<const D: usize>(self, target: BoxedTarget<D>) -> Result<Self::Output, CommandError> {
        let log_evidence = target.log_evidence();
        let outcome = match self.frame {
            KnownFrame::Own => sample_target(target.as_ref(), self.method, self.run, self.observer)?,
            KnownFrame::Identity => sample_target(&InIdentityFrame(target), self.method, self.run, self.observer)?,
        };
        Ok((outcome, log_evidence))
    }
}
