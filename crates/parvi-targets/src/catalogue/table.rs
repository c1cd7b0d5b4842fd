//! The targets by name: what is known of each, and how it is made. A new target is a file, and its entry here.

use super::info::{Dimensions, MAXIMUM_DIMENSION, ParameterInfo, Parameters, TargetInfo};
use super::making::{Values, boxed, in_dimension};
use super::synthetic::synthetic_counts;
use super::wells::{WELLS_MAXIMUM_DIMENSION, WELLS_SMALL_ROWS, wells};
use crate::{
    Arma, Banana, BoxedTarget, Cross, Eggbox, Funnel, Garch, Gaussian, GaussianMixture, GaussianProcess,
    GaussianShells, HiddenMarkov, LinearModel, LogGamma, Logarithm, Logit, LotkaVolterra, NestedNormals, NormalMixture,
    Probit, ProgramTarget, RandomTarget, RegressionData, Ring, Rosenbrock, Schools, SimpleLikelihood, SpikeSlab,
    StudentT, TargetError, TwoMoons,
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

const fn any_from(minimum: usize) -> Dimensions {
    Dimensions::Range {
        minimum,
        maximum: MAXIMUM_DIMENSION,
        default: None,
    }
}

/// The intercept and as many covariates of `wells` as there are.
const fn of_wells(default: Option<usize>) -> Dimensions {
    Dimensions::Range {
        minimum: 1,
        maximum: WELLS_MAXIMUM_DIMENSION,
        default,
    }
}

/// An entry without exact draws, transport, moments and evidence: a posterior.
const fn posterior(name: &'static str, dimensions: Dimensions, summary: &'static str) -> TargetInfo {
    TargetInfo {
        name,
        dimensions,
        summary,
        parameters: &[],
        exact_draws: false,
        unit_cube_transport: false,
        moments: false,
        modes: 1,
        log_evidence: false,
    }
}

/// An entry with all of them.
const fn closed(name: &'static str, dimensions: Dimensions, summary: &'static str) -> TargetInfo {
    TargetInfo {
        exact_draws: true,
        unit_cube_transport: true,
        moments: true,
        log_evidence: true,
        ..posterior(name, dimensions, summary)
    }
}

impl TargetInfo {
    const fn with(self, parameters: &'static [ParameterInfo]) -> Self {
        Self { parameters, ..self }
    }

    const fn with_modes(self, modes: usize) -> Self {
        Self { modes, ..self }
    }

    const fn without_moments(self) -> Self {
        Self { moments: false, ..self }
    }

    /// With exact draws and evidence alone.
    const fn without_transport(self) -> Self {
        Self {
            unit_cube_transport: false,
            ..self.without_moments()
        }
    }
}

const fn two_moons(name: &'static str) -> TargetInfo {
    let summary = "two crescents with straight ends, in log odds of a box (sbibm)";
    closed(name, Dimensions::Fixed(2), summary)
        .without_transport()
        .with_modes(2)
}

const fn nested_normals(name: &'static str) -> TargetInfo {
    let summary = "a peak on another ten times as wide, in log odds of a box (sbibm)";
    closed(name, Dimensions::Fixed(2), summary).without_transport()
}

const fn simple_likelihood(name: &'static str) -> TargetInfo {
    let summary = "mean and covariance of four points in the plane, four equal parts, in log odds of a box (sbibm)";
    closed(name, Dimensions::Fixed(5), summary)
        .without_transport()
        .with_modes(4)
}

/// Name, default and meaning.
const fn parameter(name: &'static str, default: &'static str, meaning: &'static str) -> ParameterInfo {
    ParameterInfo {
        name,
        default: Some(default),
        meaning,
    }
}

const PRIOR: ParameterInfo = parameter(
    "prior-sd",
    "10",
    "standard deviation of each coefficient's prior; inf for flat",
);
const MIXTURE_WIDTH: ParameterInfo = parameter("width", "0.5", "standard deviation of each mode");
/// What has to be given.
const DATA: ParameterInfo = ParameterInfo {
    name: "data",
    default: None,
    meaning: "the CSV file",
};
const PROGRAM: ParameterInfo = ParameterInfo {
    name: "program",
    default: None,
    meaning: "the command line of the program, for the shell",
};
const FILE: &str = "a CSV file instead; it fixes the dimension";

/// What is known of the targets, and what makes one in dimension D, by the values of its parameters.
macro_rules! targets {
    (($values:ident, $dimension:ident); $($info:expr => $build:expr;)*) => {
        /// Every target, in the order of the documentation.
        static CATALOGUE: &[TargetInfo] = &[$($info,)*];

        /// A target in one dimension, which is one of its own.
        pub(crate) fn make<const $dimension: usize>(
            name: &str,
            parameters: &Parameters,
        ) -> Result<BoxedTarget<$dimension>, TargetError> {
            let info = target_info(name)?;
            let $values = &Values { info, parameters };
            $({
                const INFO: TargetInfo = $info;
                if name == INFO.name {
                    return $build;
                }
            })*
            Err(unknown_target(name))
        }
    };
}

targets! {
    (values, D);
    closed("gaussian", any_from(1), "N(0, C), C_ij = R^|i-j|")
        .with(&[parameter("correlation", "0", "R, between -1 and 1")])
        => boxed(Gaussian::<D>::autoregressive(values.number("correlation")));
    closed("banana", Dimensions::Fixed(2), "x1 ~ N(0, 1), x2 ~ N(b (x1^2 - 1), s^2)")
        .with(&[parameter("curvature", "1", "b"), parameter("width", "0.5", "s")])
        => in_dimension(Banana::new(values.number("curvature"), values.number("width")));
    closed("ring", Dimensions::Fixed(2), "proportional to exp(-(|x| - r)^2 / 2 s^2)")
        .with(&[parameter("radius", "2", "r"), parameter("width", "0.2", "s")])
        => in_dimension(Ring::new(values.number("radius"), values.number("width")));
    closed("mixture-4", Dimensions::Fixed(2), "four equal Gaussian modes at (+-2, +-2)")
        .with(&[MIXTURE_WIDTH])
        .with_modes(4)
        => in_dimension(GaussianMixture::<2>::four_equal(values.number("width")));
    closed("mixture-2", any_from(1), "Gaussian modes at -1.5 e1 and 1.5 e1 with masses 0.3 and 0.7")
        .with(&[MIXTURE_WIDTH])
        .with_modes(2)
        => boxed(GaussianMixture::<D>::two_unequal(values.number("width")));
    closed(
        "mixture-3",
        any_from(2),
        "Gaussian modes at -4 e1, 4 e1, 5 e2, widths 0.6, 0.4, 0.5, masses 0.2, 0.5, 0.3",
    )
        .with_modes(3)
        => boxed(GaussianMixture::<D>::three_far());
    closed("funnel", any_from(2), "x1 ~ N(0, w^2), xj ~ N(0, exp(x1))")
        .with(&[parameter("width", "1.5", "w, standard deviation of x1")])
        => boxed(Funnel::<D>::new(values.number("width")));
    closed("student-t", any_from(1), "multivariate Student t with identity scale")
        .with(&[parameter("degrees-of-freedom", "5", "degrees of freedom")])
        => boxed(StudentT::<D>::new(values.number("degrees-of-freedom")));
    closed(
        "rosenbrock",
        any_from(2),
        "x1 ~ N(1, s^2), x2, x4, ... ~ N(x1^2, w^2), x3, x5, ... ~ N(the square of the one before, w^2)",
    )
        .with(&[
            parameter("spread", "1", "s, standard deviation of x1"),
            parameter("width", "0.3", "w, standard deviation about the parabolas"),
        ])
        => boxed(Rosenbrock::<D>::new(values.number("spread"), values.number("width")));
    closed(
        "scales",
        any_from(2),
        "Gaussian with standard deviations from 1e-3 to 1e3 in equal ratios and correlations R^|i-j|",
    )
        .with(&[parameter("correlation", "0.5", "R, between -1 and 1")])
        => boxed(Gaussian::<D>::scales(values.number("correlation")));
    closed("cross", any_from(2), "one Gaussian arm along every axis, crossing at the origin")
        .with(&[
            parameter("spread", "2", "standard deviation along an arm"),
            parameter("width", "0.2", "standard deviation across it"),
        ])
        => boxed(Cross::<D>::new(values.number("spread"), values.number("width")));
    closed(
        "schools",
        any_from(3),
        "the first d-2 of the eight schools: mean, log scale and standardised effects, not centred",
    )
        => boxed(Schools::<D>::new());
    closed(
        "random",
        any_from(1),
        "a random shape, place, direction and scale: push-forwards, mixtures and products of simple laws",
    )
        .with(&[parameter("target-seed", "0", "the seed that makes it")])
        .without_moments()
        => boxed(RandomTarget::<D>::new(values.parameters.target_seed.unwrap_or(0)));
    posterior("program", any_from(1), "what a program says that answers questions, a line each: docs/guide.md")
        .with(&[PROGRAM])
        => boxed(ProgramTarget::<D>::start(values.parameters.program.as_deref().unwrap_or_default()));
    closed(
        "eggbox",
        Dimensions::Fixed(2),
        "likelihood exp((2 + cos(x1/2) cos(x2/2))^5), x uniform on [0, 10 pi]^2, in y = log x/(10 pi - x)",
    )
        .without_transport()
        => in_dimension(Eggbox::new());
    closed(
        "shells",
        any_from(2),
        "two Gaussian shells of radius 2 and width 0.1 about -3.5 e1 and 3.5 e1, prior density 12^-d",
    )
        .with_modes(2)
        => boxed(GaussianShells::<D>::new());
    closed(
        "log-gamma",
        any_from(2),
        "log-gamma and normal laws of width 1/30 about 1/3 and 2/3 in the unit cube, in y = log x/(1 - x)",
    )
        .with_modes(4)
        .without_moments()
        => boxed(LogGamma::<D>::new());
    closed("spike-slab", any_from(1), "100 N(0.031, 0.01^2 I) + N(0, 0.1^2 I), prior density 1")
        => boxed(SpikeSlab::<D>::new());
    posterior("wells", of_wells(None), "logistic regression: 3,020 households in Bangladesh change wells or not")
        .with(&[PRIOR])
        => values.regression::<Logit, D>(wells(D, None)?);
    posterior(
        "wells-small",
        of_wells(Some(5)),
        "logistic regression: the first 40 households of wells, a skewed posterior",
    )
        .with(&[PRIOR])
        => values.regression::<Logit, D>(wells(D, Some(WELLS_SMALL_ROWS))?);
    posterior(
        "probit",
        of_wells(Some(5)),
        "probit regression on the rows of wells-small, or on a CSV file as for logistic",
    )
        .with(&[parameter("data", "the rows of wells-small", FILE), PRIOR])
        => values.regression::<Probit, D>(values.file_or(|| wells(D, Some(WELLS_SMALL_ROWS)))?);
    posterior(
        "poisson",
        any_from(1),
        "Poisson regression with logarithmic link on 40 synthetic counts, or on a CSV file: the count first",
    )
        .with(&[parameter("data", "the synthetic counts", FILE), PRIOR])
        => values.regression::<Logarithm, D>(values.file_or(|| synthetic_counts(D))?);
    posterior(
        "logistic",
        Dimensions::FromData,
        "logistic regression on a CSV file: 0/1 response first, then covariates; an intercept is added",
    )
        .with(&[DATA, PRIOR])
        => values.regression::<Logit, D>(RegressionData::from_csv_file(values.data_path()?)?);
    posterior(
        "arma",
        Dimensions::Fixed(4),
        "autoregressive moving average of order (1, 1), a series of 200 (posteriordb)",
    )
        => in_dimension(Arma::posterior());
    posterior(
        "garch",
        Dimensions::Fixed(4),
        "a series of 200 whose variance depends on the past: GARCH(1, 1) (posteriordb)",
    )
        => in_dimension(Garch::posterior());
    posterior(
        "gaussian-process",
        Dimensions::Fixed(3),
        "length, height and noise of a Gaussian process through 11 points (posteriordb)",
    )
        => in_dimension(GaussianProcess::posterior());
    posterior(
        "hidden-markov",
        Dimensions::Fixed(4),
        "transitions and means of a hidden Markov model of two states, a series of 100 (posteriordb)",
    )
        => in_dimension(HiddenMarkov::posterior());
    posterior(
        "gaussian-mixture-posterior",
        Dimensions::Fixed(5),
        "means, widths and masses of two normal distributions, fitted to 1,000 numbers (posteriordb)",
    )
        => in_dimension(NormalMixture::posterior());
    posterior(
        "kidscore",
        Dimensions::Fixed(5),
        "linear model: test scores of 434 children by their mothers' schooling and intelligence (posteriordb)",
    )
        => in_dimension(LinearModel::kidscore());
    posterior(
        "mesquite",
        Dimensions::Fixed(5),
        "linear model of logarithms: leaf weight of 46 mesquite bushes by their size (posteriordb)",
    )
        => in_dimension(LinearModel::mesquite());
    posterior(
        "blr",
        Dimensions::Fixed(6),
        "linear model: 100 responses to five strongly correlated covariates (posteriordb)",
    )
        => in_dimension(LinearModel::blr());
    posterior(
        "lotka-volterra",
        Dimensions::Fixed(8),
        "predator-prey equations of hares and lynxes, 21 years (posteriordb)",
    )
        => in_dimension(LotkaVolterra::posterior());
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
