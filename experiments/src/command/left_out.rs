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

/// A module in the place of a command: what is asked of it names the feature that has it.
macro_rules! without {
    ($feature:literal, $command:ident, $asked:literal, $reported:literal) => {
        #[doc = concat!("For `", stringify!($command), "`.")]
        #[cfg(any(test, not(feature = $feature)))]
        pub mod $command {
            pub use super::*;

            /// Says which feature has the command.
            pub fn execute(_: &Arguments) -> Result<(), CommandError> {
                let (asked, feature) = ($asked, $feature);
                Err(CommandError::LeftOut { asked, feature })
            }

            /// As [`execute`].
            pub fn report(_: &std::path::Path) -> Result<(), CommandError> {
                let (asked, feature) = (concat!("parvi report of ", $reported), $feature);
                Err(CommandError::LeftOut { asked, feature })
            }
        }
    };
}

without!("mechanics", simulate, "parvi simulate", "a simulated scene");
without!("rom", rom, "parvi rom", "a reduced-order model");

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
