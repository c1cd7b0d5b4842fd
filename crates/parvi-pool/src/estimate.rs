//! An expectation and how far it may be off.

/// An expectation with its standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The value.
    pub value: f64,
    /// Its standard error, by the spread of the weights.
    pub standard_error: f64,
}

impl Estimate {
    /// Σ c f ± (Σ c² (f − f̄)²)^½ of terms (c, f, whether the target was evaluated there): those where it was count in the error. And the largest |c (f − f̄)| of the others.
    pub(crate) fn of_terms(terms: impl Iterator<Item = (f64, f64, bool)>) -> (Self, f64) {
        let terms: Vec<_> = terms.collect();
        let value: f64 = terms.iter().map(|(c, f, _)| c * f).sum();
        let (mut variance, mut largest) = (0.0, 0.0);
        for (c, f, evaluated) in terms {
            let term = c * (f - value);
            if evaluated {
                variance += term * term;
            } else {
                largest = f64::max(largest, term.abs());
            }
        }
        let standard_error = f64::sqrt(variance);
        (Self { value, standard_error }, largest)
    }
}
