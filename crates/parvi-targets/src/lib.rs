#![doc = include_str!("../README.md")]

mod banana;
mod build;
mod catalogue;
mod constrain;
mod cross;
mod csv_data;
mod data;
mod direction_numbers;
mod error;
mod exponential;
mod finite_difference;
mod frame;
mod funnel;
mod gaussian;
mod generalised_linear;
mod generalised_linear_batch;
mod identifiability;
mod in_frame;
mod laplace;
mod link;
mod logarithm;
mod logit;
mod making;
mod minibatch;
mod mixture;
mod nested;
mod normal_tail;
mod posterior;
mod posteriordb;
mod probit;
mod random;
mod reference;
mod regression;
mod regression_sum;
mod response;
mod ring;
mod rosenbrock;
mod sbibm;
mod scales;
mod schools;
mod schools_scale;
mod score_only;
mod sobol;
mod special;
mod student_t;
mod sum_target;
mod synthetic;
mod table;
mod target;
mod weighted_draws;
mod wells;

pub use banana::Banana;
pub use build::{build, coordinate_names, dimension_of};
pub use catalogue::{Dimensions, MAXIMUM_DIMENSION, ParameterInfo, Parameters, TargetInfo};
pub use constrain::{
    ConstrainedTarget, Constraints, ConstraintsBuilder, OutsideSupport, Transform, correlation_matrix, lower_triangle,
};
pub use cross::Cross;
pub use data::{CountData, RegressionData, RegressionTable};
pub use direction_numbers::SOBOL_MAXIMUM_DIMENSION;
pub use error::TargetError;
pub use finite_difference::FiniteDifferenceScore;
pub use frame::Frame;
pub use funnel::Funnel;
pub use gaussian::Gaussian;
pub use in_frame::InFrame;
pub use laplace::{Curvature, Laplace};
pub use link::{Link, PARTICLES_PER_GROUP};
pub use logarithm::Logarithm;
pub use logit::Logit;
pub use making::BoxedTarget;
pub use minibatch::MinibatchScore;
pub use mixture::GaussianMixture;
pub use nested::{Eggbox, GaussianShells, LogGamma, SpikeSlab};
pub use posteriordb::{
    Arma, Garch, GaussianProcess, HiddenMarkov, LinearModel, LotkaVolterra, ModelPosterior, NormalMixture, Prior,
};
pub use probit::Probit;
pub use random::{
    Affine, AxisLaw, Bijection, BoxedBijection, BoxedLaw, Law, MixtureLaw, Neck, ProductLaw, Profile, PushForward,
    RandomFamily, RandomTarget, Shear, Skew, Twist,
};
pub use reference::{ImportanceSample, ReferenceMoments, ReferenceOptions, reference_draws, reference_moments};
pub use regression::{
    DEFAULT_PRIOR_STANDARD_DEVIATION, LogisticRegression, PoissonRegression, ProbitRegression, Regression,
};
pub use response::Response;
pub use ring::Ring;
pub use rosenbrock::Rosenbrock;
pub use sbibm::{BoxPosterior, NestedNormals, SimpleLikelihood, Simulator, TwoMoons};
pub use schools::Schools;
pub use score_only::ScoreOnly;
pub use sobol::SobolSequence;
pub use special::normal_quantile;
pub use student_t::StudentT;
pub use sum_target::SumTarget;
pub use synthetic::{SYNTHETIC_COUNT_ROWS, synthetic_counts};
pub use table::{catalogue, target_info};
pub use target::{CatalogueTarget, ExactDraws, Mode, Moments, Target, UnitCubeTransport};
pub use weighted_draws::WeightedDraws;
pub use wells::{WELLS_MAXIMUM_DIMENSION, WELLS_SMALL_ROWS, wells};
