//! Checks of configurations that several kinds share; every refusal names the field.

use std::collections::HashSet;

use parvi::Method;
use parvi_options::{Bounded, MethodSpecification, OptionError};

use super::definition::Case;
use crate::CommandError;

/// The error for a field whose value does not fit; the runner adds the file.
pub fn refusal(field: &str, message: impl Into<String>) -> CommandError {
    CommandError::ConfigField {
        file: String::new(),
        field: field.to_owned(),
        message: message.into(),
    }
}

/// Refuses an empty list.
pub fn not_empty<T>(field: &str, values: &[T]) -> Result<(), CommandError> {
    holds(!values.is_empty(), field, || "is empty".to_owned())
}

/// Refuses a field unless something holds.
pub fn holds(holds: bool, field: &str, otherwise: impl FnOnce() -> String) -> Result<(), CommandError> {
    holds.then_some(()).ok_or_else(|| refusal(field, otherwise()))
}

/// Refuses lists of a configuration that are empty: `all_given!(self: seeds, dims)`.
macro_rules! all_given {
    ($study:ident: $($list:ident),+) => {
        $($crate::study::checks::not_empty(stringify!($list), &$study.$list)?;)+
    };
}
pub(crate) use all_given;

/// Refuses numbers that are not positive and finite.
pub fn positive(field: &str, values: &[f64]) -> Result<(), CommandError> {
    let mut values = values.iter();
    values.try_for_each(|value| {
        let is_positive = *value > 0.0 && value.is_finite();
        holds(is_positive, field, || format!("{value} must be a number above 0"))
    })
}

/// Refuses ends of which the first is not below the second.
pub fn interval(field: &str, [low, high]: [f64; 2]) -> Result<(), CommandError> {
    let is_interval = low < high && (high - low).is_finite();
    holds(is_interval, field, || format!("[{low}, {high}] is no interval"))
}

/// Refuses a number that is not finite.
pub fn finite(field: &str, value: f64) -> Result<(), CommandError> {
    holds(value.is_finite(), field, || format!("{value} must be finite"))
}

/// Refuses an option that the study sets itself.
pub fn unset<T>(field: &str, value: &Option<T>, place: &str) -> Result<(), CommandError> {
    holds(value.is_none(), field, || format!("belongs into `{place}`"))
}

/// The method; refuses one that lacks an option that the study sets.
pub fn fitting(field: &str, method: &MethodSpecification) -> Result<Method, CommandError> {
    let refused = |error: OptionError| refusal(&format!("{field}.options.{}", error.name), error.reason);
    method.method(None).map_err(refused)
}

/// The cases; refuses lists of which two entries make the same one.
pub fn distinct<W>(field: &str, cases: Vec<Case<W>>) -> Result<Vec<Case<W>>, CommandError> {
    distinct_names(field, cases.iter().map(|case| case.id().to_owned())).map(|()| cases)
}

/// Refuses lists that give two cases of the same name.
pub fn distinct_names(field: &str, names: impl IntoIterator<Item = String>) -> Result<(), CommandError> {
    let (mut known, mut names) = (HashSet::new(), names.into_iter());
    names.try_for_each(|name| holds(known.insert(name.clone()), field, || format!("two cases are `{name}`")))
}

/// Refuses methods of which two have the same label.
pub fn distinct_labels(methods: &[MethodSpecification]) -> Result<(), CommandError> {
    let mut known = HashSet::new();
    MethodSpecification::labels(methods).try_for_each(|label| {
        let otherwise = || format!("two are called `{label}`; give one of them a `label` of its own");
        holds(known.insert(label), "methods", otherwise)
    })
}

/// The sizes of a list, small ones first.
pub fn ascending<const LEAST: i64, const MOST: i64>(sizes: &[Bounded<LEAST, MOST>]) -> Vec<usize> {
    let mut sizes: Vec<usize> = sizes.iter().map(|size| size.get()).collect();
    sizes.sort_unstable();
    sizes
}
