//! The two streams of the command: results on standard output, everything else on standard error.

use std::io::{self, Write};

use crate::CommandError;

/// Writes text to standard output; a closed pipe is an error like any other.
pub fn print(text: &str) -> Result<(), CommandError> {
    let mut stream = io::stdout().lock();
    stream
        .write_all(text.as_bytes())
        .and_then(|()| stream.flush())
        .map_err(|source| CommandError::file("write to", "standard output", source))
}

/// Writes `key=value` lines to standard output, in the order given.
pub fn print_pairs(pairs: &[(&str, String)]) -> Result<(), CommandError> {
    let mut text = String::new();
    for (key, value) in pairs {
        text.push_str(&format!("{key}={value}\n"));
    }
    print(&text)
}

/// Writes a line to standard error. Where even that fails there is nobody left to tell.
pub fn notice(line: &str) {
    let _ = writeln!(io::stderr().lock(), "{line}");
}
