#![doc = include_str!("../README.md")]

mod banana;
mod build;
mod catalogue;
mod constrain;
mod csv_data;
mod data;
mod direction_numbers;
mod error;
mod exponential;
mod finite_difference;
mod frame;
mod funnel;
mod gaussian;
mod identifiability;
mod laplace;
mod logistic;
mod logistic_batch;
mod logistic_posterior;
mod logistic_sum;
mod minibatch;
mod mixture;
mod reference;
mod ring;
mod sobol;
mod special;
mod student_t;
mod sum_target;
mod target;
mod weighted_draws;
mod wells;

pub use banana::Banana;
pub use build::{BoxedTarget, build, dimension_of};
pub use catalogue::{Dimensions, MAXIMUM_DIMENSION, ParameterInfo, Parameters, TargetInfo, catalogue, target_info};
pub use constrain::{
    ConstrainedTarget, Constraints, ConstraintsBuilder, OutsideSupport, Transform, correlation_matrix, lower_triangle,
};
pub use data::RegressionData;
pub use direction_numbers::SOBOL_MAXIMUM_DIMENSION;
pub use error::TargetError;
pub use finite_difference::FiniteDifferenceScore;
pub use frame::Frame;
pub use funnel::Funnel;
pub use gaussian::Gaussian;
pub use laplace::{Curvature, Laplace};
pub use logistic::{DEFAULT_PRIOR_STANDARD_DEVIATION, LogisticRegression};
pub use minibatch::MinibatchScore;
pub use mixture::GaussianMixture;
pub use reference::{ImportanceSample, ReferenceMoments, ReferenceOptions, reference_draws, reference_moments};
pub use ring::Ring;
pub use sobol::SobolSequence;
pub use special::normal_quantile;
pub use student_t::StudentT;
pub use sum_target::SumTarget;
pub use target::{CatalogueTarget, ExactDraws, Mode, Moments, Target, UnitCubeTransport};
pub use weighted_draws::WeightedDraws;
pub use wells::{WELLS_MAXIMUM_DIMENSION, WELLS_SMALL_ROWS, wells};
