//! Training: a network and an encoder fitted to snapshots.
//!
//! The loss (Chen et al. 2023, Eq. 31) is, per sample (run, frame n, point p),
//!
//! |g̃ − φ|² / ℓ² + λ_F ‖∇_X g̃ − F‖² + λ_v |∂g̃/∂x̂ (x̂(t_{n+1}) − x̂(t_n)) / Δt − v|² / ℓ², x̂(t_n) = e(φ(t_n)),
//!
//! and a step takes the mean over its samples: the sum, divided by pairs (run, frame) times points of a pair. The last frame of a run has no third
//! term but counts in the mean. ℓ = [`Scaling::length`](crate::manifold::Scaling::length), the standard deviation of the training
//! positions, makes the weights independent of the unit of length; times are in seconds (ours: the paper names no units).
//!
//! The derivatives in the loss are forward tangents carried through the layers, D for ∇_X and one for the velocity, so its gradient is an
//! ordinary reverse pass through values and tangents. The result has the same bits for any number of threads: pairs are independent and
//! their adjoints are added in the order of the batch.
//!
//! What a step costs: per sample three products with every hidden layer's weights (forward, columns, weights) for the value, D + 1 tangents and
//! their adjoints, 6 width² (D + 2) flop per layer between hidden ones; per pair two passes of the encoder there and back, which at 1,368 points
//! weigh as much as some tens of samples. The example `train_speed` measures both, the example `bending` error against time.

mod checkpoint;
mod config;
mod error;
mod loss;
mod optimizer;
mod report;
mod trainer;

pub use config::Training;
pub use error::TrainingError;
pub use loss::Terms;
pub use optimizer::Optimizer;
pub use report::EpochReport;
pub use trainer::Trainer;
