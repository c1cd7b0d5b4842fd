//! What is asked of numbers over x, and whether they keep it: orders of convergence, power laws, spreads, bounds.

mod asked;
mod bound;
mod figure;
mod order;
mod power_law;
mod series;
mod spread;
mod verdict;

pub use asked::Judgement;
pub use figure::{guides, levels};
pub use order::orders;
pub use series::{MeasuredSeries, Point};
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
