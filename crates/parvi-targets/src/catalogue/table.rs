//! The targets by name: what is known of each, and how it is made. A new target is a file, and its entry here.

use super::info::{Dimensions, MAXIMUM_DIMENSION, ParameterInfo, Parameters, TargetInfo};
use super::making::{boxed, data_path, file_or, in_dimension, regression};
use super::synthetic::synthetic_counts;
use super::wells::{WELLS_MAXIMUM_DIMENSION, WELLS_SMALL_ROWS, wells};
use crate::{
    Arma, Banana, BoxedTarget, Cross, Eggbox, Funnel, Garch, Gaussian, GaussianMixture, GaussianProcess,
    GaussianShells, HiddenMarkov, LinearModel, LogGamma, Logarithm, Logit, LotkaVolterra, NestedNormals, NormalMixture,
    Probit, RandomTarget, RegressionData, Ring, Rosenbrock, Schools, SimpleLikelihood, SpikeSlab, StudentT,
    TargetError, TwoMoons,
};

/// Every target of the catalogue, in the order of the documentation.
pub fn catalogue() -> &'static [TargetInfo] {
    CATALOGUE
}

/// The entry of a name.
///
/// # Errors
/// [`TargetError::UnknownTarget`], which lists the names that exist.
pub fn target_info(name: &str) -> Result<&'static TargetInfo, TargetError> {
    CATALOGUE
        .iter()
        .find(|info| info.name == name)
        .ok_or_else(|| unknown_target(name))
}

/// The error that lists the names that exist.
pub(crate) fn unknown_target(name: &str) -> TargetError {
    TargetError::UnknownTarget {
        name: name.to_owned(),
        known: CATALOGUE.iter().map(|info| info.name).collect::<Vec<_>>().join(", "),
    }
}

const fn parameter(name: &'static str, default: &'static str, meaning: &'static str) -> ParameterInfo {
    ParameterInfo {
        name,
        default: Some(default),
        meaning,
    }
}

const fn any_from(minimum: usize) -> Dimensions {
    Dimensions::Range {
        minimum,
        maximum: MAXIMUM_DIMENSION,
        default: None,
    }
}

/// An entry with exact draws, transport and moments.
const fn closed(
    name: &'static str,
    dimensions: Dimensions,
    summary: &'static str,
    parameters: &'static [ParameterInfo],
    modes: usize,
) -> TargetInfo {
    TargetInfo {
        name,
        dimensions,
        summary,
        parameters,
        exact_draws: true,
        unit_cube_transport: true,
        moments: true,
        modes,
        log_evidence: true,
    }
}

/// A regression on embedded data or a file.
const fn of_data(
    name: &'static str,
    dimensions: Dimensions,
    summary: &'static str,
    parameters: &'static [ParameterInfo],
) -> TargetInfo {
    TargetInfo {
        name,
        dimensions,
        summary,
        parameters,
        exact_draws: false,
        unit_cube_transport: false,
        moments: false,
        modes: 1,
        log_evidence: false,
    }
}

/// A posterior of the benchmark of simulation-based inference.
const fn of_simulator(name: &'static str, dimension: usize, summary: &'static str, modes: usize) -> TargetInfo {
    TargetInfo {
        exact_draws: true,
        modes,
        log_evidence: true,
        ..of_data(name, Dimensions::Fixed(dimension), summary, &[])
    }
}

const fn two_moons(name: &'static str) -> TargetInfo {
    of_simulator(
        name,
        2,
        "two crescents with straight ends, in log odds of a box (sbibm)",
        2,
    )
}

const fn nested_normals(name: &'static str) -> TargetInfo {
    of_simulator(
        name,
        2,
        "a peak on another ten times as wide, in log odds of a box (sbibm)",
        1,
    )
}

const fn simple_likelihood(name: &'static str) -> TargetInfo {
    let summary = "mean and covariance of four points in the plane, four equal parts, in log odds of a box (sbibm)";
    of_simulator(name, 5, summary, 4)
}

const PRIOR: ParameterInfo = parameter(
    "prior-sd",
    "10",
    "standard deviation of each coefficient's prior; inf for flat",
);
const MIXTURE_WIDTH: ParameterInfo = parameter("width", "0.5", "standard deviation of each mode");

/// What is known of the targets, and what makes one in dimension D.
macro_rules! targets {
    (($name:ident, $parameters:ident, $dimension:ident); $($info:expr => $build:expr;)*) => {
        /// Every target, in the order of the documentation.
        static CATALOGUE: &[TargetInfo] = &[$($info,)*];

        /// A target in one dimension, which is one of its own.
        pub(crate) fn make<const $dimension: usize>(
            $name: &str,
            $parameters: &Parameters,
        ) -> Result<BoxedTarget<$dimension>, TargetError> {
            $({
                const INFO: TargetInfo = $info;
                if $name == INFO.name {
                    return $build;
                }
            })*
            Err(unknown_target($name))
        }
    };
}

targets! {
    (name, parameters, D);
    closed(
        "gaussian",
        any_from(1),
        "N(0, C), C_ij = R^|i-j|",
        &[parameter("correlation", "0", "R, between -1 and 1")],
        1,
    ) => boxed(Gaussian::<D>::autoregressive(
            parameters.correlation.unwrap_or(0.0),
        ));
    closed(
        "banana",
        Dimensions::Fixed(2),
        "x1 ~ N(0, 1), x2 ~ N(b (x1^2 - 1), s^2)",
        &[parameter("curvature", "1", "b"), parameter("width", "0.5", "s")],
        1,
    ) => in_dimension(Banana::new(
            parameters.curvature.unwrap_or(1.0),
            parameters.width.unwrap_or(0.5),
        ));
    closed(
        "ring",
        Dimensions::Fixed(2),
        "proportional to exp(-(|x| - r)^2 / 2 s^2)",
        &[parameter("radius", "2", "r"), parameter("width", "0.2", "s")],
        1,
    ) => in_dimension(Ring::new(
            parameters.radius.unwrap_or(2.0),
            parameters.width.unwrap_or(0.2),
        ));
    closed(
        "mixture-4",
        Dimensions::Fixed(2),
        "four equal Gaussian modes at (+-2, +-2)",
        &[MIXTURE_WIDTH],
        4,
    ) => in_dimension(GaussianMixture::<2>::four_equal(parameters.width.unwrap_or(0.5)));
    closed(
        "mixture-2",
        any_from(1),
        "Gaussian modes at -1.5 e1 and 1.5 e1 with masses 0.3 and 0.7",
        &[MIXTURE_WIDTH],
        2,
    ) => boxed(GaussianMixture::<D>::two_unequal(
            parameters.width.unwrap_or(0.5),
        ));
    closed(
        "mixture-3",
        any_from(2),
        "Gaussian modes at -4 e1, 4 e1, 5 e2, widths 0.6, 0.4, 0.5, masses 0.2, 0.5, 0.3",
        &[],
        3,
    ) => boxed(GaussianMixture::<D>::three_far());
    closed(
        "funnel",
        any_from(2),
        "x1 ~ N(0, w^2), xj ~ N(0, exp(x1))",
        &[parameter("width", "1.5", "w, standard deviation of x1")],
        1,
    ) => boxed(Funnel::<D>::new(parameters.width.unwrap_or(1.5)));
    closed(
        "student-t",
        any_from(1),
        "multivariate Student t with identity scale",
        &[parameter("degrees-of-freedom", "5", "degrees of freedom")],
        1,
    ) => boxed(StudentT::<D>::new(
            parameters.degrees_of_freedom.unwrap_or(5.0),
        ));
    closed(
        "rosenbrock",
        any_from(2),
        "x1 ~ N(1, s^2), x2, x4, ... ~ N(x1^2, w^2), x3, x5, ... ~ N(the square of the one before, w^2)",
        &[
            parameter("spread", "1", "s, standard deviation of x1"),
            parameter("width", "0.3", "w, standard deviation about the parabolas"),
        ],
        1,
    ) => boxed(Rosenbrock::<D>::new(
            parameters.spread.unwrap_or(1.0),
            parameters.width.unwrap_or(0.3),
        ));
    closed(
        "scales",
        any_from(2),
        "Gaussian with standard deviations from 1e-3 to 1e3 in equal ratios and correlations R^|i-j|",
        &[parameter("correlation", "0.5", "R, between -1 and 1")],
        1,
    ) => boxed(Gaussian::<D>::scales(parameters.correlation.unwrap_or(0.5)));
    closed(
        "cross",
        any_from(2),
        "one Gaussian arm along every axis, crossing at the origin",
        &[
            parameter("spread", "2", "standard deviation along an arm"),
            parameter("width", "0.2", "standard deviation across it"),
        ],
        1,
    ) => boxed(Cross::<D>::new(
            parameters.spread.unwrap_or(2.0),
            parameters.width.unwrap_or(0.2),
        ));
    closed(
        "schools",
        any_from(3),
        "the first d-2 of the eight schools: mean, log scale and standardised effects, not centred",
        &[],
        1,
    ) => boxed(Schools::<D>::new());
    TargetInfo {
        moments: false,
        ..closed(
            "random",
            any_from(1),
            "a random shape, place, direction and scale: push-forwards, mixtures and products of simple laws",
            &[parameter("target-seed", "0", "the seed that makes it")],
            1,
        )
    } => boxed(RandomTarget::<D>::new(parameters.target_seed.unwrap_or(0)));
    TargetInfo {
        moments: false,
        unit_cube_transport: false,
        ..closed(
            "eggbox",
            Dimensions::Fixed(2),
            "likelihood exp((2 + cos(x1/2) cos(x2/2))^5), x uniform on [0, 10 pi]^2, in y = log x/(10 pi - x)",
            &[],
            1,
        )
    } => in_dimension(Eggbox::new());
    closed(
        "shells",
        any_from(2),
        "two Gaussian shells of radius 2 and width 0.1 about -3.5 e1 and 3.5 e1, prior density 12^-d",
        &[],
        2,
    ) => boxed(GaussianShells::<D>::new());
    TargetInfo {
        moments: false,
        ..closed(
            "log-gamma",
            any_from(2),
            "log-gamma and normal laws of width 1/30 about 1/3 and 2/3 in the unit cube, in y = log x/(1 - x)",
            &[],
            4,
        )
    } => boxed(LogGamma::<D>::new());
    closed(
        "spike-slab",
        any_from(1),
        "100 N(0.031, 0.01^2 I) + N(0, 0.1^2 I), prior density 1",
        &[],
        1,
    ) => boxed(SpikeSlab::<D>::new());
    of_data(
        "wells",
        Dimensions::Range {
            minimum: 1,
            maximum: WELLS_MAXIMUM_DIMENSION,
            default: None,
        },
        "logistic regression: 3,020 households in Bangladesh change wells or not",
        &[PRIOR],
    ) => regression::<Logit, D>(name, wells(D, None)?, parameters);
    of_data(
        "wells-small",
        Dimensions::Range {
            minimum: 1,
            maximum: WELLS_MAXIMUM_DIMENSION,
            default: Some(5),
        },
        "logistic regression: the first 40 households of wells, a skewed posterior",
        &[PRIOR],
    ) => regression::<Logit, D>(name, wells(D, Some(WELLS_SMALL_ROWS))?, parameters);
    of_data(
        "probit",
        Dimensions::Range {
            minimum: 1,
            maximum: WELLS_MAXIMUM_DIMENSION,
            default: Some(5),
        },
        "probit regression on the rows of wells-small, or on a CSV file as for logistic",
        &[
            parameter(
                "data",
                "the rows of wells-small",
                "a CSV file instead; it fixes the dimension",
            ),
            PRIOR,
        ],
    ) => {
            let data = file_or(parameters, || wells(D, Some(WELLS_SMALL_ROWS)))?;
            regression::<Probit, D>(name, data, parameters)
        };
    of_data(
        "poisson",
        any_from(1),
        "Poisson regression with logarithmic link on 40 synthetic counts, or on a CSV file: the count first",
        &[
            parameter(
                "data",
                "the synthetic counts",
                "a CSV file instead; it fixes the dimension",
            ),
            PRIOR,
        ],
    ) => {
            let data = file_or(parameters, || synthetic_counts(D))?;
            regression::<Logarithm, D>(name, data, parameters)
        };
    of_data(
        "logistic",
        Dimensions::FromData,
        "logistic regression on a CSV file: 0/1 response first, then covariates; an intercept is added",
        &[
            ParameterInfo {
                name: "data",
                default: None,
                meaning: "the CSV file",
            },
            PRIOR,
        ],
    ) => {
            let path = data_path(name, parameters)?;
            regression::<Logit, D>(name, RegressionData::from_csv_file(path)?, parameters)
        };
    of_data(
        "arma",
        Dimensions::Fixed(4),
        "autoregressive moving average of order (1, 1), a series of 200 (posteriordb)",
        &[],
    ) => in_dimension(Arma::posterior());
    of_data(
        "garch",
        Dimensions::Fixed(4),
        "a series of 200 whose variance depends on the past: GARCH(1, 1) (posteriordb)",
        &[],
    ) => in_dimension(Garch::posterior());
    of_data(
        "gaussian-process",
        Dimensions::Fixed(3),
        "length, height and noise of a Gaussian process through 11 points (posteriordb)",
        &[],
    ) => in_dimension(GaussianProcess::posterior());
    of_data(
        "hidden-markov",
        Dimensions::Fixed(4),
        "transitions and means of a hidden Markov model of two states, a series of 100 (posteriordb)",
        &[],
    ) => in_dimension(HiddenMarkov::posterior());
    of_data(
        "gaussian-mixture-posterior",
        Dimensions::Fixed(5),
        "means, widths and masses of two normal distributions, fitted to 1,000 numbers (posteriordb)",
        &[],
    ) => in_dimension(NormalMixture::posterior());
    of_data(
        "kidscore",
        Dimensions::Fixed(5),
        "linear model: test scores of 434 children by their mothers' schooling and intelligence (posteriordb)",
        &[],
    ) => in_dimension(LinearModel::kidscore());
    of_data(
        "mesquite",
        Dimensions::Fixed(5),
        "linear model of logarithms: leaf weight of 46 mesquite bushes by their size (posteriordb)",
        &[],
    ) => in_dimension(LinearModel::mesquite());
    of_data(
        "blr",
        Dimensions::Fixed(6),
        "linear model: 100 responses to five strongly correlated covariates (posteriordb)",
        &[],
    ) => in_dimension(LinearModel::blr());
    of_data(
        "lotka-volterra",
        Dimensions::Fixed(8),
        "predator-prey equations of hares and lynxes, 21 years (posteriordb)",
        &[],
    ) => in_dimension(LotkaVolterra::posterior());
    two_moons("sbibm-two-moons-1") => in_dimension(TwoMoons::posterior(1));
    two_moons("sbibm-two-moons-2") => in_dimension(TwoMoons::posterior(2));
    two_moons("sbibm-two-moons-3") => in_dimension(TwoMoons::posterior(3));
    nested_normals("sbibm-gaussian-mixture-1") => in_dimension(NestedNormals::posterior(1));
    nested_normals("sbibm-gaussian-mixture-2") => in_dimension(NestedNormals::posterior(2));
    nested_normals("sbibm-gaussian-mixture-3") => in_dimension(NestedNormals::posterior(3));
    simple_likelihood("sbibm-slcp-1") => in_dimension(SimpleLikelihood::posterior(1));
    simple_likelihood("sbibm-slcp-2") => in_dimension(SimpleLikelihood::posterior(2));
    simple_likelihood("sbibm-slcp-3") => in_dimension(SimpleLikelihood::posterior(3));
    simple_likelihood("sbibm-slcp-4") => in_dimension(SimpleLikelihood::posterior(4));
    simple_likelihood("sbibm-slcp-5") => in_dimension(SimpleLikelihood::posterior(5));
}
