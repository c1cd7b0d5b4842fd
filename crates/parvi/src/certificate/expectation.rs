//! E\[f\] of a user's function, with its error.

use parvi_pool::{Estimate, unit_of_squares};
use parvi_targets::{Target, scores_in_calls};

use super::Expectation;
use super::control_variates::ControlVariates;
use crate::Samples;

/// What of f may be unexplained before polynomials of a higher degree are tried.
const EXPLAINED: f64 = 0.05;

/// Points that carry an estimate of the pool at least for it to speak against the scores.
const CARRIERS: f64 = 100.0;

/// Standard errors by which the two have to differ for that.
const CONTRADICTION: f64 = 5.0;

/// The expectation of `f` over the particles of any method, the target's own by the scores at the particles (one evaluation each), and
/// an error estimate. Where the method has a pool, f is evaluated at its points, too, and the estimate is that of smaller error of the scores and of [`Pool::expectation`](parvi_pool::Pool::expectation), or the pool's where the two
/// contradict each other.
///
/// `None` if the particles are too few (fewer than 8 D) or lie in a plane, or where a score or a value is not finite. The scores know nothing of the
/// masses of separate pieces: where particles are in several, the part between these counts as unexplained; of one that none is in nothing is said.
/// Nor do they know of edges: where the density falls to zero at once their estimate may be anything, with little unexplained, and the standard error of the average is too large by as much; of methods without a pool it is the only one.
///
/// Of an event that no particle meets the average is 0 and its standard error, too, whatever the event's probability is: M particles know of probabilities from about 1/M on (docs/limitations.md).
pub fn expectation<const D: usize>(
    target: &dyn Target<D>,
    samples: &Samples<D>,
    f: impl Fn(&[f64; D]) -> f64,
) -> Option<Expectation> {
    let values: Vec<f64> = samples.positions.iter().map(&f).collect();
    let found = (Compiled::of().of_values)(target, samples, &values)?;
    let known = samples.pool.as_ref().map(|pool| pool.expectation(f));
    Some(known.map_or(found, |known| with_pool(found, &known, samples.positions.len() as f64)))
}

/// The same with the estimate of the pool, where that is the better one or has to be believed.
fn with_pool(found: Expectation, pool: &Estimate, particles: f64) -> Expectation {
    let error = found.unexplained / particles.sqrt();
    let difference = (found.estimate - pool.value).abs();
    let contradicted = difference > CONTRADICTION * error.hypot(pool.standard_error);
    // False for a pool that has no number to say.
    let better = pool.standard_error < error || contradicted;
    if !(pool.carriers >= CARRIERS && difference.is_finite() && better) {
        return found;
    }
    Expectation {
        estimate: pool.value,
        unexplained: pool.standard_error * particles.sqrt(),
        standard_error: (pool.value - found.average).hypot(pool.standard_error),
        ..found
    }
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

    /// Stein's identity does not hold where a density ends: by the scores alone the mean is 0 with nothing unexplained, and E\[sin 5x\] anything.
    #[test]
    fn the_pool_knows_of_edges() {
        struct HalfNormal;
        impl Target<1> for HalfNormal {
            fn log_density(&self, x: &[f64; 1]) -> f64 {
                if x[0] > 0.0 {
                    -0.5 * x[0] * x[0]
                } else {
                    f64::NEG_INFINITY
                }
            }

            fn score(&self, x: &[f64; 1]) -> [f64; 1] {
                [-x[0]]
            }
        }
        let (options, run) = (MpmOptions::default(), Run::new(500, 3));
        let samples = options.sample(&HalfNormal, &parvi_targets::Frame::identity(), &run, &mut Silent);
        let samples = samples.expect("particles");
        // E[sin 5x] = (2 / √π) F(5 / √2) with Dawson's integral F.
        for (f, exact) in [
            (
                Box::new(|x: &[f64; 1]| x[0]) as Box<dyn Fn(&[f64; 1]) -> f64>,
                0.797_884_560_8,
            ),
            (Box::new(|x: &[f64; 1]| x[0] * x[0]), 1.0),
            (Box::new(|x: &[f64; 1]| (5.0 * x[0]).sin()), 0.166_953_959_1),
        ] {
            let found = expectation(&HalfNormal, &samples, f).expect("an expectation");
            let error = found.unexplained / 500_f64.sqrt();
            assert!(
                (found.estimate - exact).abs() < 4.0 * error + 1e-9,
                "{exact}: {found:?}"
            );
            assert!(error < 0.01 && found.standard_error < 0.02, "{exact}: {found:?}");
        }
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
