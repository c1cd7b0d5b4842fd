//! What makes targets of the catalogue.

use std::any::Any;
use std::path::Path;

use super::info::Parameters;
use crate::regression::DEFAULT_PRIOR_STANDARD_DEVIATION;
use crate::{BoxedTarget, CatalogueTarget, Link, Regression, RegressionTable, Response, TargetError};

/// The data of the file that is given, or else the target's own.
pub(crate) fn file_or<Y: Response>(
    parameters: &Parameters,
    own: impl FnOnce() -> Result<RegressionTable<Y>, TargetError>,
) -> Result<RegressionTable<Y>, TargetError> {
    match &parameters.data {
        Some(path) => RegressionTable::from_csv_file(path),
        None => own(),
    }
}

/// A regression with the prior that is given.
pub(crate) fn regression<L: Link, const D: usize>(
    name: &str,
    data: RegressionTable<L::Response>,
    parameters: &Parameters,
) -> Result<BoxedTarget<D>, TargetError> {
    let prior = parameters
        .prior_standard_deviation
        .unwrap_or(DEFAULT_PRIOR_STANDARD_DEVIATION);
    Ok(Box::new(Regression::<L, D>::with_prior(name, data, prior)?))
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
        .map_err(|_| TargetError::DimensionNotAllowed {
            target: name,
            dimension: D,
            allowed: E.to_string(),
        })
}

/// The data file, which the target needs.
pub(crate) fn data_path<'a>(name: &str, parameters: &'a Parameters) -> Result<&'a Path, TargetError> {
    parameters.data.as_deref().ok_or_else(|| TargetError::ParameterMissing {
        target: name.to_owned(),
        parameter: "data",
    })
}
