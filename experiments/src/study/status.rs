//! How a case ended.

use clap::ValueEnum;
use parvi_options::words;

words! {
    /// How a case ended, in the words of tables and files.
    #[derive(Default)]
    Status {
        /// With finite particles.
        #[default]
        Finished,
        /// With positions or scores that are not finite.
        Diverged,
        /// Not begun: the target lacks what the method needs, or there is no error to reach.
        Unsupported,
        /// Not begun: what stands for the target is not known well enough to hold particles against it.
        NoReference,
        /// A search: the error was reached.
        Reached,
        /// A search: a run took longer than allowed without reaching it.
        OutOfTime,
        /// A search: even the largest number of steps did not reach it.
        OutOfSteps,
        /// A search: even the largest size did not reach it.
        OutOfSizes,
        /// Anything that was asked for: with finite particles.
        Finite,
        /// With a typed error.
        Refused,
        /// With a panic, which must never happen.
        Panicked,
        /// With particles that are not finite and no error, which must never happen either.
        NotFinite,
    }
}

impl Status {
    /// The ending that a word stands for.
    pub fn of(word: &str) -> Option<Self> {
        Self::from_str(word, false).ok()
    }
}
