//! What a run knows about its own accuracy: what the pool or the scores say about moments, and the verdict drawn from that.

mod control_variates;
mod evidence;
mod expectation;
mod of_pool;
mod outcome;
mod stein_polynomials;

pub use control_variates::Expectation;
use evidence::Evidence;
pub use evidence::{EstimatedMoment, MomentEstimate};
pub use expectation::expectation;
pub use outcome::{Doubt, Outcome};

use crate::driven::Driven;

/// The largest estimated error of a mean (in standard deviations) or of a standard deviation (relative) of a run that is called converged: with two
/// standard errors of the pool on top, or with [`CAUTION`] of what the scores leave unexplained.
pub const LARGEST_ERROR: f64 = 0.09;

/// Part of what the scores leave unexplained that counts as an error.
pub const CAUTION: f64 = 0.2;

/// The largest part of a coordinate, or of its square, that the scores may leave unexplained then.
pub const LARGEST_UNEXPLAINED: f64 = 0.15;

/// The largest residual then, relative to independent draws.
pub const LARGEST_RESIDUAL: f64 = 1.1;

/// The largest drift over the last tenth of the steps of particles at rest, in standard deviations.
pub const LARGEST_DRIFT: f64 = 0.02;

/// How good the particles are, as far as the pool or the scores can tell (docs/theory.md, §13).
#[derive(Clone, Debug, PartialEq)]
pub struct Certificate {
    /// How the run ended.
    pub outcome: Outcome,
    /// Mean and standard deviation of every coordinate; empty where nothing is known of them (`svgd`).
    pub moments: Vec<MomentEstimate>,
    /// Degree of the polynomials that the estimates rest on, where they rest on scores; else 0.
    pub degree: usize,
    /// What the mean or the spread of a body changed by over the last tenth of the steps, or, of a run that its watch has ended, since the look before: in its standard deviations, the largest.
    pub drift: f64,
    /// ½ Σ m |v|² at the end (total mass 1), in frame coordinates.
    pub kinetic_energy: f64,
}

impl Certificate {
    /// The verdict of the scores on a body that stands for p^α; nothing has looked for other pieces of the target, so that it is never `converged`.
    pub(crate) fn of_scores<const D: usize>(body: &Driven<D>, alpha: f64) -> Self {
        let evidence = Evidence::new(&body.positions, &body.scores, &body.samples.positions);
        let moments = evidence.moments();
        let residual = body.samples.residual.unwrap_or(f64::NAN);
        let doubt = doubt_of_scores(&moments, residual, alpha).unwrap_or(Doubt::NotSurveyed);
        Self {
            outcome: Outcome::of(body.drift, Some(doubt)),
            moments,
            degree: evidence.degree(),
            drift: body.drift,
            kinetic_energy: body.kinetic_energy,
        }
    }

    /// That particles are where log p is no number, if some are; nothing is known of the others.
    pub(crate) fn of_outside(log_densities: &[f64]) -> Option<Self> {
        let particles = log_densities.iter().filter(|log| !log.is_finite()).count();
        let of = log_densities.len();
        (particles > 0).then(|| Self {
            outcome: Outcome::Stalled(Doubt::Outside { particles, of }),
            moments: Vec::new(),
            degree: 0,
            drift: 0.0,
            kinetic_energy: 0.0,
        })
    }

    /// The largest estimated error of a mean, in standard deviations.
    pub fn mean_error(&self) -> Option<f64> {
        self.moments.iter().map(MomentEstimate::mean_error).reduce(f64::max)
    }

    /// The largest part of a coordinate or its square that the scores leave unexplained.
    pub fn unexplained(&self) -> Option<f64> {
        self.moments.iter().map(MomentEstimate::unexplained).reduce(f64::max)
    }

    /// The largest estimated relative error of a standard deviation.
    pub fn standard_deviation_error(&self) -> Option<f64> {
        self.moments
            .iter()
            .map(MomentEstimate::standard_deviation_error)
            .reduce(f64::max)
    }
}

/// The first doubt that the scores raise.
fn doubt_of_scores(moments: &[MomentEstimate], residual: f64, alpha: f64) -> Option<Doubt> {
    if alpha != 1.0 {
        return Some(Doubt::Tempered { alpha });
    }
    if let Some((axis, share)) = worst(moments, &MomentEstimate::unexplained, LARGEST_UNEXPLAINED) {
        return Some(Doubt::Unexplained { axis, share });
    }
    let of_residual = exceeds(residual, LARGEST_RESIDUAL).then_some(Doubt::Residual { ratio: residual });
    doubt_of_moments(moments, CAUTION).or(of_residual)
}

/// Whether a mean or a standard deviation may be off, with this much of what is unexplained on top.
fn doubt_of_moments(moments: &[MomentEstimate], caution: f64) -> Option<Doubt> {
    let larger = |moment: &MomentEstimate| {
        let errors = [moment.mean_error(), moment.standard_deviation_error()];
        errors.into_iter().reduce(f64::max).unwrap_or(f64::NAN) + caution * moment.unexplained()
    };
    worst(moments, &larger, LARGEST_ERROR)?;
    // The one that is farther off is named.
    let doubts = (1..).zip(moments).flat_map(|(axis, moment)| {
        let mean = moment.mean_error() + caution * moment.mean.unexplained;
        let deviation = moment.standard_deviation_error() + caution * moment.standard_deviation.unexplained;
        let of_deviation = Doubt::StandardDeviation { axis, error: deviation };
        [(mean, Doubt::Mean { axis, error: mean }), (deviation, of_deviation)]
    });
    let worst = doubts.max_by(|(one, _), (other, _)| one.total_cmp(other));
    worst.map(|(_, doubt)| doubt)
}

/// The axis, from 1, at which a value is largest, if it is above its limit there.
fn worst(moments: &[MomentEstimate], of: &dyn Fn(&MomentEstimate) -> f64, limit: f64) -> Option<(usize, f64)> {
    let values = moments.iter().enumerate().map(|(a, moment)| (a + 1, of(moment)));
    let largest = values.max_by(|(_, a), (_, b)| a.total_cmp(b));
    largest.filter(|&(_, value)| exceeds(value, limit))
}

/// Whether a value is above its limit, or none.
fn exceeds(value: f64, limit: f64) -> bool {
    value.is_nan() || value > limit
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_moment_that_is_farther_off_is_named() {
        let moment = |error: f64, unexplained: f64| EstimatedMoment {
            value: 1.0 + error,
            estimate: 1.0,
            standard_error: error,
            unexplained,
        };
        let of = |mean, standard_deviation| MomentEstimate {
            mean,
            standard_deviation,
        };
        let sound = of(moment(0.0, 0.5), moment(0.0, 0.5));
        assert_eq!(doubt_of_moments(&[sound], 0.1), None);
        let vague = of(moment(0.03, 0.1), moment(0.03, 1.0));
        let doubt = doubt_of_moments(&[sound, vague], 0.1);
        let named = matches!(doubt, Some(Doubt::StandardDeviation { axis: 2, error }) if error > 0.12);
        assert!(named, "{doubt:?}");
        let off = of(moment(0.3, 0.1), moment(0.0, 0.1));
        let doubt = doubt_of_moments(&[off, vague], 0.1);
        assert!(matches!(doubt, Some(Doubt::Mean { axis: 1, .. })), "{doubt:?}");
    }
}
