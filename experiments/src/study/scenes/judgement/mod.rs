//! What is asked of the numbers of a family, and whether they keep it.

mod bound;
mod order;
mod power_law;
mod spread;

use serde::Deserialize;

pub use bound::limits;
pub use order::orders;
pub use power_law::fit;

use super::series::MeasuredSeries;

/// What is asked.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(
    tag = "kind",
    deny_unknown_fields,
    rename_all = "kebab-case",
    rename_all_fields = "kebab-case"
)]
pub enum Judgement {
    /// value ∝ xᵖ with p ≥ `at-least`, by least squares in logarithms: the order of convergence where x is a spacing.
    Order {
        /// The least p.
        at_least: f64,
    },
    /// value ∝ xᵖ with |p − `exponent`| ≤ `tolerance` for `from` ≤ x ≤ `to`.
    PowerLaw {
        /// The p asked for.
        exponent: f64,
        /// How far from it p may be.
        tolerance: f64,
        /// The least x that counts.
        from: Option<f64>,
        /// The largest x that counts.
        to: Option<f64>,
    },
    /// (largest − least value) / value at the least x ≤ `at-most`: how much meshes differ.
    Spread {
        /// The largest share.
        at_most: f64,
    },
    /// |value − reference| ≤ tolerance for each value.
    Bound {
        /// The reference; that of validation.csv if absent.
        reference: Option<f64>,
        /// The tolerance; that of validation.csv if absent.
        tolerance: Option<f64>,
        /// The x that are judged; empty: all.
        #[serde(default)]
        at: Vec<f64>,
    },
}

/// One line of the table of judgements.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// What was judged: a series, or one of its points.
    pub of: String,
    /// What was asked.
    pub asked: String,
    /// What was reached.
    pub reached: String,
    /// Whether that is enough. Never where a run of the series ended before its time.
    pub pass: bool,
}

impl Verdict {
    /// That there was nothing to judge.
    pub fn of_nothing(of: String) -> Self {
        Self {
            of,
            asked: "something to judge".to_owned(),
            reached: "none".to_owned(),
            pass: false,
        }
    }
}

impl Judgement {
    /// Judges a series; one line per series, or per point with a bound.
    pub fn judge(&self, series: &MeasuredSeries) -> Vec<Verdict> {
        let mut verdicts = match self {
            Self::Order { at_least } => vec![order::judge(series, *at_least)],
            Self::PowerLaw {
                exponent,
                tolerance,
                from,
                to,
            } => vec![power_law::judge(series, (*exponent, *tolerance), (*from, *to))],
            Self::Spread { at_most } => vec![spread::judge(series, *at_most)],
            Self::Bound {
                reference,
                tolerance,
                at,
            } => bound::judge(series, (*reference, *tolerance), at),
        };
        if series.failed > 0 {
            if verdicts.is_empty() {
                verdicts.push(Verdict::of_nothing(name(series)));
            }
            for verdict in &mut verdicts {
                verdict.pass = false;
                verdict.reached += &format!("; {} runs ended before their time", series.failed);
            }
        }
        verdicts
    }
}

/// The series' label, or a word for the only one.
fn name(series: &MeasuredSeries) -> String {
    if series.label.is_empty() {
        "all".to_owned()
    } else {
        series.label.clone()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::scenes::series::Point;

    /// A series without references through points (x, y).
    pub fn through(points: &[(f64, f64)]) -> MeasuredSeries {
        let point = |&(x, value): &(f64, f64)| Point {
            x,
            value,
            reference: None,
            tolerance: None,
        };
        MeasuredSeries {
            label: "cubic".to_owned(),
            points: points.iter().map(point).collect(),
            failed: 0,
        }
    }

    #[test]
    fn a_run_that_failed_fails_its_series() {
        let mut series = through(&[(1.0, 1.0), (2.0, 4.0)]);
        let judge = |series: &MeasuredSeries| Judgement::Order { at_least: 1.9 }.judge(series).remove(0);
        assert!(judge(&series).pass);
        series.failed = 1;
        assert!(!judge(&series).pass && judge(&series).reached.contains("1 runs ended"));
        series.points.clear();
        let bound = Judgement::Bound {
            reference: Some(0.0),
            tolerance: Some(9.0),
            at: Vec::new(),
        };
        let verdicts = bound.judge(&series);
        assert!(
            verdicts.len() == 1 && verdicts[0].reached == "none; 1 runs ended before their time",
            "{verdicts:?}"
        );
        assert!(!verdicts[0].pass);
    }
}
