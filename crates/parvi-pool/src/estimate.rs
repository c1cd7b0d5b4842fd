//! An expectation and how far it may be off.

/// An expectation with its standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The value.
    pub value: f64,
    /// Its standard error, by the spread of the weights.
    pub standard_error: f64,
}
