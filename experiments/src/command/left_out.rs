//! What stands in a build for the commands that it lacks.

use std::ffi::OsString;

use clap::Args;

use crate::CommandError;

/// Whatever the command would take.
#[derive(Args, Debug)]
pub struct Arguments {
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, hide = true)]
    _all: Vec<OsString>,
}

/// The error for what was asked, with the feature that has it.
const fn left_out(asked: &'static str, feature: &'static str) -> CommandError {
    CommandError::LeftOut { asked, feature }
}

/// For `simulate`.
#[cfg(any(test, not(feature = "mechanics")))]
pub mod simulate {
    pub use super::*;

    /// Says which feature has the command.
    pub fn execute(_: &Arguments) -> Result<(), CommandError> {
        Err(left_out("parvi simulate", "mechanics"))
    }

    /// As [`execute`].
    pub fn report(_: &std::path::Path) -> Result<(), CommandError> {
        Err(left_out("parvi report of a simulated scene", "mechanics"))
    }
}

/// For `rom`.
#[cfg(any(test, not(feature = "rom")))]
pub mod rom {
    pub use super::*;

    /// Says which feature has the command.
    pub fn execute(_: &Arguments) -> Result<(), CommandError> {
        Err(left_out("parvi rom", "rom"))
    }

    /// As [`execute`].
    pub fn report(_: &std::path::Path) -> Result<(), CommandError> {
        Err(left_out("parvi report of a reduced-order model", "rom"))
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use clap::Parser;

    use super::*;

    #[derive(Debug, Parser)]
    struct Line {
        #[command(flatten)]
        arguments: Arguments,
    }

    #[test]
    fn whatever_is_asked_the_feature_is_named() {
        for line in ["parvi scene.toml --out dir", "parvi train --unknown", "parvi"] {
            let line = Line::try_parse_from(line.split(' ')).expect("any arguments");
            let said = |result: Result<(), CommandError>| result.expect_err("left out").to_string();
            assert_eq!(
                said(simulate::execute(&line.arguments)),
                "parvi simulate: built without mechanics: cargo build --features mechanics"
            );
            assert_eq!(
                said(rom::execute(&line.arguments)),
                "parvi rom: built without rom: cargo build --features rom"
            );
        }
        assert!(rom::report(Path::new("")).is_err() && simulate::report(Path::new("")).is_err());
    }
}
