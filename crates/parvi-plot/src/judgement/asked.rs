//! What is asked of a series.

use serde::Deserialize;

use super::power_law::within;
use super::{MeasuredSeries, Verdict, bound, order, power_law, spread};
use crate::page::counted;

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
        let failed = series.failed.iter().filter(|&&x| x.is_nan() || self.is_of(x)).count();
        if failed > 0 {
            if verdicts.is_empty() {
                verdicts.push(Verdict::of_nothing(series.name()));
            }
            for verdict in &mut verdicts {
                verdict.pass = false;
                verdict.reached += &format!("; {} ended before their time", counted(failed, "runs"));
            }
        }
        verdicts
    }

    /// Whether values at this x are judged.
    fn is_of(&self, x: f64) -> bool {
        match self {
            Self::Bound { at, .. } => at.is_empty() || at.contains(&x),
            Self::PowerLaw { from, to, .. } => within((*from, *to), x),
            Self::Order { .. } | Self::Spread { .. } => true,
        }
    }

    /// The x that a bound names.
    pub fn at(&self) -> &[f64] {
        match self {
            Self::Bound { at, .. } => at,
            _ => &[],
        }
    }

    /// What is wrong with it: the key, and why. Rows may have limits of their own, which a bound may then leave out.
    pub fn fault(&self, rows_have_limits: bool) -> Option<(&'static str, String)> {
        let mut numbers = match self {
            Self::Order { at_least } => vec![("at-least", Some(*at_least))],
            Self::Spread { at_most } => vec![("at-most", Some(*at_most))],
            Self::PowerLaw {
                exponent,
                tolerance,
                from,
                to,
            } => vec![
                ("exponent", Some(*exponent)),
                ("tolerance", Some(*tolerance)),
                ("from", *from),
                ("to", *to),
            ],
            Self::Bound {
                reference, tolerance, ..
            } => vec![("reference", *reference), ("tolerance", *tolerance)],
        };
        numbers.extend(self.at().iter().map(|x| ("at", Some(*x))));
        let fault = |(key, value): &(&'static str, Option<f64>)| match (*key, (*value)?) {
            (key, value) if value.is_nan() => Some((key, "NaN: must be a number".to_owned())),
            ("tolerance", value) if value < 0.0 => {
                let message = format!("{value}: must be at least 0, or nothing can keep it");
                Some(("tolerance", message))
            }
            _ => None,
        };
        let missing = |key| Some((key, "is missing: what is read has none of its own".to_owned()));
        numbers.iter().find_map(fault).or_else(|| match self {
            Self::PowerLaw {
                from: Some(from),
                to: Some(to),
                ..
            } if from > to => {
                let message = format!("{from}: must be at most `to` = {to}, or no x is between them");
                Some(("from", message))
            }
            Self::Bound { reference: None, .. } if !rows_have_limits => missing("reference"),
            Self::Bound { tolerance: None, .. } if !rows_have_limits => missing("tolerance"),
            _ => None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_nothing_can_keep_is_a_fault() {
        let fault = |judgement: Judgement| judgement.fault(true).map(|(key, _)| key);
        let bound = |tolerance| Judgement::Bound {
            reference: Some(1.0),
            tolerance: Some(tolerance),
            at: Vec::new(),
        };
        let law = |tolerance, from, to| Judgement::PowerLaw {
            exponent: 1.0,
            tolerance,
            from: Some(from),
            to: Some(to),
        };
        assert_eq!([bound(-1e-3), bound(0.0)].map(fault), [Some("tolerance"), None]);
        let laws = [law(-0.1, 1.0, 2.0), law(0.1, 2.0, 1.0), law(0.1, 1.0, 1.0)];
        assert_eq!(laws.map(fault), [Some("tolerance"), Some("from"), None]);
    }
}
