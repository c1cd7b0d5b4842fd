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

/// A part of a whole in percent.
pub fn percent(part: usize, whole: usize) -> Option<String> {
    (whole > 0).then(|| format!("{:.0} %", 100.0 * part as f64 / whole as f64))
}

/// What stands in a table for a value that does not exist.
pub const MISSING: &str = "–";

/// A number with three significant digits, in scientific notation where that is shorter to read.
pub fn number(value: f64) -> String {
    if !value.is_finite() {
        return MISSING.to_owned();
    }
    let size = value.abs();
    if value == 0.0 {
        "0".to_owned()
    } else if (1e-3..1e5).contains(&size) {
        let decimals = (2.0 - size.log10().floor()).clamp(0.0, 6.0) as usize;
        format!("{value:.decimals$}")
    } else {
        format!("{value:.2e}")
    }
}
