//! Checks of configurations that several kinds share; every refusal names the field.

use std::collections::HashSet;

use parvi::Method;
use parvi_targets::{Dimensions, TargetError, TargetInfo, target_info};

use super::definition::Case;
use crate::CommandError;
use crate::options::{Bounded, Dimension, MethodSpecification, OptionError, TargetSpecification};

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
    if values.is_empty() {
        return Err(refusal(field, "is empty"));
    }
    Ok(())
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
    match values.iter().find(|value| !(**value > 0.0 && value.is_finite())) {
        Some(value) => Err(refusal(field, format!("{value} must be a number above 0"))),
        None => Ok(()),
    }
}

/// Refuses a number that is not finite.
pub fn finite(field: &str, value: f64) -> Result<(), CommandError> {
    if value.is_finite() {
        return Ok(());
    }
    Err(refusal(field, format!("{value} must be finite")))
}

/// Refuses an option that the study sets itself.
pub fn unset<T>(field: &str, value: &Option<T>, place: &str) -> Result<(), CommandError> {
    match value {
        Some(_) => Err(refusal(field, format!("belongs into `{place}`"))),
        None => Ok(()),
    }
}

/// The method; refuses one that lacks an option that the study sets.
pub fn fitting(field: &str, method: &MethodSpecification) -> Result<Method, CommandError> {
    let refused = |error: OptionError| refusal(&format!("{field}.options.{}", error.name), error.reason);
    method.method(None).map_err(refused)
}

/// Refuses lists of which two entries make the same case.
pub fn distinct<W>(field: &str, cases: &[Case<W>]) -> Result<(), CommandError> {
    distinct_names(field, cases.iter().map(|case| case.id().to_owned()))
}

/// Refuses lists that give two cases of the same name.
pub fn distinct_names(field: &str, names: impl IntoIterator<Item = String>) -> Result<(), CommandError> {
    let mut known = HashSet::new();
    match names.into_iter().find(|name| !known.insert(name.clone())) {
        Some(name) => Err(refusal(field, format!("two cases are `{name}`"))),
        None => Ok(()),
    }
}

/// The sizes of a list, small ones first.
pub fn ascending<const LEAST: i64, const MOST: i64>(sizes: &[Bounded<LEAST, MOST>]) -> Vec<usize> {
    let mut sizes: Vec<usize> = sizes.iter().map(|size| size.get()).collect();
    sizes.sort_unstable();
    sizes
}

/// Targets, each in those of its dimensions that are among `dims`; without a list all of the catalogue that have one and whose data no user brings.
///
/// # Errors
/// A target that there is not, that has none of the dimensions, or parameters that it does not have.
pub fn places(
    listed: Option<Vec<TargetSpecification>>,
    dims: &[Dimension],
) -> Result<Vec<Vec<TargetSpecification>>, CommandError> {
    not_empty("dims", dims)?;
    let Some(listed) = listed else {
        let own = |info: &&TargetInfo| info.dimensions != Dimensions::FromData;
        let all = parvi_targets::catalogue().iter().filter(own);
        let all = all.map(|info| in_dimensions(&TargetSpecification::plain(info.name, None), dims));
        let mut places = all.collect::<Result<Vec<_>, _>>()?;
        places.retain(|place| !place.is_empty());
        return Ok(places);
    };
    not_empty("targets", &listed)?;
    let place = |target: &TargetSpecification| {
        let place = in_dimensions(target, dims)?;
        let missed = || format!("`{}` has none of the dimensions in `dims`", target.name);
        (!place.is_empty())
            .then_some(place)
            .ok_or_else(|| refusal("targets", missed()))
    };
    listed.iter().map(place).collect()
}

/// A target in each of its dimensions that is among `dims`.
fn in_dimensions(target: &TargetSpecification, dims: &[Dimension]) -> Result<Vec<TargetSpecification>, CommandError> {
    let refused = |error: TargetError| refusal("targets", error.to_string());
    let dimensions = target_info(&target.name).map_err(refused)?.dimensions;
    let mut found = Vec::new();
    for &dim in dims {
        let mut here = target.clone();
        here.dim = matches!(dimensions, Dimensions::Range { .. }).then_some(dim);
        let is_there = match dimensions {
            Dimensions::Range { minimum, maximum, .. } => (minimum..=maximum).contains(&dim.get()),
            _ => here.dimension().map_err(refused)? == dim.get(),
        };
        if is_there {
            here.dimension().map_err(refused)?;
            found.push(here);
        }
    }
    Ok(found)
}
