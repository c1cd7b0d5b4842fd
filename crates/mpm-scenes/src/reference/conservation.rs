//! Momentum and angular momentum of a closed system.

use super::parts::{Rows, Run};
use crate::ValidationRow;

/// Momenta of a plane system.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Momenta {
    /// Σ m_p v_p.
    pub linear: [f64; 2],
    /// Σ m_p (x_p × v_p + B_yx − B_xy): of the nodes after the transfer (Jiang et al. 2015, §5.3.1).
    pub angular: f64,
}

impl Momenta {
    /// Drift of the linear momentum at most 10⁻¹⁰ of `magnitude` = Σ m‖v‖, of the angular one relatively at most `angular`.
    pub fn checks(start: &Self, end: &Self, magnitude: f64, angular: f64) -> Vec<ValidationRow> {
        let drift = (end.linear[0] - start.linear[0]).hypot(end.linear[1] - start.linear[1]);
        let turn = (end.angular - start.angular).abs() / start.angular.abs();
        vec![
            ValidationRow::at_most("drift of momentum / sum of m|v|", drift / magnitude, 1e-10),
            ValidationRow::at_most("relative drift of angular momentum", turn, angular),
        ]
    }
}

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

fn compare(run: &Run, angular: f64) -> Rows {
    let columns = [
        run.curve("momentum_x")?,
        run.curve("momentum_y")?,
        run.curve("angular_momentum")?,
    ];
    let momenta = |pick: fn(&[f64]) -> Option<&f64>| {
        let [x, y, angular] = columns.each_ref().map(|c| pick(&c.values).copied().unwrap_or(f64::NAN));
        Momenta {
            linear: [x, y],
            angular,
        }
    };
    let last = run.last;
    let speeds = last.velocities.chunks(last.dimension.max(1));
    let speeds = speeds.map(|v| v.iter().map(|c| c * c).sum::<f64>().sqrt());
    let magnitude = last.masses.iter().zip(speeds).map(|(mass, speed)| mass * speed).sum();
    Ok(Momenta::checks(
        &momenta(|v| v.first()),
        &momenta(|v| v.last()),
        magnitude,
        angular,
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drifts_are_relative() {
        let start = Momenta {
            linear: [3.0, -1.0],
            angular: 2.0,
        };
        let end = Momenta {
            linear: [3.0 + 3e-9, -1.0 - 4e-9],
            angular: 2.0 - 2e-9,
        };
        let rows = Momenta::checks(&start, &end, 50.0, 1e-9);
        assert!((rows[0].measured - 1e-10).abs() < 1e-15 && (rows[1].measured - 1e-9).abs() < 1e-15);
        assert!(
            Momenta::checks(&start, &start, 50.0, 1e-9)
                .iter()
                .all(ValidationRow::passes)
        );
    }
}
