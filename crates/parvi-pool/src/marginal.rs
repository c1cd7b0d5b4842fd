//! What a pool says of one coordinate, and whether that can be relied on.

use mpm_tensor::power_of_two;

use crate::estimate::Estimate;
use crate::referee::Objection;

/// Share of the effective size that carries a second moment, at least: where proposals aim at p √r at the most, and where they aim at p r, since one was less, of which of a normal law three times as much as of independent draws does.
const LEAST_CARRIED: f64 = 1.0 / 16.0;
const LEAST_CARRIED_AFTER: f64 = 3.0 / 16.0;

/// Mean and variance of a coordinate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Marginal {
    /// E\[x\].
    pub mean: Estimate,
    /// E\[(x − m)²\], m the estimated mean.
    pub variance: Estimate,
}

impl Marginal {
    /// The standard deviation and its standard error.
    pub fn deviation(&self) -> (f64, f64) {
        let deviation = self.variance.value.max(0.0).sqrt();
        (deviation, self.variance.standard_error / (2.0 * deviation))
    }
}

impl Marginal {
    /// By the expectations of functions of the coordinate, whose standard deviation is about `deviation`.
    pub(crate) fn of(deviation: f64, expectation: impl Fn(&dyn Fn(f64) -> f64) -> Estimate) -> Self {
        // In units of a power of two, which rounds nothing: squares of squares of large coordinates overflow.
        let unit = power_of_two(deviation);
        let in_units = |of: Estimate, unit: f64| Estimate {
            value: of.value * unit,
            standard_error: of.standard_error * unit,
            ..of
        };
        let mean = in_units(expectation(&|x| x / unit), unit);
        let variance = expectation(&|x| ((x - mean.value) / unit).powi(2));
        Self {
            mean,
            variance: in_units(variance, unit * unit),
        }
    }
}

/// That the least share of the effective size that carries a second moment is too little, if it is. Of independent draws it is one over the kurtosis, 1/3 of normal ones: where it
/// is less than 1/16, or than 3/16 once it was, there may be a longer tail than was met, of which no standard error says anything.
pub(crate) fn hanging(marginals: &[Marginal], effective_size: f64, had_hung: bool) -> Option<Objection> {
    let of_axis = |marginal: &Marginal| marginal.variance.carriers / effective_size;
    let shares = (1..).zip(marginals.iter().map(of_axis));
    let (axis, share) = shares.min_by(|(_, one), (_, other)| one.total_cmp(other))?;
    let enough = if had_hung { LEAST_CARRIED_AFTER } else { LEAST_CARRIED };
    (share < enough).then_some(Objection::Hanging { axis, share })
}
