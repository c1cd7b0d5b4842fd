//! What the scores know about a body's accuracy.

use mpm_tensor::vector;

use super::control_variates::{ControlVariates, Expectation};

/// Polynomials of a higher degree are tried as long as they leave more than this share of a coordinate or its square unexplained.
const EXPLAINED: f64 = 0.1;

/// Means and second moments about `centre` of one body's particles, in the user's coordinates.
#[derive(Clone, Debug)]
pub(crate) struct Evidence<const D: usize> {
    particles: usize,
    centre: [f64; D],
    first: [Expectation; D],
    second: [Expectation; D],
    degree: usize,
}

impl<const D: usize> Evidence<D> {
    /// From particles at `positions` (in the coordinates in which the scores are gradients), which the user sees at `seen`. Where there is no
    /// regression, the estimates are the averages and nothing is explained.
    pub fn new(positions: &[[f64; D]], scores: &[[f64; D]], seen: &[[f64; D]]) -> Self {
        let mut centre = [0.0; D];
        for x in seen {
            vector::accumulate(&mut centre, 1.0 / seen.len() as f64, x);
        }
        let judged = |expectation: &dyn Fn(&[f64]) -> Expectation, degree| {
            let of = |value: &dyn Fn(&[f64; D]) -> f64| {
                let values: Vec<f64> = seen.iter().map(value).collect();
                expectation(&values)
            };
            Self {
                particles: seen.len(),
                centre,
                first: std::array::from_fn(|a| of(&|x| x[a] - centre[a])),
                second: std::array::from_fn(|a| of(&|x| (x[a] - centre[a]).powi(2))),
                degree,
            }
        };
        let found = ControlVariates::explaining(positions, scores, None, EXPLAINED, |regression, degree| {
            let evidence = judged(&|values| regression.expectation(values), degree);
            (evidence.unexplained(), evidence)
        });
        found.unwrap_or_else(|| judged(&Expectation::without_scores, 0))
    }

    /// The largest part of a coordinate, in standard deviations, or of a variance, relative to twice itself, that is unexplained.
    fn unexplained(&self) -> f64 {
        let of_axis = |a: usize| {
            let variance = self.first[a].standard_deviation.powi(2);
            self.first[a]
                .unexplained_share()
                .max(self.second[a].unexplained / (2.0 * variance))
        };
        (0..D).map(of_axis).fold(0.0, f64::max)
    }

    /// Degree of the polynomials.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// For every axis: with c the average and ê, q̂ the estimates of E\[x − c\] and E\[(x − c)²\], m̂ = c + ê and σ̂² = q̂ − ê².
    pub fn moments(&self) -> Vec<MomentEstimate> {
        let rate = (self.particles as f64).sqrt().recip();
        let of_axis = |a: usize| {
            let (first, second) = (&self.first[a], &self.second[a]);
            let mean = self.centre[a] + first.average;
            let deviation = second.average.sqrt();
            let shift = first.estimate - first.average;
            let deviation_estimate = (second.estimate - shift * shift).max(0.0).sqrt();
            let mean_unexplained = first.unexplained / deviation;
            let deviation_unexplained = second.unexplained / (2.0 * second.average);
            MomentEstimate {
                mean: EstimatedMoment {
                    value: mean,
                    estimate: mean + shift,
                    standard_error: shift.hypot(rate * mean_unexplained * deviation),
                    unexplained: mean_unexplained,
                },
                standard_deviation: EstimatedMoment {
                    value: deviation,
                    estimate: deviation_estimate,
                    standard_error: (deviation_estimate - deviation).hypot(rate * deviation_unexplained * deviation),
                    unexplained: deviation_unexplained,
                },
            }
        };
        (0..D).map(of_axis).collect()
    }
}

/// Mean and standard deviation of a coordinate, and what the pool or the scores say about them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MomentEstimate {
    /// The mean; unexplained is the coordinate, in units of the standard deviation.
    pub mean: EstimatedMoment,
    /// The standard deviation; unexplained is the squared distance from the mean, in units of twice the variance.
    pub standard_deviation: EstimatedMoment,
}

/// A moment of the particles, and what is known of the target's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EstimatedMoment {
    /// The particles' own.
    pub value: f64,
    /// The target's by the pool or by the scores.
    pub estimate: f64,
    /// Standard error of `value`: the difference between both, and what is unexplained as if from independent draws, or the standard error of the pool.
    pub standard_error: f64,
    /// Standard deviation of what is unexplained: over √M it is the standard error of the estimate, in its units.
    pub unexplained: f64,
}

impl MomentEstimate {
    /// |m̂ − m| in estimated standard deviations σ̂, infinite where that is no number.
    pub fn mean_error(&self) -> f64 {
        known((self.mean.estimate - self.mean.value).abs() / self.standard_deviation.estimate)
    }

    /// The larger of what is unexplained of the coordinate and of its square.
    pub fn unexplained(&self) -> f64 {
        self.mean.unexplained.max(self.standard_deviation.unexplained)
    }

    /// |σ / σ̂ − 1|, infinite where the estimated variance is not positive or that is no number.
    pub fn standard_deviation_error(&self) -> f64 {
        known((self.standard_deviation.value / self.standard_deviation.estimate - 1.0).abs())
    }
}

/// An error, infinite where it is no number: nothing is known then.
fn known(error: f64) -> f64 {
    if error.is_nan() { f64::INFINITY } else { error }
}
