//! Options of targets and methods, with the same names on the command line and in configurations.

mod bounded;
mod checked_when_read;
mod law;
mod limit;
mod material_options;
mod material_table;
mod method_options;
mod method_specification;
mod methods;
mod option_error;
mod option_rules;
mod option_values;
mod seed;
mod target_specification;
mod words_or_files;

pub use bounded::{Bounded, Dimension, EvaluationCount, ParticleCount, RoundCount, StepCount, WarmUp};
pub(crate) use checked_when_read::checked_when_read;
pub use law::Material;
use law::{Given, Parameter};
pub use limit::Limit;
pub use material_table::MaterialTable;
pub use method_options::MethodOptions;
pub use method_specification::MethodSpecification;
pub use methods::{MethodName, is_among, owners};
pub use option_error::OptionError;
pub(crate) use option_values::words;
pub use option_values::{
    AlphaSchedule, Basis, CondensationName, Correction, Draws, FrameName, MonitorName, NonFinite, PoolChoice, Score,
    Switch, Transfer,
};
pub use seed::seed;
pub use target_specification::{TargetParameters, TargetSpecification};
