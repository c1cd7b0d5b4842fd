//! Lines on standard output.

use std::fmt::Display;
use std::io::{self, Write};

/// Writes a line; where nobody reads any more the process ends.
pub fn say(line: impl Display) {
    if writeln!(io::stdout().lock(), "{line}").is_err() {
        std::process::exit(0);
    }
}
