//! The reduced dynamics: a step on a few sample points.

mod body;
mod coordinates;
mod cubature;
mod design;
mod error;
mod eulerian;
mod greedy;
mod instant;
mod known_points;
mod lagrangian;
mod model;
mod neighbours;
mod nodes;
mod options;
mod quadrature;
mod ranked_exchanges;
mod reading;
mod redraw;
mod samples;
mod scaled_reading;
mod snapshot;
mod step;
mod support;
#[cfg(test)]
mod tests;
mod weights;

pub use body::ReducedBody;
pub(crate) use body::{check_supported, shapes_of};
pub use cubature::choose_cubature;
pub use error::OnlineError;
pub use greedy::choose_greedily;
pub use known_points::KnownPoints;
pub use neighbours::Search;
pub use options::{Inverted, Options, Quadrature, SampleWeights, Update};
pub use ranked_exchanges::rank_exchanges;
pub use reading::Reading;
pub use samples::SampleChoice;
pub(crate) use samples::check_count;
pub use step::{ReducedModel, StepReport};
