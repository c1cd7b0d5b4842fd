//! What several themes need.

use parvi_targets::Parameters;

/// The default parameters but for a change.
pub fn with(change: impl FnOnce(&mut Parameters)) -> Parameters {
    let mut parameters = Parameters::default();
    change(&mut parameters);
    parameters
}

/// log Π N(β_k; 0, s²).
pub fn log_prior<const D: usize>(beta: &[f64; D], deviation: f64) -> f64 {
    let constant = (deviation * std::f64::consts::TAU.sqrt()).ln();
    beta.iter().map(|b| -0.5 * (b / deviation).powi(2) - constant).sum()
}
