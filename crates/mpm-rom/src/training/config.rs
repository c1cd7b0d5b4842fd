use serde::{Deserialize, Serialize};

use super::{Optimizer, TrainingError};

/// Coordinates, units of a layer and layers, at most: the optimizer keeps square matrices as wide as a layer.
const MOST_UNITS: usize = 4096;

/// How a network and an encoder are trained together.
///
/// A step takes `batch` pairs (run, frame) and of each frame `points` material points, drawn anew every time; the encoder always sees all
/// points. An epoch takes every pair once. The rate falls exponentially from step to step, rate(s) = initial (final / initial)^{s / (S − 1)}
/// for S steps (ours; the paper gives the end points 1e-3 and 1e-6).
///
/// The default optimizer, batch, points and first rate are ours: SOAP reaches in 40 epochs what the paper's Adam reaches in 400, and goes on from there;
/// neighbouring points say much the same, so that many small steps reach a given error sooner than few large ones. For Adam a first rate of 3e-3 is good.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Training {
    /// r, the number of generalised coordinates, 1 to 4096.
    pub coordinates: usize,
    /// Units of a hidden layer of the network, 1 to 4096.
    pub width: usize,
    /// Hidden layers of the network, 1 to 4096.
    pub depth: usize,
    /// Units of the encoder's dense hidden layer, 1 to 4096.
    pub encoder_width: usize,
    /// λ_F, weight of ‖∇_X g̃ − F‖², ≥ 0.
    pub gradient_weight: f64,
    /// λ_v, weight of |∂g̃/∂x̂ (x̂(t_{n+1}) − x̂(t_n)) / Δt − v|², ≥ 0.
    pub velocity_weight: f64,
    /// What makes steps of gradients.
    pub optimizer: Optimizer,
    /// Passes over all pairs, ≥ 1.
    pub epochs: u64,
    /// Pairs (run, frame) of a step, ≥ 1.
    pub batch: usize,
    /// Material points of a pair, ≥ 1; all of them if there are no more.
    pub points: usize,
    /// The rate at the first step, > 0.
    pub initial_rate: f64,
    /// The rate at the last step, > 0 and at most the first.
    pub final_rate: f64,
    /// Seed of everything random.
    pub seed: u64,
    /// Epochs between two checkpoints, ≥ 1.
    pub checkpoint_interval: u64,
}

impl Default for Training {
    fn default() -> Self {
        Self {
            coordinates: 6,
            width: 30,
            depth: 4,
            encoder_width: 32,
            gradient_weight: 100.0,
            velocity_weight: 0.01,
            optimizer: Optimizer::default(),
            epochs: 400,
            batch: 4,
            points: 16,
            initial_rate: 6e-3,
            final_rate: 1e-6,
            seed: 0,
            checkpoint_interval: 50,
        }
    }
}

impl Training {
    /// Whether every value is in its range.
    ///
    /// # Errors
    /// [`TrainingError::Value`].
    pub fn check(&self) -> Result<(), TrainingError> {
        let count = |field, value: u64| (field, value as f64, value > 0, "at least 1");
        let size = |field, value: usize| {
            let fits = (1..=MOST_UNITS).contains(&value);
            (field, value as f64, fits, "from 1 to 4096")
        };
        let weight = |field, value: f64| (field, value, value.is_finite() && value >= 0.0, "at least 0 and finite");
        let (first, last) = (self.initial_rate, self.final_rate);
        let falling = last > 0.0 && last <= first;
        let rules = [
            size("coordinates", self.coordinates),
            size("width", self.width),
            size("depth", self.depth),
            size("encoder_width", self.encoder_width),
            count("batch", self.batch as u64),
            count("points", self.points as u64),
            count("epochs", self.epochs),
            count("checkpoint_interval", self.checkpoint_interval),
            weight("gradient_weight", self.gradient_weight),
            weight("velocity_weight", self.velocity_weight),
            (
                "initial_rate",
                first,
                first.is_finite() && first > 0.0,
                "positive and finite",
            ),
            ("final_rate", last, falling, "positive and at most initial_rate"),
        ];
        match rules.into_iter().find(|(_, _, valid, _)| !valid) {
            None => Ok(()),
            Some((field, value, _, expected)) => Err(TrainingError::Value { field, value, expected }),
        }
    }

    /// The rate at step s of S.
    pub fn rate(&self, step: u64, steps: u64) -> f64 {
        let fraction = step as f64 / steps.saturating_sub(1).max(1) as f64;
        self.initial_rate * (self.final_rate / self.initial_rate).powf(fraction)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rate_runs_from_end_to_end() {
        let config = Training::default();
        assert_eq!(config.rate(0, 100), 6e-3);
        assert!((config.rate(99, 100) / 1e-6 - 1.0).abs() < 1e-12);
        assert!((config.rate(1, 3) / (6e-3_f64 * 1e-6).sqrt() - 1.0).abs() < 1e-9);
        assert_eq!(config.rate(0, 1), 6e-3);
    }

    #[test]
    fn values_out_of_range_are_named() {
        let field = |change: fn(&mut Training)| {
            let mut config = Training::default();
            change(&mut config);
            match config.check() {
                Err(TrainingError::Value { field, .. }) => field,
                other => panic!("{other:?}"),
            }
        };
        assert!(Training::default().check().is_ok());
        assert_eq!(field(|c| c.coordinates = 0), "coordinates");
        assert_eq!(field(|c| c.coordinates = 100_000), "coordinates");
        assert_eq!(field(|c| c.encoder_width = usize::MAX), "encoder_width");
        let many = Training {
            coordinates: 500,
            ..Training::default()
        };
        assert!(many.check().is_ok());
        assert_eq!(field(|c| c.points = 0), "points");
        assert_eq!(field(|c| c.epochs = 0), "epochs");
        assert_eq!(field(|c| c.gradient_weight = -1.0), "gradient_weight");
        assert_eq!(field(|c| c.velocity_weight = f64::NAN), "velocity_weight");
        assert_eq!(field(|c| c.initial_rate = f64::INFINITY), "initial_rate");
        assert_eq!(field(|c| c.final_rate = 1.0), "final_rate");
    }

    #[test]
    fn unknown_keys_are_refused() {
        assert!(toml::from_str::<Training>("epochs = 3\nbatch = 2").is_ok());
        assert!(toml::from_str::<Training>("epoch = 3").is_err());
    }
}
