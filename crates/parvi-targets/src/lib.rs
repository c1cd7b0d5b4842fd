#![doc = include_str!("../README.md")]

mod banana;
mod calls;
#[cfg(feature = "catalogue")]
mod catalogue;
mod constrain;
mod cross;
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
mod laplace;
mod link;
mod logarithm;
mod logit;
mod minibatch;
mod mixture;
mod normal_tail;
mod posterior;
mod probit;
mod reference;
mod regression;
mod regression_sum;
mod response;
mod ring;
mod rosenbrock;
mod scales;
mod score_only;
mod sobol;
mod special;
mod student_t;
mod sum_target;
mod synthetic;
mod target;
mod weighted_draws;

/// Covariances, of frames and moments.
pub use mpm_tensor::Matrix;

pub use banana::Banana;
pub use calls::{log_densities_in_calls, scores_in_calls};
#[cfg(feature = "catalogue")]
pub use catalogue::*;
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
pub use laplace::{Curvature, Laplace};
pub use link::{Link, PARTICLES_PER_GROUP};
pub use logarithm::Logarithm;
pub use logit::Logit;
pub use minibatch::MinibatchScore;
pub use mixture::GaussianMixture;
pub use probit::Probit;
pub use reference::{ImportanceSample, ReferenceMoments, ReferenceOptions, reference_draws, reference_moments};
pub use regression::{LogisticRegression, PoissonRegression, ProbitRegression, Regression};
pub use response::Response;
pub use ring::Ring;
pub use rosenbrock::Rosenbrock;
pub use score_only::ScoreOnly;
pub use sobol::SobolSequence;
pub use special::{gamma_quantile, normal_quantile};
pub use student_t::StudentT;
pub use sum_target::SumTarget;
pub use target::{BoxedTarget, CatalogueTarget, ExactDraws, Mode, Moments, Target, UnitCubeTransport};
pub use weighted_draws::WeightedDraws;
