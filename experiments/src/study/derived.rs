//! Numbers that follow from those in results, and have names like these.

use super::row::RunRow;
use crate::plots::results::Row;

/// Squared energy distance.
pub const ENERGY: &str = "energy_distance_squared";
/// Wall time.
pub const SECONDS: &str = "wall_seconds";

/// Wall time, least, median and most.
pub const WALL: [&str; 3] = ["wall_seconds_least", SECONDS, "wall_seconds_most"];

/// The same over the steps.
pub const PER_STEP: [&str; 3] = [
    "wall_seconds_per_step_least",
    "wall_seconds_per_step",
    "wall_seconds_per_step_most",
];

/// Standard errors within which two numbers may be the same.
const REACH: f64 = 3.0;

/// A name and the number, where the row has what it takes, earlier ones included.
type Derived = (&'static str, fn(&Row) -> Option<f64>);

const DERIVED: [Derived; 29] = [
    // The energy distance.
    ("energy_above_zero", |row| {
        row.number(ENERGY).filter(|energy| *energy > 0.0)
    }),
    ("energy_root", |row| Some(row.number(ENERGY)?.max(0.0).sqrt())),
    ("energy_thousandths", |row| Some(1e3 * row.number(ENERGY)?)),
    // Relative to independent draws.
    ("energy_ratio", |row| ratio(row, ENERGY, "energy_level")),
    ("sliced_ratio", |row| ratio(row, "sliced_wasserstein", "sliced_level")),
    ("final_ratio", |row| ratio(row, "final_energy", "energy_level")),
    ("best_ratio", |row| ratio(row, "best_energy", "energy_level")),
    ("start_ratio", |row| ratio(row, "start_energy", "energy_level")),
    ("end_over_best", |row| ratio(row, "final_energy", "best_energy")),
    // Relative to the method whose error is to be reached.
    ("energy_over_goal", |row| ratio(row, ENERGY, "goal")),
    // Of all kinds.
    ("evaluations", |row| {
        Some(row.number("score_evaluations")? + row.number("density_evaluations")?)
    }),
    ("evaluations_per_particle", |row| ratio(row, "evaluations", "particles")),
    ("nodes_per_particle", |row| ratio(row, "active_nodes", "particles")),
    ("scores_per_step", |row| {
        Some(row.number("score_evaluations")? / row.number("steps").filter(|steps| *steps > 0.0)?)
    }),
    ("seconds_per_step", |row| ratio(row, SECONDS, "steps")),
    ("step_microseconds", |row| Some(1e6 * row.number("seconds_per_step")?)),
    ("nanoseconds_per_particle", |row| {
        Some(row.number("wall_seconds_per_step")? / row.number("particles")? * 1e9)
    }),
    ("failed", |row| Some(f64::from(u8::from(!row.finished())))),
    ("stencil", |row| Some(stencil(row.count("dim")?))),
    // A constant α, which is stated as a number, and E of a law that has it.
    ("alpha", |row| row.text("schedule").parse().ok()),
    ("youngs_modulus", |row| {
        let mut parts = row.text("material").split(' ');
        parts.find_map(|part| part.strip_prefix("E="))?.parse().ok()
    }),
    // Of all moments.
    ("larger_error", |row| {
        Some(row.number("mean_error")?.max(row.number("deviation_error")?))
    }),
    ("deviation_percent", |row| Some(100.0 * row.number("deviation_error")?)),
    // What remains of them when the sample that stands for the target is off by three standard errors of its own.
    ("certain_error", |row| {
        let certain = |error: &str, of: &str| Some(row.number(error)? - REACH * row.number(of).unwrap_or(0.0));
        let mean = certain("mean_error", "reference_mean_error")?;
        Some(mean.max(certain("deviation_error", "reference_deviation_error")?))
    }),
    ("certain_ratio", |row| {
        let reference = ratio(row, "particles", "reference_size").unwrap_or(0.0);
        Some(row.number("energy_ratio")? - REACH * reference)
    }),
    // log Z beside its known value, also in standard errors of the method's own.
    ("evidence_deviation", |row| {
        Some(row.number("log_evidence_deviation")?.abs())
    }),
    ("evidence_ratio", |row| {
        ratio(row, "evidence_deviation", "log_evidence_error")
    }),
    // ED² relative to as many independent draws as there are particles.
    ("draws_ratio", |row| {
        Some(row.number(ENERGY)? * row.number("particles")? / row.number("mean_distance")?)
    }),
    ("draws_per_particle", |row| row.number("draws_ratio").map(f64::recip)),
];

/// 3ᵈ, the nodes that a particle has of quadratic B-splines.
pub fn stencil(dim: usize) -> f64 {
    3f64.powi(dim as i32)
}

fn ratio(row: &Row, column: &str, over: &str) -> Option<f64> {
    Some(row.number(column)? / row.number(over)?)
}

/// The row with the numbers that follow from it, and how it `ended`; those that a study writes itself stay.
pub fn completed(row: &Row) -> Row {
    let with = |row: Row, (name, number): Derived| match number(&row) {
        Some(number) if row.number(name).is_none() => row.with(name, number),
        _ => row,
    };
    DERIVED.into_iter().fold(row.clone().with("ended", row.ending()), with)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_study_writes_itself_stays() {
        let row = Row::of("a").with(ENERGY, 0.04).with("energy_level", 0.08);
        let row = row
            .with("score_evaluations", 3_usize)
            .with("density_evaluations", 5_usize);
        let completed = completed(&row.clone().with("evaluations", 1_usize));
        assert_eq!(completed.number("energy_ratio"), Some(0.5));
        assert_eq!(completed.number("energy_root"), Some(0.2));
        assert_eq!(completed.number("evaluations"), Some(1.0));
        assert_eq!(super::completed(&row).number("evaluations"), Some(8.0));
        assert_eq!(completed.number("evidence_ratio"), None);
        assert_eq!(completed.number("certain_ratio"), Some(0.5));
    }

    #[test]
    fn what_a_small_reference_sample_may_be_off_is_not_held_against_a_run() {
        let row = Row::of("a").with("mean_error", 0.5).with("deviation_error", 0.2);
        let row = row.with("particles", 100_usize).with("energy_ratio", 4.0);
        assert_eq!(completed(&row).number("certain_error"), Some(0.5));
        let row = row.with("reference_size", 50.0).with("reference_mean_error", 0.125);
        let completed = completed(&row.with("reference_deviation_error", 0.01));
        assert_eq!(completed.number("certain_error"), Some(0.2 - 0.03));
        assert_eq!(completed.number("certain_ratio"), Some(-2.0));
    }
}
