//! One comparison of a run with a reference solution.

/// A measured quantity beside its reference; a row of `validation.csv`.
#[derive(Clone, Debug, PartialEq)]
pub struct ValidationRow {
    /// What was compared, as in `period of the tip`.
    pub quantity: String,
    /// The run's value.
    pub measured: f64,
    /// The reference's value.
    pub reference: f64,
    /// Largest |measured − reference| that passes.
    pub tolerance: f64,
}

impl ValidationRow {
    /// A quantity that has to be within `tolerance` of `reference`.
    pub fn near(quantity: impl Into<String>, measured: f64, reference: f64, tolerance: f64) -> Self {
        Self {
            quantity: quantity.into(),
            measured,
            reference,
            tolerance,
        }
    }

    /// An error, which has to be at most `limit` in size: near 0.
    pub fn at_most(quantity: impl Into<String>, measured: f64, limit: f64) -> Self {
        Self::near(quantity, measured, 0.0, limit)
    }

    /// Whether |measured − reference| ≤ tolerance; not where one of them is NaN.
    pub fn passes(&self) -> bool {
        (self.measured - self.reference).abs() <= self.tolerance
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_passes_within_its_tolerance_and_never_with_nan() {
        let row = |measured| ValidationRow {
            quantity: "period".into(),
            measured,
            reference: 1.0,
            tolerance: 0.25,
        };
        assert!(row(1.25).passes() && row(0.75).passes());
        assert!(!row(1.26).passes() && !row(f64::NAN).passes());
    }
}
