//! Numbers and texts as pages write them.

use parvi_plot::page::{MISSING, escaped, number};

#[test]
fn numbers_have_three_digits() {
    let texts: Vec<String> = [0.0, 1.0, -0.012345, 12345.6, 1e-5, 2.5e7, f64::NAN]
        .into_iter()
        .map(number)
        .collect();
    assert_eq!(texts, ["0", "1.00", "-0.0123", "12346", "1.00e-5", "2.50e7", MISSING]);
}

/// A quoted name of a column may have several lines.
#[test]
fn a_text_stays_within_its_line() {
    assert_eq!(escaped("two\nlines, a<b"), "two lines, a&lt;b");
}
