//! The surge front of a collapsing water column (Martin & Moyce 1952).

use super::curve::Curve;
use super::parts::{Rows, Run, gravity, sides, unfit};
use crate::ValidationRow;

const DATA: &str = include_str!("../../data/martin_moyce_1952.csv");

/// n² = height / base of the column, of base a.
const ASPECT: f64 = 2.0;

/// How finely the shift is searched.
const SHIFTS: i32 = 400;

/// The measured fronts (T, Z), T = n t √(g/a), Z = front / a.
fn measurements() -> Curve {
    Curve::parse(DATA)
}

/// The front of a run, (t, x − x_wall), as (T, Z).
fn scaled(front: &Curve, base: f64, gravity: f64) -> Curve {
    let rate = (ASPECT * gravity / base).sqrt();
    Curve {
        times: front.times.iter().map(|time| time * rate).collect(),
        values: front.values.iter().map(|x| x / base).collect(),
    }
}

/// The shift s in Z(T − s) of the scaled front of a run, within ±0.2 in steps of 0.001, that fits best (when the dam was really gone is not known better), and
/// the largest |Z(T − s) / Z_measured − 1| for T ≤ `limit` that it leaves; infinite where the run does not cover the measured times.
fn fit(run: &Curve, limit: f64) -> (f64, f64) {
    let measured = measurements();
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
    fits.fold(
        (0.0, f64::INFINITY),
        |best, fit| if fit.1 < best.1 { fit } else { best },
    )
}

/// Whether a box with these sides has the column's proportions.
pub(super) fn is_column(sides: &[f64]) -> bool {
    matches!(sides, &[base, height] if (height / base - ASPECT).abs() < 1e-9)
}

/// The front of a scene with a column beside a wall at its lower side, half a distance between particles beyond the outermost one: within 10 % for T ≤ 2.5.
///
/// # Errors
/// [`SceneFault::Value`](crate::SceneFault::Value) unless the first body is a box twice as high as wide.
pub(super) fn validate(run: &Run) -> Rows {
    let sides = sides(run.scene)?;
    let base = match sides.as_slice() {
        &[base, _] if is_column(&sides) => base,
        _ => return Err(unfit(run.scene, "for a column twice as high as wide")),
    };
    let mut front = run.curve("upper_x")?;
    let offset = base - front.first();
    front.values.iter_mut().for_each(|x| *x += offset);
    let (_, deviation) = fit(&scaled(&front, base, gravity(run.scene)), 2.5);
    Ok(vec![ValidationRow::at_most(
        "largest deviation of the front, T ≤ 2.5",
        deviation,
        0.1,
    )])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_measurements_are_the_fifteen_of_the_file() {
        let measured = measurements();
        assert_eq!(measured.times.len(), 15);
        assert_eq!(measured.points().next(), Some((0.41, 1.11)));
        assert_eq!(measured.points().last(), Some((3.33, 4.11)));
    }

    #[test]
    fn a_front_that_is_late_is_shifted_back_and_no_farther_than_allowed() {
        let measured = measurements();
        let late = |delay: f64| {
            let mut run = Curve::default();
            run.push(0.0, 1.0);
            measured
                .points()
                .for_each(|(time, front)| run.push(time + delay, front));
            run
        };
        let (shift, deviation) = fit(&late(0.123), 2.5);
        assert!((shift + 0.123).abs() < 1e-9 && deviation < 1e-9, "{shift} {deviation}");
        let (shift, deviation) = fit(&late(0.4), 2.5);
        assert!((shift + 0.2).abs() < 1e-9 && deviation > 0.05, "{shift} {deviation}");
    }

    #[test]
    fn a_run_that_ends_early_does_not_fit() {
        let mut run = Curve::default();
        run.push(0.0, 1.0);
        run.push(1.0, 1.3);
        assert!(fit(&run, 2.5).1.is_infinite());
    }

    #[test]
    fn time_is_scaled_by_the_root_of_gravity_over_base() {
        let mut front = Curve::default();
        front.push(1.0, 0.6);
        let scaled = scaled(&front, 0.5, 9.81);
        assert!((scaled.times[0] - (2.0f64 * 9.81 / 0.5).sqrt()).abs() < 1e-15 && scaled.values == [1.2]);
    }
}
