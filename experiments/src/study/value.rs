//! What stands in a cell of results.csv.

use parvi_options::is_among;

use super::status::Status;
use crate::plots::results::Value;

/// The columns that hold words; all others hold numbers.
const WORDS: &str = "case status ending reason note message outcome target method series sweep family label quantity scene against variant \
     material schedule score volumes basis start_draws transfer shifts rotation settling_shifts moment_correction guards escaped turned \
     name manifold choice quadrature update asked";

/// The columns that hold a [`Status`].
pub const ENDINGS: [&str; 2] = ["status", "ending"];

/// What a file holds in a column.
///
/// # Errors
/// A text that does not belong there, in words.
pub fn read(column: &str, text: &str) -> Result<Value, String> {
    let is_ending = ENDINGS.contains(&column);
    if is_ending && Status::of(text).is_none() {
        return Err(format!("`{text}` is no `{column}`"));
    }
    if text.is_empty() || is_among(WORDS, column) {
        return Ok(text.into());
    }
    let number = || text.parse().map(Value::Number);
    let value = text.parse().map(Value::Count).or_else(|_| number());
    value.map_err(|_| format!("`{text}` in the column `{column}` is no number"))
}

/// A text for one cell: without line breaks, so that a file whose last line has no end was cut off.
pub fn single_line(text: impl ToString) -> String {
    text.to_string().split_whitespace().collect::<Vec<_>>().join(" ")
}
