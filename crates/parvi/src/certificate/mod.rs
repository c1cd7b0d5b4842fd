//! What a run knows about its own accuracy: expectations with control variates, and the verdict drawn from them.

mod control_variates;
mod evidence;
mod expectation;
mod outcome;
mod stein_polynomials;

pub use control_variates::Expectation;
pub use evidence::MomentEstimate;
pub(crate) use evidence::{Evidence, moments};
pub use expectation::expectation;
pub use outcome::{Doubt, Outcome};

/// The largest estimated error of a mean (in standard deviations) or of a standard deviation (relative) of a run that is called converged: with a
/// fifth of what is unexplained on top.
pub const LARGEST_ERROR: f64 = 0.09;

/// The largest part of a coordinate, or of its square, that the scores may leave unexplained then.
pub const LARGEST_UNEXPLAINED: f64 = 0.15;

/// The largest standard error that the masses of separate pieces may bring into a mean then, in standard deviations.
pub const LARGEST_MASS_ERROR: f64 = 0.05;

/// The largest residual then, relative to independent draws.
pub const LARGEST_RESIDUAL: f64 = 1.1;

/// The largest drift over the last tenth of the steps of particles at rest, in standard deviations.
pub const LARGEST_DRIFT: f64 = 0.02;

/// The largest mass of pieces that have no particles at all then.
pub const LARGEST_MASS_LEFT_OUT: f64 = 0.01;

/// How good the particles are, as far as the scores can tell (docs/theory.md, §13).
#[derive(Clone, Debug, PartialEq)]
pub struct Certificate {
    /// How the run ended.
    pub outcome: Outcome,
    /// Mean and standard deviation of every coordinate.
    pub moments: Vec<MomentEstimate>,
    /// Degree of the polynomials that the estimates rest on; of several bodies the largest.
    pub degree: usize,
    /// What the mean or the spread of a body changed by over the last tenth of the steps, in its standard deviations: the largest.
    pub drift: f64,
    /// ½ Σ m |v|² at the end (total mass 1), in frame coordinates.
    pub kinetic_energy: f64,
    /// Standard error that the masses of separate pieces bring into a mean, in standard deviations: the largest; `None` for one piece. The
    /// residual and the scores are blind to these masses.
    pub mass_error: Option<f64>,
    /// The mass of pieces that are known but have no particles, since there were too few.
    pub mass_left_out: f64,
}

/// What the verdict is drawn from, besides the bodies' evidence.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Circumstances {
    pub particles: usize,
    /// Relative to independent draws.
    pub residual: f64,
    pub drift: f64,
    pub kinetic_energy: f64,
    pub mass_error: Option<f64>,
    /// The mass of pieces that are known but have no particles, since there were too few.
    pub mass_left_out: f64,
    /// Whether the target was searched for separate pieces.
    pub surveyed: bool,
    /// The power of p that the particles stand for.
    pub alpha: f64,
}

impl Certificate {
    /// The verdict on bodies with this evidence.
    pub(crate) fn of<const D: usize>(bodies: &[Evidence<D>], circumstances: Circumstances) -> Self {
        let moments = moments(bodies, circumstances.particles);
        Self {
            outcome: verdict(&moments, &circumstances),
            moments,
            degree: bodies.iter().map(Evidence::degree).max().unwrap_or(0),
            drift: circumstances.drift,
            kinetic_energy: circumstances.kinetic_energy,
            mass_error: circumstances.mass_error,
            mass_left_out: circumstances.mass_left_out,
        }
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

/// The first doubt, or none.
fn verdict(moments: &[MomentEstimate], circumstances: &Circumstances) -> Outcome {
    let drift = circumstances.drift;
    if exceeds(drift, LARGEST_DRIFT) {
        return Outcome::BudgetExhausted { drift };
    }
    let axes = || moments.iter().enumerate().map(|(a, moment)| (a + 1, moment));
    let worst = |of: &dyn Fn(&MomentEstimate) -> f64, limit: f64| {
        axes()
            .map(|(axis, moment)| (axis, of(moment)))
            .max_by(|(_, a), (_, b)| a.total_cmp(b))
            .filter(|&(_, value)| exceeds(value, limit))
    };
    let cautious = |error: f64, moment: &MomentEstimate| error + 0.2 * moment.unexplained();
    let doubt = if circumstances.alpha != 1.0 {
        Some(Doubt::Tempered {
            alpha: circumstances.alpha,
        })
    } else if exceeds(circumstances.mass_left_out, LARGEST_MASS_LEFT_OUT) {
        Some(Doubt::LeftOut {
            mass: circumstances.mass_left_out,
        })
    } else if let Some((axis, share)) = worst(&MomentEstimate::unexplained, LARGEST_UNEXPLAINED) {
        Some(Doubt::Unexplained { axis, share })
    } else if let Some((axis, error)) = worst(&|moment| cautious(moment.mean_error(), moment), LARGEST_ERROR) {
        Some(Doubt::Mean { axis, error })
    } else if let Some((axis, error)) = worst(
        &|moment| cautious(moment.standard_deviation_error(), moment),
        LARGEST_ERROR,
    ) {
        Some(Doubt::StandardDeviation { axis, error })
    } else if exceeds(circumstances.residual, LARGEST_RESIDUAL) {
        Some(Doubt::Residual {
            ratio: circumstances.residual,
        })
    } else if let Some(error) = circumstances
        .mass_error
        .filter(|&error| exceeds(error, LARGEST_MASS_ERROR))
    {
        Some(Doubt::Masses { error })
    } else {
        (!circumstances.surveyed).then_some(Doubt::NotSurveyed)
    };
    doubt.map_or(Outcome::Converged, Outcome::Stalled)
}

/// Whether a value is above its limit, or none.
fn exceeds(value: f64, limit: f64) -> bool {
    value.is_nan() || value > limit
}
