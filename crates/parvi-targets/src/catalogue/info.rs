//! The named targets: what is known about each, and which parameters it has.

use std::path::PathBuf;

use crate::TargetError;

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
    /// The command line of a program that evaluates the density.
    pub program: Option<String>,
}

impl Parameters {
    /// The parameters that are numbers, by the names of the command line.
    pub(crate) fn numbers(&self) -> [(&'static str, Option<f64>); 7] {
        [
            ("correlation", self.correlation),
            ("curvature", self.curvature),
            ("width", self.width),
            ("spread", self.spread),
            ("radius", self.radius),
            ("degrees-of-freedom", self.degrees_of_freedom),
            ("prior-sd", self.prior_standard_deviation),
        ]
    }

    /// The names and values of the parameters that are set, in the names of the command line.
    pub fn given(&self) -> Vec<(&'static str, String)> {
        let numbers = self.numbers().into_iter();
        let numbers = numbers.filter_map(|(name, value)| Some((name, value?.to_string())));
        let seed = self.target_seed.map(|seed| ("target-seed", seed.to_string()));
        let data = self.data.as_ref().map(|path| ("data", path.display().to_string()));
        let program = self.program.iter().map(|command| ("program", command.clone()));
        numbers.chain(seed).chain(data).chain(program).collect()
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
        let names: Vec<&str> = self.parameters.iter().map(|known| known.name).collect();
        if let Some((parameter, value)) = given.iter().find(|(parameter, _)| !names.contains(parameter)) {
            return Err(TargetError::ParameterNotAllowed {
                target: self.name.to_owned(),
                parameter,
                value: value.clone(),
                allowed: match names[..] {
                    [] => "it has none".to_owned(),
                    _ => format!("it has {}", names.join(", ")),
                },
            });
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
