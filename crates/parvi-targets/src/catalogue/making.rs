//! What makes targets of the catalogue.

use std::any::Any;
use std::ops::RangeInclusive;
use std::path::Path;

use super::info::{Parameters, TargetInfo};
use crate::{BoxedTarget, CatalogueTarget, Link, Regression, RegressionTable, Response, TargetError};

/// The values of a target's parameters: those that are given, and the defaults of its entry.
pub(crate) struct Values<'a> {
    /// What is known of the target.
    pub info: &'static TargetInfo,
    /// What is given.
    pub parameters: &'a Parameters,
}

impl Values<'_> {
    /// A parameter that is a number; not a number for one that the target does not have.
    pub fn number(&self, name: &str) -> f64 {
        let given = self.parameters.numbers().into_iter().find(|(known, _)| *known == name);
        let default = || self.info.parameters.iter().find(|known| known.name == name)?.default;
        let given = given.and_then(|(_, value)| value);
        given.unwrap_or_else(|| default().and_then(|value| value.parse().ok()).unwrap_or(f64::NAN))
    }

    /// The data of the file that is given, or else the target's own.
    pub fn file_or<Y: Response>(
        &self,
        own: impl FnOnce() -> Result<RegressionTable<Y>, TargetError>,
    ) -> Result<RegressionTable<Y>, TargetError> {
        match &self.parameters.data {
            Some(path) => RegressionTable::from_csv_file(path),
            None => own(),
        }
    }

    /// The data file, which the target needs.
    pub fn data_path(&self) -> Result<&Path, TargetError> {
        data_path(self.info.name, self.parameters)
    }

    /// A regression on data, with the prior that is given.
    pub fn regression<L: Link, const D: usize>(
        &self,
        data: RegressionTable<L::Response>,
    ) -> Result<BoxedTarget<D>, TargetError> {
        boxed(Regression::<L, D>::with_prior(
            self.info.name,
            data,
            self.number("prior-sd"),
        ))
    }
}

/// A target as one of the catalogue.
pub(crate) fn boxed<const D: usize>(
    target: Result<impl CatalogueTarget<D> + Send + Sync + 'static, TargetError>,
) -> Result<BoxedTarget<D>, TargetError> {
    Ok(Box::new(target?))
}

/// A target of dimension E as one of dimension D, which are the same type where D = E.
pub(crate) fn in_dimension<const D: usize, const E: usize>(
    target: Result<impl CatalogueTarget<E> + Send + Sync + 'static, TargetError>,
) -> Result<BoxedTarget<D>, TargetError> {
    let target: BoxedTarget<E> = boxed(target)?;
    let name = target.name().to_owned();
    let same: Box<dyn Any> = Box::new(target);
    same.downcast::<BoxedTarget<D>>()
        .map(|target| *target)
        .map_err(|_| no_dimension(&name, D, E.to_string()))
}

/// The error that a target does not exist in a dimension.
pub(crate) fn no_dimension(target: &str, dimension: usize, allowed: String) -> TargetError {
    TargetError::DimensionNotAllowed {
        target: target.to_owned(),
        dimension,
        allowed,
    }
}

/// Refuses a dimension beyond those in which a target exists.
pub(crate) fn dimension_within(
    target: &str,
    dimension: usize,
    allowed: RangeInclusive<usize>,
) -> Result<(), TargetError> {
    if allowed.contains(&dimension) {
        return Ok(());
    }
    let (least, most) = (allowed.start(), allowed.end());
    Err(no_dimension(target, dimension, format!("{least} to {most}")))
}

/// The data file, which the target needs.
pub(crate) fn data_path<'a>(name: &str, parameters: &'a Parameters) -> Result<&'a Path, TargetError> {
    parameters.data.as_deref().ok_or_else(|| TargetError::ParameterMissing {
        target: name.to_owned(),
        parameter: "data",
    })
}
