//! What is asked of several series.

use super::figure::{guides, levels};
use super::{Judgement, MeasuredSeries, Verdict};
use crate::{Axis, AxisKind, LineSeries, MultiplesPanel, MultiplesPlot};

/// Largest x over the least, both positive, from which on x has a logarithmic axis.
const LOGARITHMIC_FROM: f64 = 2.0;

/// Judgements of series.
#[derive(Clone, Copy, Debug)]
pub struct Asked<'a> {
    /// What is asked.
    pub judgements: &'a [Judgement],
    /// The labels, or parts of them, of the series that are judged; empty: all.
    pub judged: &'a [String],
}

impl Asked<'_> {
    /// What is wrong with a judgement: the key, as in `judgements.0.at`, and why. Rows may have limits of their own.
    pub fn fault(&self, rows_have_limits: bool) -> Option<(String, String)> {
        let mut judgements = self.judgements.iter().enumerate();
        judgements.find_map(|(place, judgement)| {
            let (key, message) = judgement.fault(rows_have_limits)?;
            Some((format!("judgements.{place}.{key}"), message))
        })
    }

    /// What finds nothing among runs, of which there are label and x: `judged`, or the `at` of a judgement, and why.
    pub fn unmet(&self, runs: &[(&str, f64)]) -> Option<(String, String)> {
        let is_of = |label: &str, names: &[String]| MeasuredSeries::named(label).is_among(names);
        let without = |name: &&String| !runs.iter().any(|(label, _)| is_of(label, std::slice::from_ref(*name)));
        if let Some(name) = self.judged.iter().find(without) {
            let message = format!("`{name}` is no part of the label of a series");
            return Some(("judged".to_owned(), message));
        }
        let judged = runs.iter().filter(|(label, _)| is_of(label, self.judged));
        let known: Vec<f64> = judged.map(|(_, x)| *x).collect();
        let mut judgements = self.judgements.iter().enumerate();
        judgements.find_map(|(place, judgement)| {
            let message = without_run(judgement.at(), &known)?;
            Some((format!("judgements.{place}.at"), message))
        })
    }

    fn is_judged(&self, series: &MeasuredSeries) -> bool {
        series.is_among(self.judged)
    }

    /// What the judgements say; one that finds nothing to judge is not kept.
    pub fn verdicts(&self, series: &[MeasuredSeries]) -> Vec<Verdict> {
        let of = |judgement: &Judgement| {
            let judged = series.iter().filter(|series| self.is_judged(series));
            let mut verdicts: Vec<Verdict> = judged.flat_map(|series| judgement.judge(series)).collect();
            if verdicts.is_empty() {
                verdicts.push(Verdict::of_nothing(self.judged.join(" or ")));
            }
            verdicts
        };
        self.judgements.iter().flat_map(of).collect()
    }

    /// The numbers against x, over logarithms where the largest is twice the least or more, with what is asked beside them. A line is named even if it is the only one, if only by `name`, with
    /// gaps where runs ended before their time; powers are over logarithms.
    pub fn plot(&self, series: &[MeasuredSeries], name: &str, [x_label, y_label]: [&str; 2]) -> MultiplesPlot {
        let shown: Vec<&MeasuredSeries> = series.iter().filter(|series| !series.points.is_empty()).collect();
        let judged: Vec<&MeasuredSeries> = shown.iter().copied().filter(|series| self.is_judged(series)).collect();
        let is_power =
            |judgement: &Judgement| matches!(judgement, Judgement::Order { .. } | Judgement::PowerLaw { .. });
        let power = self.judgements.iter().any(is_power);
        let x = || shown.iter().flat_map(|series| &series.points).map(|point| point.x);
        let [least, largest] = [x().fold(f64::INFINITY, f64::min), x().fold(0.0, f64::max)];
        let spread = least > 0.0 && largest >= LOGARITHMIC_FROM * least;
        let scale = |is_logarithmic: bool, otherwise: AxisKind| match is_logarithmic {
            true => AxisKind::Logarithmic,
            false => otherwise,
        };
        let line = |series: &&MeasuredSeries| {
            let label = Some(series.label.as_str()).filter(|label| !label.is_empty());
            LineSeries::through(label.unwrap_or(name), series.pairs_with_gaps())
        };
        MultiplesPlot {
            x: Axis::new(x_label, scale(spread, AxisKind::Linear)),
            y: Axis::new(y_label, scale(power, AxisKind::Automatic)),
            panels: vec![MultiplesPanel {
                series: shown.iter().map(line).collect(),
                guides: guides(self.judgements, &judged),
                levels: levels(self.judgements, &judged),
                ..MultiplesPanel::default()
            }],
            ..MultiplesPlot::default()
        }
    }
}

/// What is wrong with chosen x, of which one is that of no run.
pub fn without_run(chosen: &[f64], known: &[f64]) -> Option<String> {
    let missed = chosen.iter().find(|x| !known.contains(x))?;
    Some(format!("no run has {missed} as its x; there are {known:?}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::judgement::through;

    fn bound(at: &[f64]) -> Judgement {
        Judgement::Bound {
            reference: Some(0.0),
            tolerance: Some(2.0),
            at: at.to_vec(),
        }
    }

    #[test]
    fn a_judgement_that_finds_nothing_to_judge_is_not_kept() {
        let series = MeasuredSeries {
            label: "graded, local".to_owned(),
            ..through(&[(1.0, 0.5)])
        };
        let verdicts = |name: &str| {
            let (judgements, judged) = ([bound(&[1.0])], [name.to_owned()]);
            let asked = Asked {
                judgements: &judgements,
                judged: &judged,
            };
            asked.verdicts(std::slice::from_ref(&series))
        };
        let unknown = verdicts("graded, global");
        assert!(unknown.len() == 1 && !unknown[0].pass && unknown[0].reached == "none");
        assert!(verdicts("graded")[0].pass && verdicts("graded, local")[0].pass);
    }

    #[test]
    fn what_no_run_meets_is_named() {
        let (judgements, judged) = ([bound(&[]), bound(&[2.0])], ["local".to_owned()]);
        let mut asked = Asked {
            judgements: &judgements,
            judged: &judged,
        };
        let unmet = |asked: &Asked<'_>| {
            asked
                .unmet(&[("graded, local", 1.0), ("even", 2.0)])
                .map(|(key, _)| key)
        };
        assert_eq!(unmet(&asked).as_deref(), Some("judgements.1.at"));
        asked.judgements = &judgements[..1];
        assert_eq!(unmet(&asked), None);
        let unknown = ["global".to_owned()];
        asked.judged = &unknown;
        assert_eq!(unmet(&asked).as_deref(), Some("judged"));
    }

    #[test]
    fn x_is_over_logarithms_from_a_factor_of_two_on() {
        let asked = Asked {
            judgements: &[],
            judged: &[],
        };
        let kind = |points: &[(f64, f64)]| asked.plot(&[through(points)], "", ["x", "y"]).x.kind;
        assert_eq!(kind(&[(1.0, 0.5), (1.9, 0.5)]), AxisKind::Linear);
        assert_eq!(kind(&[(1.0, 0.5), (2.0, 0.5)]), AxisKind::Logarithmic);
        assert_eq!(kind(&[(0.0, 0.5), (2.0, 0.5)]), AxisKind::Linear);
    }
}
