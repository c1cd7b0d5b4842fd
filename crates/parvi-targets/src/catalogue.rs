//! The named targets: what is known about each, and which parameters it has.

use std::path::PathBuf;

use crate::TargetError;
use crate::wells::WELLS_MAXIMUM_DIMENSION;

/// The largest dimension that the catalogue offers.
pub const MAXIMUM_DIMENSION: usize = 8;

/// Values for the parameters of a target; `None` stands for its default.
///
/// A value for a parameter that the target does not have is an error.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Parameters {
    /// R of the correlations R^|i−j| of the Gaussians.
    pub correlation: Option<f64>,
    /// b of the banana.
    pub curvature: Option<f64>,
    /// σ of the banana, the ring, the Rosenbrock density and the mixtures of equal widths; w of the funnel and the cross.
    pub width: Option<f64>,
    /// s of the Rosenbrock density and the cross.
    pub spread: Option<f64>,
    /// r of the ring.
    pub radius: Option<f64>,
    /// ν of the Student t distribution.
    pub degrees_of_freedom: Option<f64>,
    /// The prior's standard deviation for every coefficient of a regression; `f64::INFINITY` for a flat prior.
    pub prior_standard_deviation: Option<f64>,
    /// The seed of a random target.
    pub target_seed: Option<u64>,
    /// The CSV file of a regression.
    pub data: Option<PathBuf>,
}

impl Parameters {
    /// The names and values of the parameters that are set, in the names of the command line.
    pub fn given(&self) -> Vec<(&'static str, String)> {
        let numbers = [
            ("correlation", self.correlation),
            ("curvature", self.curvature),
            ("width", self.width),
            ("spread", self.spread),
            ("radius", self.radius),
            ("degrees-of-freedom", self.degrees_of_freedom),
            ("prior-sd", self.prior_standard_deviation),
        ];
        let seed = self.target_seed.map(|seed| ("target-seed", seed.to_string()));
        let data = self.data.as_ref().map(|path| ("data", path.display().to_string()));
        numbers
            .into_iter()
            .filter_map(|(name, value)| value.map(|value| (name, value.to_string())))
            .chain(seed)
            .chain(data)
            .collect()
    }
}

/// The dimensions in which a target exists.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimensions {
    /// This one only.
    Fixed(usize),
    /// From `minimum` to `maximum`.
    Range {
        /// The smallest.
        minimum: usize,
        /// The largest.
        maximum: usize,
        /// The one meant if none is given; `None` if it has to be given.
        default: Option<usize>,
    },
    /// The number of columns of the data file (the intercept takes the response's place).
    FromData,
}

impl Dimensions {
    /// The dimensions in words, e.g. `2 to 8`.
    pub fn in_words(&self) -> String {
        match *self {
            Self::Fixed(dimension) => dimension.to_string(),
            Self::Range {
                minimum,
                maximum,
                default: None,
            } => format!("{minimum} to {maximum}"),
            Self::Range {
                minimum,
                maximum,
                default: Some(default),
            } => {
                format!("{minimum} to {maximum}, {default} unless given")
            }
            Self::FromData => "the number of columns of the data file".to_owned(),
        }
    }
}

/// A parameter of a target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ParameterInfo {
    /// Its name on the command line, without dashes in front.
    pub name: &'static str,
    /// Its value unless given; `None` if it has to be given.
    pub default: Option<&'static str>,
    /// What it means.
    pub meaning: &'static str,
}

/// What is known about a target of the catalogue.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TargetInfo {
    /// Its name on the command line.
    pub name: &'static str,
    /// The dimensions in which it exists.
    pub dimensions: Dimensions,
    /// Its density in one line.
    pub summary: &'static str,
    /// Its parameters.
    pub parameters: &'static [ParameterInfo],
    /// Whether it has exact draws.
    pub exact_draws: bool,
    /// Whether it has a map from the unit cube, hence quasi-random draws.
    pub unit_cube_transport: bool,
    /// Whether its mean and covariance are known in closed form (for the default parameters).
    pub moments: bool,
    /// The number of its named modes; 1 for a unimodal target.
    pub modes: usize,
    /// Whether log ∫ p is known exactly.
    pub log_evidence: bool,
}

impl TargetInfo {
    /// The error for the first given parameter that this target does not have, or for a missing one that it needs.
    pub(crate) fn check(&self, parameters: &Parameters) -> Result<(), TargetError> {
        let given = parameters.given();
        for (parameter, value) in &given {
            if self.parameters.iter().all(|known| known.name != *parameter) {
                let names: Vec<&str> = self.parameters.iter().map(|known| known.name).collect();
                let allowed = if names.is_empty() {
                    "it has none".to_owned()
                } else {
                    format!("it has {}", names.join(", "))
                };
                return Err(TargetError::ParameterNotAllowed {
                    target: self.name.to_owned(),
                    parameter,
                    value: value.clone(),
                    allowed,
                });
            }
        }
        for known in self.parameters.iter().filter(|known| known.default.is_none()) {
            if given.iter().all(|(parameter, _)| *parameter != known.name) {
                return Err(TargetError::ParameterMissing {
                    target: self.name.to_owned(),
                    parameter: known.name,
                });
            }
        }
        Ok(())
    }
}

/// Every target of the catalogue, in the order of the documentation.
pub fn catalogue() -> &'static [TargetInfo] {
    &CATALOGUE
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
        known: CATALOGUE.map(|info| info.name).join(", "),
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
const fn regression(
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

const PRIOR: ParameterInfo = parameter(
    "prior-sd",
    "10",
    "standard deviation of each coefficient's prior; inf for flat",
);
const MIXTURE_WIDTH: ParameterInfo = parameter("width", "0.5", "standard deviation of each mode");

static CATALOGUE: [TargetInfo; 21] = [
    closed(
        "gaussian",
        any_from(1),
        "N(0, C), C_ij = R^|i-j|",
        &[parameter("correlation", "0", "R, between -1 and 1")],
        1,
    ),
    closed(
        "banana",
        Dimensions::Fixed(2),
        "x1 ~ N(0, 1), x2 ~ N(b (x1^2 - 1), s^2)",
        &[parameter("curvature", "1", "b"), parameter("width", "0.5", "s")],
        1,
    ),
    closed(
        "ring",
        Dimensions::Fixed(2),
        "proportional to exp(-(|x| - r)^2 / 2 s^2)",
        &[parameter("radius", "2", "r"), parameter("width", "0.2", "s")],
        1,
    ),
    closed(
        "mixture-4",
        Dimensions::Fixed(2),
        "four equal Gaussian modes at (+-2, +-2)",
        &[MIXTURE_WIDTH],
        4,
    ),
    closed(
        "mixture-2",
        any_from(1),
        "Gaussian modes at -1.5 e1 and 1.5 e1 with masses 0.3 and 0.7",
        &[MIXTURE_WIDTH],
        2,
    ),
    closed(
        "mixture-3",
        any_from(2),
        "Gaussian modes at -4 e1, 4 e1, 5 e2, widths 0.6, 0.4, 0.5, masses 0.2, 0.5, 0.3",
        &[],
        3,
    ),
    closed(
        "funnel",
        any_from(2),
        "x1 ~ N(0, w^2), xj ~ N(0, exp(x1))",
        &[parameter("width", "1.5", "w, standard deviation of x1")],
        1,
    ),
    closed(
        "student-t",
        any_from(1),
        "multivariate Student t with identity scale",
        &[parameter("degrees-of-freedom", "5", "degrees of freedom")],
        1,
    ),
    closed(
        "rosenbrock",
        any_from(2),
        "x1 ~ N(1, s^2), x2, x4, ... ~ N(x1^2, w^2), x3, x5, ... ~ N(the square of the one before, w^2)",
        &[
            parameter("spread", "1", "s, standard deviation of x1"),
            parameter("width", "0.3", "w, standard deviation about the parabolas"),
        ],
        1,
    ),
    closed(
        "scales",
        any_from(2),
        "Gaussian with standard deviations from 1e-3 to 1e3 in equal ratios and correlations R^|i-j|",
        &[parameter("correlation", "0.5", "R, between -1 and 1")],
        1,
    ),
    closed(
        "cross",
        any_from(2),
        "one Gaussian arm along every axis, crossing at the origin",
        &[
            parameter("spread", "2", "standard deviation along an arm"),
            parameter("width", "0.2", "standard deviation across it"),
        ],
        1,
    ),
    closed(
        "schools",
        any_from(3),
        "the first d-2 of the eight schools: mean, log scale and standardised effects, not centred",
        &[],
        1,
    ),
    TargetInfo {
        moments: false,
        ..closed(
            "random",
            any_from(1),
            "a random shape, place, direction and scale: push-forwards, mixtures and products of simple laws",
            &[parameter("target-seed", "0", "the seed that makes it")],
            1,
        )
    },
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
    },
    closed(
        "shells",
        any_from(2),
        "two Gaussian shells of radius 2 and width 0.1 about -3.5 e1 and 3.5 e1, prior density 12^-d",
        &[],
        2,
    ),
    TargetInfo {
        moments: false,
        ..closed(
            "log-gamma",
            any_from(2),
            "log-gamma and normal laws of width 1/30 about 1/3 and 2/3 in the unit cube, in y = log x/(1 - x)",
            &[],
            4,
        )
    },
    regression(
        "wells",
        Dimensions::Range {
            minimum: 1,
            maximum: WELLS_MAXIMUM_DIMENSION,
            default: None,
        },
        "logistic regression: 3,020 households in Bangladesh change wells or not",
        &[PRIOR],
    ),
    regression(
        "wells-small",
        Dimensions::Range {
            minimum: 1,
            maximum: WELLS_MAXIMUM_DIMENSION,
            default: Some(5),
        },
        "logistic regression: the first 40 households of wells, a skewed posterior",
        &[PRIOR],
    ),
    regression(
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
    ),
    regression(
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
    ),
    regression(
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
    ),
];
