//! What stands in tables, and how numbers are written.

use crate::exponent_text;
use crate::statistics::fit_power_law;

/// What can stand in a table.
pub trait Cell {
    /// As it stands there: numbers with three digits, counts whole, [`MISSING`] for what there is not.
    fn cell(&self) -> String;
}

impl Cell for f64 {
    fn cell(&self) -> String {
        number(*self)
    }
}

macro_rules! as_displayed {
    ($($type:ty),*) => {$(
        impl Cell for $type {
            fn cell(&self) -> String {
                self.to_string()
            }
        }
    )*};
}

as_displayed!(str, String, usize, u64);

impl<T: Cell + ?Sized> Cell for &T {
    fn cell(&self) -> String {
        (**self).cell()
    }
}

impl<T: Cell> Cell for Option<T> {
    fn cell(&self) -> String {
        self.as_ref().map_or(MISSING.to_owned(), T::cell)
    }
}

/// The exponent of the power law through points (x, y), with its 95 % interval.
pub fn exponent(points: impl Iterator<Item = (f64, f64)>) -> String {
    let (x, y): (Vec<f64>, Vec<f64>) = points.unzip();
    let law = fit_power_law(&x, &y);
    law.map_or(MISSING.to_owned(), |law| exponent_text(&law, 0))
}

/// A part of a whole in percent: 100 % is all of it.
pub fn percent(part: usize, whole: usize) -> Option<String> {
    (whole > 0).then(|| match 100.0 * part as f64 / whole as f64 {
        most if part < whole && most >= 99.5 => format!("{:.1} %", (10.0 * most).floor() / 10.0),
        percent => format!("{percent:.0} %"),
    })
}

/// Words for several, and for one.
pub(super) const COUNTED: [(&str, &str); 13] = [
    ("seeds", "seed"),
    ("runs", "run"),
    ("meshes", "mesh"),
    ("steps", "step"),
    ("sets", "set"),
    ("threads", "thread"),
    ("directions", "direction"),
    ("points", "point"),
    ("particles", "particle"),
    ("sample points", "sample point"),
    ("cases", "case"),
    ("columns", "column"),
    ("rows", "row"),
];

/// So many of what a word for several says: `1 run`, `2 runs`.
pub fn counted(count: usize, many: &str) -> String {
    let one = COUNTED.iter().find(|(known, _)| *known == many && count == 1);
    format!("{count} {}", one.map_or(many, |(_, one)| one))
}

/// A text that Markdown shows as it is within a line: without `<` before it `>` closes nothing.
pub fn escaped(text: &str) -> String {
    let escape = |character: char| "*`[]\\~".contains(character).then_some('\\');
    let shown = text
        .chars()
        .flat_map(|character| escape(character).into_iter().chain([character]));
    // A line's end is one of the table's.
    let shown = shown.collect::<String>().replace(['\n', '\r'], " ");
    shown.replace('&', "&amp;").replace('<', "&lt;")
}

/// What stands in a table for a value that does not exist.
pub const MISSING: &str = "–";

/// A number with three significant digits, in scientific notation where that is shorter to read.
pub fn number(value: f64) -> String {
    number_of(value, LEAST_DIGITS)
}

/// Significant digits of numbers in tables, and the most that it may take to tell them apart.
const LEAST_DIGITS: usize = 3;
const MOST_DIGITS: usize = 6;

/// How many significant digits tell most of the values apart: 3 to 6.
pub fn telling_digits(values: &[f64]) -> usize {
    let told = |digits: usize| {
        let mut texts: Vec<String> = values.iter().map(|value| number_of(*value, digits)).collect();
        texts.sort_unstable();
        texts.dedup();
        texts.len()
    };
    let most = told(MOST_DIGITS);
    let enough = (LEAST_DIGITS..MOST_DIGITS).find(|digits| told(*digits) == most);
    enough.unwrap_or(MOST_DIGITS)
}

/// A number beside a reference, with so many significant digits: four decimals where these are more and the reference is not 0.
pub fn number_beside(value: f64, reference: Option<f64>, digits: usize) -> String {
    let (told, compared) = (number_of(value, digits), format!("{value:.4}"));
    let is_compared = reference.is_some_and(|reference| reference != 0.0) && (1e-3..1e3).contains(&value.abs());
    if is_compared && compared.len() >= told.len() {
        compared
    } else {
        told
    }
}

/// The same as [`number`] with so many significant digits.
pub fn number_of(value: f64, digits: usize) -> String {
    if !value.is_finite() {
        return MISSING.to_owned();
    }
    if value == 0.0 {
        return "0".to_owned();
    }
    // The power of ten after rounding: 9.9996 has one more digit before the point than 9.9994.
    let scientific = format!("{value:.*e}", digits - 1);
    let power = scientific.split('e').nth(1).and_then(|power| power.parse::<i32>().ok());
    match power.filter(|power| (-3..5).contains(power)) {
        Some(power) => format!("{value:.*}", (digits as i32 - 1 - power).max(0) as usize),
        None => scientific,
    }
}

#[cfg(test)]
mod tests {
    use super::percent;

    #[test]
    fn nearly_all_is_not_all() {
        let percent = |part| percent(part, 1600).unwrap();
        assert_eq!(
            [0, 800, 1591, 1592, 1599, 1600].map(percent),
            ["0 %", "50 %", "99 %", "99.5 %", "99.9 %", "100 %"]
        );
    }
}
