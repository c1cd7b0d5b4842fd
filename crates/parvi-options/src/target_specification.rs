//! A target with its dimension and parameters, as flags or as a configuration states it.

use std::path::{Path, PathBuf};

use clap::Args;
use parvi_targets::{BoxedTarget, Parameters, TargetError};
use serde::Deserialize;

use super::{Dimension, checked_when_read};

/// Parameters of the targets; `None`: the target's own default.
#[derive(Args, Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
#[command(next_help_heading = "Parameters of the target")]
pub struct TargetParameters {
    /// Correlation R of neighbouring axes, R^|i-j| (gaussian, scales)
    #[arg(long, value_name = "R")]
    pub correlation: Option<f64>,
    /// Curvature b (banana)
    #[arg(long, value_name = "B")]
    pub curvature: Option<f64>,
    /// Width: standard deviation across the curve, the ring, an arm or a mode, of the funnel's mouth (banana, ring, mixture-*, funnel, rosenbrock, cross)
    #[arg(long, value_name = "SIGMA")]
    pub width: Option<f64>,
    /// Standard deviation along the curve or an arm (rosenbrock, cross)
    #[arg(long, value_name = "S")]
    pub spread: Option<f64>,
    /// Radius of the ring (ring)
    #[arg(long)]
    pub radius: Option<f64>,
    /// Degrees of freedom (student-t)
    #[arg(long, value_name = "NU")]
    pub degrees_of_freedom: Option<f64>,
    /// Seed that makes the target (random)
    #[arg(long, value_name = "SEED", value_parser = super::seed)]
    pub target_seed: Option<u64>,
    /// Standard deviation of the Gaussian prior of each coefficient (wells, wells-small, probit, poisson, logistic)
    #[arg(long, value_name = "SD")]
    pub prior_sd: Option<f64>,
    /// Data: a header, the 0/1 response (poisson: a count) first, then the covariates (logistic, probit, poisson)
    #[arg(long, value_name = "FILE.csv")]
    pub data: Option<PathBuf>,
    /// Program that answers with log densities and scores, a command line for the shell (program)
    #[arg(long, value_name = "COMMAND")]
    pub program: Option<String>,
}

impl TargetParameters {
    /// The same for the catalogue.
    pub fn to_catalogue(&self) -> Parameters {
        Parameters {
            correlation: self.correlation,
            curvature: self.curvature,
            width: self.width,
            spread: self.spread,
            radius: self.radius,
            degrees_of_freedom: self.degrees_of_freedom,
            prior_standard_deviation: self.prior_sd,
            target_seed: self.target_seed,
            data: self.data.clone(),
            program: self.program.clone(),
        }
    }
}

/// `{ name = "gaussian", dim = 4, parameters = { correlation = 0.5 } }`; an unknown name or a dimension that the
/// target does not have is refused while reading.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(remote = "Self", deny_unknown_fields)]
pub struct TargetSpecification {
    /// The name in the catalogue.
    pub name: String,
    /// The dimension, where the target leaves it free.
    pub dim: Option<Dimension>,
    /// The parameters.
    #[serde(default)]
    pub parameters: TargetParameters,
}

checked_when_read!(TargetSpecification);

impl TargetSpecification {
    fn check(&self) -> Result<(), TargetError> {
        self.dimension().map(|_| ())
    }

    /// A target with its default parameters.
    pub fn plain(name: &str, dim: Option<Dimension>) -> Self {
        Self {
            name: name.to_owned(),
            dim,
            parameters: TargetParameters::default(),
        }
    }

    /// d, from the request, the target or its data.
    pub fn dimension(&self) -> Result<usize, TargetError> {
        let dim = self.dim.map(Dimension::get);
        parvi_targets::dimension_of(&self.name, dim, &self.parameters.to_catalogue())
    }

    /// The target, in its own dimension.
    ///
    /// # Errors
    /// What the catalogue refuses.
    pub fn build<const D: usize>(&self) -> Result<BoxedTarget<D>, TargetError> {
        parvi_targets::build(&self.name, &self.parameters.to_catalogue())
    }

    /// The coordinates' names: the covariates of a regression or the parameters of a model, else x₁ … x_d in the notation of
    /// the figures.
    pub fn coordinate_names(&self) -> Vec<String> {
        let dim = self.dim.map(Dimension::get);
        let known = parvi_targets::coordinate_names(&self.name, dim, &self.parameters.to_catalogue());
        let numbered = || (1..=self.dimension().unwrap_or(0)).map(|axis| format!("x_{{{axis}}}"));
        known.ok().flatten().unwrap_or_else(|| numbered().collect())
    }

    /// Name, dimension and parameters in a form that fits into a file name, different for different targets.
    pub fn label(&self) -> String {
        let mut label = self.name.clone();
        if let Some(dim) = self.dim {
            label.push_str(&format!("-d{dim}"));
        }
        for (name, value) in self.parameters.to_catalogue().given() {
            let (symbol, value) = match name {
                "data" => {
                    let stem = Path::new(&value).file_stem();
                    let stem = stem.map(|stem| stem.to_string_lossy().into_owned());
                    ("", stem.unwrap_or(value))
                }
                "program" => ("", value.replace(|letter: char| !letter.is_alphanumeric(), "-")),
                "correlation" => ("r", value),
                "curvature" => ("b", value),
                "width" => ("w", value),
                "spread" => ("s", value),
                "degrees-of-freedom" => ("nu", value),
                "prior-sd" => ("sd", value),
                "target-seed" => ("seed", value),
                name => (name, value),
            };
            label.push_str(&format!("-{symbol}{value}"));
        }
        label
    }
}
