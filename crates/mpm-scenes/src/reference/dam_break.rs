//! The surge front of a collapsing water column (Martin & Moyce 1952).

use super::curve::Curve;
use super::parts::{Rows, Run, gravity, sides, unfit};
use crate::ValidationRow;

const DATA: &str = include_str!("../../data/martin_moyce_1952.csv");

/// A column of base a and height n² a that a dam held back until t = 0; g is gravity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DamBreak {
    /// a.
    pub base: f64,
    /// n² = height / base.
    pub aspect: f64,
    /// g.
    pub gravity: f64,
}

/// How a run compares with the measurements.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrontFit {
    /// The shift s in Z(T − s), within ±0.2, that fits best: when the dam was really gone is not known better.
    pub shift: f64,
    /// Largest |Z(T − s) / Z_measured − 1| over the measured times up to the limit.
    pub largest_deviation: f64,
}

/// How finely the shift is searched.
const SHIFTS: i32 = 400;

impl DamBreak {
    /// The measured fronts (T, Z), T = n t √(g/a), Z = front / a, for n² = 2.
    pub fn measurements() -> Curve {
        Curve::parse(DATA)
    }

    /// T = n t √(g/a).
    pub fn scaled_time(&self, time: f64) -> f64 {
        time * (self.aspect * self.gravity / self.base).sqrt()
    }

    /// The front of a run, (t, x − x_wall), as (T, Z).
    pub fn scaled(&self, front: &Curve) -> Curve {
        let mut scaled = Curve::default();
        for (time, x) in front.points() {
            scaled.push(self.scaled_time(time), x / self.base);
        }
        scaled
    }

    /// The best shift of the scaled front of a run, in steps of 0.001, and the deviation that it leaves for T ≤ `limit`; infinite
    /// where the run does not cover the measured times.
    pub fn fit(run: &Curve, limit: f64) -> FrontFit {
        let measured = Self::measurements();
        let deviation = |shift: f64| {
            let within = measured.points().filter(|&(time, _)| time <= limit);
            within.fold(0.0, |worst: f64, (time, front)| {
                // Before the dam is gone the front is where it was.
                let first = run.values.first().copied();
                let computed = if time < shift { first } else { run.at(time - shift) };
                worst.max(computed.map_or(f64::INFINITY, |z| (z / front - 1.0).abs()))
            })
        };
        let shifts = (-SHIFTS / 2..=SHIFTS / 2).map(|k| 0.4 * f64::from(k) / f64::from(SHIFTS));
        let fits = shifts.map(|shift| (shift, deviation(shift)));
        let none = (0.0, f64::INFINITY);
        let (shift, largest_deviation) = fits.fold(none, |best, fit| if fit.1 < best.1 { fit } else { best });
        FrontFit {
            shift,
            largest_deviation,
        }
    }

    /// Within 10 % for T ≤ 2.5.
    pub fn check(&self, front: &Curve) -> ValidationRow {
        let fit = Self::fit(&self.scaled(front), 2.5);
        ValidationRow::at_most("largest deviation of the front, T ≤ 2.5", fit.largest_deviation, 0.1)
    }
}

/// Whether a box with these sides is twice as high as wide.
pub(super) fn is_column(sides: &[f64]) -> bool {
    matches!(sides, &[base, height] if (height / base - 2.0).abs() < 1e-9)
}

/// The front of a scene with a column beside a wall at its lower side: half a distance between particles beyond the outermost one.
///
/// # Errors
/// [`SceneFault::Value`](crate::SceneFault::Value) unless the first body is a box twice as high as wide.
pub(super) fn validate(run: &Run) -> Rows {
    let sides = sides(run.scene)?;
    let dam = match sides.as_slice() {
        &[base, _] if is_column(&sides) => DamBreak {
            base,
            aspect: 2.0,
            gravity: gravity(run.scene),
        },
        _ => return Err(unfit(run.scene, "for a column twice as high as wide")),
    };
    let mut front = run.curve("upper_x")?;
    let offset = dam.base - front.first();
    front.values.iter_mut().for_each(|x| *x += offset);
    Ok(vec![dam.check(&front)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_measurements_are_the_fifteen_of_the_file() {
        let measured = DamBreak::measurements();
        assert_eq!(measured.times.len(), 15);
        assert_eq!(measured.points().next(), Some((0.41, 1.11)));
        assert_eq!(measured.points().last(), Some((3.33, 4.11)));
    }

    #[test]
    fn a_front_that_is_late_is_shifted_back_and_no_farther_than_allowed() {
        let measured = DamBreak::measurements();
        let late = |delay: f64| {
            let mut run = Curve::default();
            run.push(0.0, 1.0);
            measured
                .points()
                .for_each(|(time, front)| run.push(time + delay, front));
            run
        };
        let fit = DamBreak::fit(&late(0.123), 2.5);
        assert!(
            (fit.shift + 0.123).abs() < 1e-9 && fit.largest_deviation < 1e-9,
            "{fit:?}"
        );
        let fit = DamBreak::fit(&late(0.4), 2.5);
        assert!(
            (fit.shift + 0.2).abs() < 1e-9 && fit.largest_deviation > 0.05,
            "{fit:?}"
        );
    }

    #[test]
    fn a_run_that_ends_early_does_not_fit() {
        let mut run = Curve::default();
        run.push(0.0, 1.0);
        run.push(1.0, 1.3);
        assert!(DamBreak::fit(&run, 2.5).largest_deviation.is_infinite());
    }

    #[test]
    fn time_is_scaled_by_the_root_of_gravity_over_base() {
        let dam = DamBreak {
            base: 0.5,
            aspect: 2.0,
            gravity: 9.81,
        };
        assert!((dam.scaled_time(1.0) - (2.0f64 * 9.81 / 0.5).sqrt()).abs() < 1e-15);
    }
}
