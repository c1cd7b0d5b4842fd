#![doc = include_str!("../README.md")]

mod adapt;
mod anderson;
mod ascent;
mod cloud;
mod compiled;
mod condense;
mod curvature;
mod density;
mod energy;
mod estimate;
mod explore;
mod fold;
mod freeze;
mod gamma;
mod lanes;
mod learn;
mod levels;
mod maximise;
mod measure;
mod mixture;
mod neighbours;
mod options;
mod pareto;
mod pool;
mod propose;
mod referee;
mod sample;
mod scout;
mod search;
mod student;
mod summit;
mod support_points;
#[cfg(test)]
mod tests;
mod walk;
mod weights;

pub use compiled::{condense, explore};
pub use energy::EnergyDistance;
pub use estimate::Estimate;
pub use explore::Observer;
pub use measure::Measure;
pub use mixture::{Kernel, Mixture};
pub use options::{PoolError, PoolOptions, Round};
pub use pareto::pareto_k;
pub use pool::Pool;
pub use referee::{Objection, Verdict};
