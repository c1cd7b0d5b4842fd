//! What is asked of numbers over x, and whether they keep it: orders of convergence, power laws, spreads, bounds.

mod asked;
mod bound;
mod figure;
mod order;
mod power_law;
mod series;
mod several;
mod spread;
mod verdict;

pub use asked::Judgement;
pub use order::orders;
pub use series::{MeasuredSeries, Point};
pub use several::{Asked, without_run};
pub use verdict::Verdict;

#[cfg(test)]
use tests::through;

#[cfg(test)]
mod tests {
    use super::*;

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
            failed: Vec::new(),
        }
    }

    fn bound((reference, tolerance): (Option<f64>, Option<f64>), at: &[f64]) -> Judgement {
        let at = at.to_vec();
        Judgement::Bound {
            reference,
            tolerance,
            at,
        }
    }

    #[test]
    fn a_run_that_failed_fails_its_series() {
        let mut series = through(&[(1.0, 1.0), (2.0, 4.0)]);
        let judge = |series: &MeasuredSeries| Judgement::Order { at_least: 1.9 }.judge(series).remove(0);
        assert!(judge(&series).pass);
        series.failed = vec![3.0];
        assert!(!judge(&series).pass && judge(&series).reached.contains("1 run ended"));
        series.points.clear();
        let verdicts = bound((Some(0.0), Some(9.0)), &[]).judge(&series);
        assert!(
            verdicts.len() == 1 && verdicts[0].reached == "none; 1 run ended before their time",
            "{verdicts:?}"
        );
        assert!(!verdicts[0].pass);
    }

    #[test]
    fn a_run_that_failed_where_nothing_is_judged_does_not_count() {
        let mut series = through(&[(1.0, 1.0), (2.0, 4.0)]);
        series.failed = vec![3.0];
        let passes = |judgement: Judgement| judgement.judge(&series)[0].pass;
        let bound = |at: &[f64]| bound((Some(1.0), Some(0.5)), at);
        assert!(passes(bound(&[1.0])) && !passes(bound(&[])));
        let law = |to: Option<f64>| Judgement::PowerLaw {
            exponent: 2.0,
            tolerance: 0.5,
            from: None,
            to,
        };
        assert!(passes(law(Some(2.5))) && !passes(law(None)));
    }

    #[test]
    fn numbers_that_are_none_and_limits_that_are_missing_are_faults() {
        let fault = |judgement: Judgement, own: bool| judgement.fault(own).map(|fault| fault.0);
        assert_eq!(fault(Judgement::Spread { at_most: f64::NAN }, true), Some("at-most"));
        assert_eq!(fault(bound((None, None), &[1.0, f64::NAN]), true), Some("at"));
        assert_eq!(fault(bound((Some(1.0), None), &[]), false), Some("tolerance"));
        assert_eq!(fault(bound((Some(1.0), None), &[]), true), None);
    }
}
