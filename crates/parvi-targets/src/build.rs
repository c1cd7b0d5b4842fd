//! From a name and parameters to a target.

use std::any::Any;
use std::path::Path;

use crate::catalogue::{Dimensions, MAXIMUM_DIMENSION, Parameters, TargetInfo, target_info, unknown_target};
use crate::regression::DEFAULT_PRIOR_STANDARD_DEVIATION;
use crate::synthetic::synthetic_counts;
use crate::wells::{WELLS_SMALL_ROWS, wells};
use crate::{
    Banana, CatalogueTarget, CountData, Cross, Eggbox, Funnel, Gaussian, GaussianMixture, GaussianShells, Link,
    LogGamma, Logarithm, Logit, Probit, RandomTarget, Regression, RegressionData, RegressionTable, Response, Ring,
    Rosenbrock, Schools, StudentT, TargetError,
};

/// A target of the catalogue, whichever it is.
pub type BoxedTarget<const D: usize> = Box<dyn CatalogueTarget<D> + Send + Sync>;

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
    let not_allowed = |dimension, allowed| TargetError::DimensionNotAllowed {
        target: name.to_owned(),
        dimension,
        allowed,
    };
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
            let path = data_path(info, parameters)?;
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
    let builder = BUILDERS.iter().find_map(|builder| builder.downcast_ref::<Builder<D>>());
    match builder {
        Some(Builder(build)) => build(name, parameters),
        None => dimension_of(name, Some(D), parameters).and(Err(unknown_target(name))),
    }
}

/// [`build`] in one dimension.
struct Builder<const D: usize>(fn(&str, &Parameters) -> Result<BoxedTarget<D>, TargetError>);

/// Those of all dimensions: the targets are compiled here, once for all crates that build them.
static BUILDERS: [&(dyn Any + Send + Sync); MAXIMUM_DIMENSION] = [
    &Builder::<1>(build_here),
    &Builder::<2>(build_here),
    &Builder::<3>(build_here),
    &Builder::<4>(build_here),
    &Builder::<5>(build_here),
    &Builder::<6>(build_here),
    &Builder::<7>(build_here),
    &Builder::<8>(build_here),
];

fn build_here<const D: usize>(name: &str, parameters: &Parameters) -> Result<BoxedTarget<D>, TargetError> {
    dimension_of(name, Some(D), parameters)?;
    match name {
        "gaussian" => Ok(Box::new(Gaussian::<D>::autoregressive(
            parameters.correlation.unwrap_or(0.0),
        )?)),
        "mixture-2" => Ok(Box::new(GaussianMixture::<D>::two_unequal(
            parameters.width.unwrap_or(0.5),
        )?)),
        "mixture-3" => Ok(Box::new(GaussianMixture::<D>::three_far()?)),
        "funnel" => Ok(Box::new(Funnel::<D>::new(parameters.width.unwrap_or(1.5))?)),
        "student-t" => Ok(Box::new(StudentT::<D>::new(
            parameters.degrees_of_freedom.unwrap_or(5.0),
        )?)),
        "rosenbrock" => Ok(Box::new(Rosenbrock::<D>::new(
            parameters.spread.unwrap_or(1.0),
            parameters.width.unwrap_or(0.3),
        )?)),
        "scales" => Ok(Box::new(Gaussian::<D>::scales(parameters.correlation.unwrap_or(0.5))?)),
        "cross" => Ok(Box::new(Cross::<D>::new(
            parameters.spread.unwrap_or(2.0),
            parameters.width.unwrap_or(0.2),
        )?)),
        "schools" => Ok(Box::new(Schools::<D>::new()?)),
        "random" => Ok(Box::new(RandomTarget::<D>::new(parameters.target_seed.unwrap_or(0))?)),
        "shells" => Ok(Box::new(GaussianShells::<D>::new()?)),
        "log-gamma" => Ok(Box::new(LogGamma::<D>::new()?)),
        "wells" => regression::<Logit, D>(name, wells(D, None)?, parameters),
        "wells-small" => regression::<Logit, D>(name, wells(D, Some(WELLS_SMALL_ROWS))?, parameters),
        "probit" => {
            let data = file_or(parameters, || wells(D, Some(WELLS_SMALL_ROWS)))?;
            regression::<Probit, D>(name, data, parameters)
        }
        "poisson" => {
            let data = file_or(parameters, || synthetic_counts(D))?;
            regression::<Logarithm, D>(name, data, parameters)
        }
        "logistic" => {
            let path = data_path(target_info(name)?, parameters)?;
            regression::<Logit, D>(name, RegressionData::from_csv_file(path)?, parameters)
        }
        _ => in_dimension(build_planar(name, parameters)?),
    }
}

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
        _ => None,
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

/// The data of the file that is given, or else the target's own.
fn file_or<Y: Response>(
    parameters: &Parameters,
    own: impl FnOnce() -> Result<RegressionTable<Y>, TargetError>,
) -> Result<RegressionTable<Y>, TargetError> {
    match &parameters.data {
        Some(path) => RegressionTable::from_csv_file(path),
        None => own(),
    }
}

fn regression<L: Link, const D: usize>(
    name: &str,
    data: RegressionTable<L::Response>,
    parameters: &Parameters,
) -> Result<BoxedTarget<D>, TargetError> {
    let prior = parameters
        .prior_standard_deviation
        .unwrap_or(DEFAULT_PRIOR_STANDARD_DEVIATION);
    Ok(Box::new(Regression::<L, D>::with_prior(name, data, prior)?))
}

/// The targets that exist in the plane only.
fn build_planar(name: &str, parameters: &Parameters) -> Result<BoxedTarget<2>, TargetError> {
    Ok(match name {
        "banana" => Box::new(Banana::new(
            parameters.curvature.unwrap_or(1.0),
            parameters.width.unwrap_or(0.5),
        )?),
        "ring" => Box::new(Ring::new(
            parameters.radius.unwrap_or(2.0),
            parameters.width.unwrap_or(0.2),
        )?),
        "eggbox" => Box::new(Eggbox::new()?),
        "mixture-4" => Box::new(GaussianMixture::<2>::four_equal(parameters.width.unwrap_or(0.5))?),
        _ => return Err(unknown_target(name)),
    })
}

/// A target of dimension 2 as one of dimension D, which are the same type where D = 2.
fn in_dimension<const D: usize>(target: BoxedTarget<2>) -> Result<BoxedTarget<D>, TargetError> {
    let name = target.name().to_owned();
    let same: Box<dyn Any> = Box::new(target);
    same.downcast::<BoxedTarget<D>>()
        .map(|target| *target)
        .map_err(|_| TargetError::DimensionNotAllowed {
            target: name,
            dimension: D,
            allowed: "2".to_owned(),
        })
}

fn data_path<'a>(info: &TargetInfo, parameters: &'a Parameters) -> Result<&'a Path, TargetError> {
    parameters.data.as_deref().ok_or_else(|| TargetError::ParameterMissing {
        target: info.name.to_owned(),
        parameter: "data",
    })
}
