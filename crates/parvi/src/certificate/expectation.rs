//! E\[f\] of a user's function, with its error.

use parvi_pool::unit_of_squares;
use parvi_targets::{Target, scores_in_calls};

use super::Expectation;
use super::control_variates::ControlVariates;
use crate::Samples;

/// What of f may be unexplained before polynomials of a higher degree are tried.
const EXPLAINED: f64 = 0.05;

/// The expectation of `f` over the particles of any method, the target's own by the scores at the particles (one evaluation each), and
/// an error estimate.
///
/// `None` if the particles are too few (fewer than 8 D) or lie in a plane, or where a score or a value is not finite. The scores know nothing of the
/// masses of separate pieces: where particles are in several, the part between these counts as unexplained; of one that none is in nothing is said.
/// Nor do they know of edges: where the density falls to zero at once `estimate` may be anything, with little unexplained, and the standard error of the average is too large by as much. [`Pool::expectation`](parvi_pool::Pool::expectation)
/// is right there.
///
/// Of an event that no particle meets the average is 0 and its standard error, too, whatever the event's probability is: M particles know of probabilities from about 1/M on (docs/limitations.md).
pub fn expectation<const D: usize>(
    target: &dyn Target<D>,
    samples: &Samples<D>,
    f: impl Fn(&[f64; D]) -> f64,
) -> Option<Expectation> {
    let values: Vec<f64> = samples.positions.iter().map(f).collect();
    (Compiled::of().of_values)(target, samples, &values)
}

/// What is compiled for a dimension.
struct Compiled<const D: usize> {
    of_values: fn(&dyn Target<D>, &Samples<D>, &[f64]) -> Option<Expectation>,
}

impl<const D: usize> Compiled<D> {
    const HERE: Self = Self { of_values };
}

mpm_parallel::compiled_ahead!(Compiled);

/// [`expectation`] of the function that has these values at the particles.
fn of_values<const D: usize>(target: &dyn Target<D>, samples: &Samples<D>, values: &[f64]) -> Option<Expectation> {
    let positions = &samples.positions;
    if values.iter().any(|value| !value.is_finite()) {
        return None;
    }
    let mut scores = vec![[0.0; D]; positions.len()];
    scores_in_calls(target, positions, &mut scores);
    let weights = samples.weights.as_deref();
    let unit = unit_of_squares(values.iter().copied());
    let scaled: Vec<f64> = values.iter().map(|value| value / unit).collect();
    let found = ControlVariates::explaining(positions, &scores, weights, EXPLAINED, |regression, _| {
        let found = regression.expectation(&scaled);
        (found.unexplained_share(), found)
    });
    found.map(|found| found.times(unit))
}

#[cfg(test)]
mod tests {
    use parvi_targets::Gaussian;

    use super::*;
    use crate::{MpmOptions, Run, Silent};

    fn drawn<const D: usize>(target: &Gaussian<D>, count: usize) -> Samples<D> {
        let (options, run) = (MpmOptions::default(), Run::new(count, 3));
        let samples = options.sample(target, &parvi_targets::Frame::identity(), &run, &mut Silent);
        samples.expect("particles")
    }

    #[test]
    fn an_expectation_is_within_its_error() {
        let target = Gaussian::<2>::standard();
        let samples = drawn(&target, 500);
        let square = expectation(&target, &samples, |x| x[0] * x[0]).unwrap();
        assert!((square.estimate - 1.0).abs() < 1e-9, "{square:?}");
        assert!(
            (square.average - 1.0).abs() <= 1.01 * square.standard_error + 1e-9,
            "{square:?}"
        );
        let wave = expectation(&target, &samples, |x| (2.0 * x[0]).cos()).unwrap();
        let exact = (-2f64).exp();
        assert!((wave.average - exact).abs() <= 3.0 * wave.standard_error, "{wave:?}");
        assert!(expectation(&target, &samples, |x| x[0].ln()).is_none());
    }

    #[test]
    fn an_error_is_in_units_of_its_function() {
        let target = Gaussian::<1>::standard();
        let samples = drawn(&target, 200);
        let of = |unit: f64| expectation(&target, &samples, |x| unit * (1.0 + (2.0 * x[0]).sin().abs())).unwrap();
        let ordinary = of(1.0);
        assert!(ordinary.standard_error > 1e-4);
        for unit in [1e-300, 1e-170, 1e170, 1e300] {
            let extreme = of(unit);
            for (value, expected) in [
                (extreme.average, ordinary.average),
                (extreme.estimate, ordinary.estimate),
                (extreme.standard_deviation, ordinary.standard_deviation),
                (extreme.unexplained, ordinary.unexplained),
                (extreme.standard_error, ordinary.standard_error),
            ] {
                assert!((value / unit / expected - 1.0).abs() < 1e-9, "{unit}: {extreme:?}");
            }
        }
    }
}
