//! What several themes need.

use parvi_targets::Parameters;

/// The default parameters but for a change.
pub fn with(change: impl FnOnce(&mut Parameters)) -> Parameters {
    let mut parameters = Parameters::default();
    change(&mut parameters);
    parameters
}
