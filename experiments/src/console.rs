//! The two streams of the command: results on standard output, everything else on standard error.

use std::io::{self, Write};

use crate::CommandError;
use crate::plots::results::Value;

/// Writes text to standard output; a closed pipe is an error like any other.
pub fn print(text: &str) -> Result<(), CommandError> {
    let mut stream = io::stdout().lock();
    stream
        .write_all(text.as_bytes())
        .and_then(|()| stream.flush())
        .map_err(|source| CommandError::file("write to", "standard output", source))
}

/// What standard output says, and by which key.
pub type Pair = (&'static str, Value);

/// Writes `key=value` lines to standard output, in the order given; a key without a value is left out.
pub fn print_pairs(pairs: &[(&str, Value)]) -> Result<(), CommandError> {
    let told = pairs.iter().filter(|(_, value)| *value != Value::Empty);
    print(&told.map(|(key, value)| format!("{key}={value}\n")).collect::<String>())
}

/// Writes a line to standard error. Where even that fails there is nobody left to tell.
pub fn notice(line: &str) {
    let _ = writeln!(io::stderr().lock(), "{line}");
}
