//! A run that may fail without ending its study: divergence is a result.

use parvi::SampleError;

use super::results::single_line;
use super::row::Value;
use crate::CommandError;

/// Ways in which a case ends, with the words of tables and files.
macro_rules! endings {
    ($($(#[$meta:meta])* $ending:ident = $word:literal,)*) => {
        /// How a case ended.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub enum Status {
            $($(#[$meta])* $ending,)*
        }

        impl Status {
            /// The word in tables and files.
            pub fn as_str(self) -> &'static str {
                match self {
                    $(Self::$ending => $word,)*
                }
            }

            /// The ending that a word stands for.
            pub fn of(word: &str) -> Option<Self> {
                match word {
                    $($word => Some(Self::$ending),)*
                    _ => None,
                }
            }
        }
    };
}

endings! {
    /// With finite particles.
    #[default]
    Finished = "finished",
    /// With positions or scores that are not finite.
    Diverged = "diverged",
    /// Not begun: the target lacks what the method needs, or there is no error to reach.
    Unsupported = "unsupported",
    /// A search: the error was reached.
    Reached = "reached",
    /// A search: a run took longer than allowed without reaching it.
    OutOfTime = "out-of-time",
    /// A search: even the largest number of steps did not reach it.
    OutOfSteps = "out-of-steps",
    /// A search: even the largest size did not reach it.
    OutOfSizes = "out-of-sizes",
    /// Anything that was asked for: with finite particles.
    Finite = "finite",
    /// With a typed error.
    Refused = "refused",
    /// With a panic, which must never happen.
    Panicked = "panicked",
    /// With particles that are not finite and no error, which must never happen either.
    NotFinite = "not-finite",
}

impl From<Status> for Value {
    fn from(status: Status) -> Self {
        status.as_str().into()
    }
}

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

/// What a run gave, or why it gave nothing.
pub type Attempt<T> = Result<T, Failure>;

/// Turns failures of the sampler into results, and particles so far out that a distance overflows; interruptions, mistakes in options and methods that this build lacks stay errors.
pub fn attempt<T>(result: Result<T, CommandError>) -> Result<Attempt<T>, CommandError> {
    let error = match result {
        Ok(value) => return Ok(Ok(value)),
        Err(error) => error,
    };
    let status = match &error {
        CommandError::NotFinite { .. } | CommandError::Metric(_) => Status::Diverged,
        CommandError::Sample(SampleError::Unsupported { .. }) => Status::Unsupported,
        CommandError::Sample(
            SampleError::InvalidOption { .. } | SampleError::NotBuilt { .. } | SampleError::Interrupted { .. },
        ) => return Err(error),
        CommandError::Sample(_) => Status::Diverged,
        _ => return Err(error),
    };
    Ok(Err(Failure::new(status, error)))
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
            Err(failure) => assert!(failure.status == Status::Diverged && !failure.reason.contains('\n')),
            Ok(()) => panic!("a divergence is a failed attempt"),
        }
        assert!(attempt::<()>(Err(SampleError::Interrupted { step: 3 }.into())).is_err());
    }
}
