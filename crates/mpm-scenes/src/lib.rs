#![doc = include_str!("../README.md")]

mod background;
mod error;
pub mod fill;
mod held;
mod kinematics;
pub mod law;
pub mod loads;
mod manufactured;
pub mod output;
mod placement;
mod plane;
mod population;
pub mod reading;
pub mod reference;
mod rotation;
mod run;
pub mod scene;
mod series;
pub mod shape;
mod snapshot;
mod toml_value;
mod validation_row;
mod values;
pub mod variation;
mod velocity;

pub use error::{SceneError, SceneFault, StepLimit};
pub use held::HeldRegion;
pub use kinematics::{KinematicRegion, Kinematics, RigidMotion};
pub use law::{LawState, Laws};
pub use manufactured::ManufacturedSolution;
pub use population::Population;
pub use run::{Effort, Observer, Outcome, Progress, SimulationError, Summary, frames, simulate};
pub use scene::Scene;
pub use series::Series;
pub use snapshot::Snapshot;
pub use validation_row::ValidationRow;
