//! What is asked of a series.

use serde::Deserialize;

use super::{MeasuredSeries, Verdict, bound, order, power_law, spread};

/// What is asked; read from a table with its `kind`, as in `{ kind = "order", at-least = 1.9 }`.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(
    tag = "kind",
    deny_unknown_fields,
    rename_all = "kebab-case",
    rename_all_fields = "kebab-case"
)]
pub enum Judgement {
    /// value ∝ xᵖ with p ≥ `at_least`, by least squares in logarithms: the order of convergence where x is a spacing.
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
    /// (largest − least value) / value at the least x ≤ `at_most`: how much meshes differ.
    Spread {
        /// The largest share.
        at_most: f64,
    },
    /// |value − reference| ≤ tolerance for each value.
    Bound {
        /// The reference; that of the rows if absent.
        reference: Option<f64>,
        /// The tolerance; that of the rows if absent.
        tolerance: Option<f64>,
        /// The x that are judged; empty: all.
        #[serde(default)]
        at: Vec<f64>,
    },
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
                verdicts.push(Verdict::of_nothing(series.name()));
            }
            for verdict in &mut verdicts {
                verdict.pass = false;
                verdict.reached += &format!("; {} runs ended before their time", series.failed);
            }
        }
        verdicts
    }
}
