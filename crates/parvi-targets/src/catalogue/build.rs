//! From a name and parameters to a target.

use std::path::Path;

use super::info::{Dimensions, MAXIMUM_DIMENSION, Parameters};
use super::making::{data_path, no_dimension};
use super::synthetic::synthetic_counts;
use super::table::{make, target_info};
use super::wells::wells;
use crate::{BoxedTarget, CountData, RegressionData, TargetError};

/// The dimension of a target: `requested` if it exists there, else its only or its default dimension.
///
/// Where a data file is given it is read, and its columns decide.
///
/// # Errors
/// [`TargetError::UnknownTarget`]; [`TargetError::ParameterNotAllowed`] and [`TargetError::ParameterMissing`];
/// [`TargetError::DimensionMissing`] where one has to be given; [`TargetError::DimensionNotAllowed`]; the errors of
/// [`RegressionData::from_csv_file`].
pub fn dimension_of(name: &str, requested: Option<usize>, parameters: &Parameters) -> Result<usize, TargetError> {
    let info = target_info(name)?;
    info.check(parameters)?;
    let not_allowed = |dimension, allowed| no_dimension(name, dimension, allowed);
    if let Some(dimension) = requested.filter(|dimension| !(1..=MAXIMUM_DIMENSION).contains(dimension)) {
        return Err(not_allowed(dimension, info.dimensions.in_words()));
    }
    let dimensions = match parameters.data {
        Some(_) => Dimensions::FromData,
        None => info.dimensions,
    };
    let (only, allowed) = match dimensions {
        Dimensions::Fixed(only) => (only, info.dimensions.in_words()),
        Dimensions::FromData => {
            let path = data_path(name, parameters)?;
            let dimension = columns_of(name, path)?.len();
            (
                dimension,
                format!("{dimension}, the number of columns of {}", path.display()),
            )
        }
        Dimensions::Range {
            minimum,
            maximum,
            default,
        } => {
            let allowed = info.dimensions.in_words();
            return match requested.or(default) {
                Some(dimension) if (minimum..=maximum).contains(&dimension) => Ok(dimension),
                Some(dimension) => Err(not_allowed(dimension, allowed)),
                None => Err(TargetError::DimensionMissing {
                    target: name.to_owned(),
                    allowed,
                }),
            };
        }
    };
    match requested {
        Some(dimension) if dimension != only => Err(not_allowed(dimension, allowed)),
        _ => Ok(only),
    }
}

/// The target of a name, in dimension D.
///
/// # Errors
/// As [`dimension_of`] for `requested` = D, and those of the target's constructor.
pub fn build<const D: usize>(name: &str, parameters: &Parameters) -> Result<BoxedTarget<D>, TargetError> {
    (Builder::of().0)(name, parameters)
}

/// [`build`], generated where it is called.
fn built<const D: usize>(name: &str, parameters: &Parameters) -> Result<BoxedTarget<D>, TargetError> {
    dimension_of(name, Some(D), parameters)?;
    make(name, parameters)
}

/// [`build`] in one dimension.
struct Builder<const D: usize>(fn(&str, &Parameters) -> Result<BoxedTarget<D>, TargetError>);

impl<const D: usize> Builder<D> {
    /// Generated where it is named.
    const HERE: Self = Self(built);
}

mpm_parallel::compiled_ahead!(Builder);

/// The names of a target's coordinates, where they have names of their own: the covariates of a regression, the parameters
/// of a model. `None` where they are x₁, …, x_d.
///
/// # Errors
/// As [`dimension_of`].
pub fn coordinate_names(
    name: &str,
    requested: Option<usize>,
    parameters: &Parameters,
) -> Result<Option<Vec<String>>, TargetError> {
    let dimension = dimension_of(name, requested, parameters)?;
    Ok(match (&parameters.data, name) {
        (Some(path), _) => Some(columns_of(name, path)?),
        (None, "wells" | "wells-small" | "probit") => Some(wells(dimension, None)?.names().to_vec()),
        (None, "poisson") => Some(synthetic_counts(dimension)?.names().to_vec()),
        (None, "schools") => {
            let effects = (1..=dimension - 2).map(|school| format!("η_{{{school}}}"));
            Some(["μ", "log τ"].map(str::to_owned).into_iter().chain(effects).collect())
        }
        _ => crate::catalogue::posteriordb::coordinate_names(name)
            .or_else(|| crate::catalogue::sbibm::coordinate_names(name)),
    })
}

/// The columns of a data file, `intercept` first.
fn columns_of(name: &str, path: &Path) -> Result<Vec<String>, TargetError> {
    Ok(if name == "poisson" {
        CountData::from_csv_file(path)?.names().to_vec()
    } else {
        RegressionData::from_csv_file(path)?.names().to_vec()
    })
}
