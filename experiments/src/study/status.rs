//! How a case ended.

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
