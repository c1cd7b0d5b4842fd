//! Targets by name, data of regressions from files, and the targets that only the catalogue needs: those with data of their own, those of others'
//! benchmarks, and random ones.

mod build;
mod csv_data;
mod info;
mod making;
mod nested;
mod numbers;
mod posteriordb;
mod program;
mod random;
mod sbibm;
mod schools;
mod schools_scale;
mod synthetic;
mod table;
mod wells;

pub use build::{build, coordinate_names, dimension_of};
pub use info::{Dimensions, MAXIMUM_DIMENSION, ParameterInfo, Parameters, TargetInfo};
pub use nested::{Eggbox, GaussianShells, LogGamma, SpikeSlab};
pub use posteriordb::{
    Arma, Garch, GaussianProcess, HiddenMarkov, LinearModel, LotkaVolterra, ModelPosterior, NormalMixture, Prior,
};
pub use program::ProgramTarget;
pub use random::{
    Affine, AxisLaw, Bijection, BoxedBijection, BoxedLaw, Law, MixtureLaw, Neck, ProductLaw, Profile, PushForward,
    RandomFamily, RandomTarget, Shear, Skew, Twist,
};
pub use sbibm::{BoxPosterior, NestedNormals, SimpleLikelihood, Simulator, TwoMoons};
pub use schools::Schools;
pub use synthetic::{SYNTHETIC_COUNT_ROWS, synthetic_counts};
pub use table::{catalogue, target_info};
pub use wells::{WELLS_MAXIMUM_DIMENSION, WELLS_SMALL_ROWS, wells};
