#![doc = include_str!("../README.md")]

mod choices;
mod compiled;
mod framed_score;
mod grid_density;
mod in_cell;
mod moving;
mod node_scores;
#[cfg(feature = "mesh")]
mod on_mesh;
mod parts;
mod planned_step;
mod remembering_gas;
mod residual;
mod stiffness;

pub use choices::{BasisChoice, NonFiniteScores, ScoreLocation, TransferChoice};
pub use framed_score::{FramedScore, ScoreForce};
pub use moving::{Cloud, Moving};
pub use node_scores::NodeScores;
#[cfg(feature = "mesh")]
pub use on_mesh::{Meshes, MovingOnMesh, PartsOnMesh};
pub use parts::{Parts, Ready};
pub use planned_step::PlannedStep;
pub use residual::{Residual, galerkin_stein_residual};
pub use stiffness::{OSCILLATION_ANGLE, Record, Stiffness};
