//! A run that may fail without ending its study: divergence is a result.

use std::panic::{AssertUnwindSafe, catch_unwind};

use parvi::SampleError;
use parvi_targets::TargetError;

use super::status::Status;
use super::value::single_line;
use crate::CommandError;

/// Why a run gave nothing.
#[derive(Clone, Debug)]
pub struct Failure {
    /// How it ended.
    pub status: Status,
    /// Why, on one line.
    pub reason: String,
}

impl Failure {
    /// A failure.
    pub fn new(status: Status, reason: impl ToString) -> Self {
        let reason = single_line(reason);
        Self { status, reason }
    }
}

impl From<Failure> for CommandError {
    fn from(failure: Failure) -> Self {
        Self::Failed(failure)
    }
}

/// What a run gave, or why it gave nothing.
pub type Attempt<T> = Result<T, Failure>;

/// Turns failures of the sampler into results, and particles so far out that a distance overflows; interruptions, mistakes in options and methods that this build lacks stay errors.
pub fn attempt<T>(result: Result<T, CommandError>) -> Result<Attempt<T>, CommandError> {
    result.map(Ok).or_else(|error| {
        let status = match &error {
            CommandError::Sample(SampleError::Unsupported { .. }) => Status::Unsupported,
            CommandError::Sample(
                SampleError::InvalidOption { .. } | SampleError::NotBuilt { .. } | SampleError::Interrupted { .. },
            ) => return Err(error),
            CommandError::NotFinite(_) | CommandError::Metric(_) | CommandError::Sample(_) => Status::Diverged,
            _ => return Err(error),
        };
        Ok(Err(Failure::new(status, error)))
    })
}

/// As [`attempt`], of the points that stand for a target: a log density that is no number, or a sample that is worth too little, makes none, of this target alone.
pub fn of_reference<T>(result: Result<T, CommandError>) -> Result<Attempt<T>, CommandError> {
    result.map(Ok).or_else(|error| match error {
        CommandError::Failed(failure) => Ok(Err(failure)),
        CommandError::Target(TargetError::ReferenceFailed { .. }) => Ok(Err(Failure::new(Status::NoReference, error))),
        error => Err(error),
    })
}

/// What some work gave, or what its panic said, on one line.
pub fn caught<T>(work: impl FnOnce() -> T) -> Result<T, String> {
    catch_unwind(AssertUnwindSafe(work)).map_err(|payload| {
        let owned = payload.downcast_ref::<String>().map(String::as_str);
        let text = owned.or_else(|| payload.downcast_ref::<&str>().copied());
        single_line(text.unwrap_or("a panic without a message"))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_panic_said_is_kept() {
        let panicked = caught(|| std::panic::resume_unwind(Box::new("went\nwrong")));
        assert_eq!(panicked, Err::<(), _>("went wrong".to_owned()));
        assert_eq!(caught(|| 3), Ok(3));
    }

    #[test]
    fn divergence_is_a_result_and_interruption_is_not() {
        let diverged = SampleError::Diverged {
            step: 3,
            reason: "a position\nis NaN".to_owned(),
        };
        match attempt::<()>(Err(diverged.into())).unwrap() {
            Err(failure) => assert!(failure.status == Status::Diverged && !failure.reason.contains('\n')),
            Ok(()) => panic!("a divergence is a failed attempt"),
        }
        assert!(attempt::<()>(Err(SampleError::Interrupted { step: 3 }.into())).is_err());
    }
}
