//! A run that may fail without ending its study: divergence is a result.

use parvi::SampleError;
use serde::{Deserialize, Serialize};

use super::results::single_line;
use crate::CommandError;

/// How a run ended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Status {
    /// With finite particles.
    #[default]
    Finished,
    /// With positions or scores that are not finite.
    Diverged,
    /// Not begun: the target lacks what the method needs.
    Unsupported,
}

impl Status {
    /// The word in tables.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Finished => "finished",
            Self::Diverged => "diverged",
            Self::Unsupported => "unsupported",
        }
    }
}

/// What a run gave, or why it gave nothing.
pub enum Attempt<T> {
    /// The result.
    Finished(T),
    /// Status and reason of a run without a result.
    Failed(Status, String),
}

impl<T> Attempt<T> {
    /// The same with another result.
    pub fn map<U>(self, change: impl FnOnce(T) -> U) -> Attempt<U> {
        match self {
            Self::Finished(value) => Attempt::Finished(change(value)),
            Self::Failed(status, reason) => Attempt::Failed(status, reason),
        }
    }

    /// The result, if there is one.
    pub fn finished(self) -> Option<T> {
        match self {
            Self::Finished(value) => Some(value),
            Self::Failed(..) => None,
        }
    }
}

/// Turns failures of the sampler into results; interruptions, mistakes in options and methods that this build lacks stay errors.
pub fn attempt<T>(result: Result<T, CommandError>) -> Result<Attempt<T>, CommandError> {
    let error = match result {
        Ok(value) => return Ok(Attempt::Finished(value)),
        Err(error) => error,
    };
    let status = match &error {
        CommandError::NotFinite { .. } => Status::Diverged,
        CommandError::Sample(SampleError::Unsupported { .. }) => Status::Unsupported,
        CommandError::Sample(
            SampleError::InvalidOption { .. } | SampleError::NotBuilt { .. } | SampleError::Interrupted { .. },
        ) => return Err(error),
        CommandError::Sample(_) => Status::Diverged,
        _ => return Err(error),
    };
    Ok(Attempt::Failed(status, single_line(error)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn divergence_is_a_result_and_interruption_is_not() {
        let diverged = SampleError::Diverged {
            step: 3,
            reason: "a position\nis NaN".to_owned(),
        };
        match attempt::<()>(Err(diverged.into())).unwrap() {
            Attempt::Failed(Status::Diverged, reason) => assert!(!reason.contains('\n')),
            _ => panic!("a divergence is a failed attempt"),
        }
        assert!(attempt::<()>(Err(SampleError::Interrupted { step: 3 }.into())).is_err());
    }
}
