//! Momentum and angular momentum of a closed system.

use super::curve::Curve;
use super::parts::{Rows, Run};
use crate::ValidationRow;

/// The first and the last row of the series; Σ m‖v‖ is that of the last particles.
///
/// # Errors
/// [`SceneFault::Value`](crate::SceneFault::Value) where a column is missing.
pub(super) fn validate(run: &Run) -> Rows {
    compare(run, 1e-9)
}

/// As [`validate`], with 10⁻⁷ for the angular momentum (Cao et al. 2024, appendix D).
///
/// # Errors
/// As [`validate`].
pub(super) fn validate_on_mesh(run: &Run) -> Rows {
    compare(run, 1e-7)
}

/// Σ m_p v_p, and Σ m_p (x_p × v_p + B_yx − B_xy), the angular momentum of the nodes after the transfer (Jiang et al. 2015, §5.3.1).
fn compare(run: &Run, angular: f64) -> Rows {
    let last = run.last;
    let speeds = last.velocities.chunks(last.dimension.max(1));
    let speeds = speeds.map(|v| v.iter().map(|c| c * c).sum::<f64>().sqrt());
    let momenta = last.masses.iter().zip(speeds).map(|(mass, speed)| mass * speed);
    let arms = last.positions.chunks(last.dimension.max(1));
    let arms = arms.map(|x| x.iter().map(|c| c * c).sum::<f64>().sqrt());
    let turning = arms.zip(momenta.clone()).map(|(arm, momentum)| arm * momentum).sum();
    let (x, y) = (run.curve("momentum_x")?, run.curve("momentum_y")?);
    let momenta = [momenta.sum(), turning];
    Ok(drifts([&x, &y, &run.curve("angular_momentum")?], momenta, angular))
}

/// Drift of the linear momentum at most 10⁻¹⁰ of `linear` = Σ m‖v‖, of the angular one relatively at most `angular`; of one that is nothing beside `turning` = Σ m‖x‖‖v‖, relative to a
/// thousandth of that. Bodies at rest have kept what they did not have.
fn drifts(momenta: [&Curve; 3], [linear, turning]: [f64; 2], angular: f64) -> Vec<ValidationRow> {
    let [x, y, turn] = momenta.map(|curve| curve.last() - curve.first());
    let share = |drift: f64, of: f64| drift.abs() / of.max(f64::MIN_POSITIVE);
    let turn = share(turn, momenta[2].first().abs().max(1e-3 * turning));
    vec![
        ValidationRow::at_most("drift of momentum / sum of m|v|", share(x.hypot(y), linear), 1e-10),
        ValidationRow::at_most("relative drift of angular momentum", turn, angular),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drifts_are_relative() {
        let from_to = |start: f64, end: f64| Curve {
            times: vec![0.0, 1.0],
            values: vec![start, end],
        };
        let (x, y, turn) = (
            from_to(3.0, 3.0 + 3e-9),
            from_to(-1.0, -1.0 - 4e-9),
            from_to(2.0, 2.0 - 2e-9),
        );
        let rows = drifts([&x, &y, &turn], [50.0, 2.0], 1e-9);
        assert!((rows[0].measured - 1e-10).abs() < 1e-15 && (rows[1].measured - 1e-9).abs() < 1e-15);
        let still = from_to(2.0, 2.0);
        assert!(drifts([&still; 3], [50.0, 2.0], 1e-9).iter().all(ValidationRow::passes));
    }

    #[test]
    fn a_momentum_that_is_nothing_has_a_drift() {
        let ended = |end: f64| Curve {
            times: vec![0.0, 1.0],
            values: vec![0.0, end],
        };
        let passes = |end: f64, momenta| {
            let rows = drifts([&ended(0.0), &ended(0.0), &ended(end)], momenta, 1e-9);
            rows.iter().all(ValidationRow::passes)
        };
        assert!(passes(0.0, [50.0, 10.0]) && passes(9e-12, [50.0, 10.0]) && passes(0.0, [0.0; 2]));
        assert!(!passes(2e-11, [50.0, 10.0]) && !passes(f64::NAN, [50.0, 10.0]));
    }
}
