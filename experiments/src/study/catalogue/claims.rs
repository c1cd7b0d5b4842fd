//! What runs say of themselves, beside what is measured.

use crate::plots::page::{MISSING, Page, line, number, percent};
use crate::study::run_row::{Quantity, RunRow};

/// The claim holds where no mean is farther off than this, in standard deviations of the target …
const LARGEST_MEAN_ERROR: f64 = 0.1;
/// … and no standard deviation by more than this part of it.
const LARGEST_DEVIATION_ERROR: f64 = 0.1;

/// The largest of the values, and the case it belongs to.
pub fn worst<'a>(rows: &[&'a RunRow], quantity: impl Fn(&RunRow) -> Option<f64>) -> Option<(f64, &'a str)> {
    rows.iter()
        .filter_map(|row| Some((quantity(row)?, row.case.as_str())))
        .max_by(|left, right| left.0.total_cmp(&right.0))
}

/// The runs of a method, by what they claim and what is measured.
pub struct Claims<'a> {
    runs: Vec<&'a RunRow>,
}

impl<'a> Claims<'a> {
    /// Of the runs of one method.
    pub fn new(method: &str, rows: &'a [RunRow]) -> Self {
        Self {
            runs: rows.iter().filter(|row| row.method == method).collect(),
        }
    }

    /// Of the runs on one target among these.
    fn on(&self, target: &str) -> Self {
        Self {
            runs: self.runs.iter().copied().filter(|row| row.target == target).collect(),
        }
    }

    /// Runs that claim to have converged.
    pub fn claimed(&self) -> Vec<&'a RunRow> {
        self.having(RunRow::claims)
    }

    /// Claims beyond the bounds; particles that could not be measured are beyond any bound.
    pub fn false_claims(&self) -> Vec<&'a RunRow> {
        self.having(|row| row.claims() && !is_within(row))
    }

    /// Runs within the bounds that do not claim it.
    pub fn unclaimed(&self) -> Vec<&'a RunRow> {
        self.having(|row| !row.claims() && is_within(row))
    }

    fn having(&self, property: impl Fn(&RunRow) -> bool) -> Vec<&'a RunRow> {
        self.runs.iter().copied().filter(|row| property(row)).collect()
    }

    /// How often the claim is made, what it is worth, and every claim that is false.
    pub fn write(&self, targets: &[String], page: &mut Page) {
        page.heading("Claims");
        if self.runs.iter().all(|row| row.outcome.is_none()) {
            page.paragraph("No run says anything of itself.");
            return;
        }
        let within = format!(
            "every mean within {LARGEST_MEAN_ERROR} standard deviations and every standard deviation within {} %",
            100.0 * LARGEST_DEVIATION_ERROR
        );
        page.paragraph(format!(
            "A run that says `converged` claims {within}. The largest errors are those among such runs; the last column counts \
             the runs that are within these bounds without a claim.",
        ));
        let header = "target | runs | claimed | share | worst mean (sd) | worst sd (relative) | false claims | within, not claimed";
        let lines = targets.iter().map(|target| self.on(target).line(target));
        page.table(header, lines.chain([self.line("all")]));
        let false_claims = self.false_claims();
        if false_claims.is_empty() {
            page.paragraph("No claim is false.");
        } else {
            let lines: Vec<String> = false_claims.iter().map(|row| false_claim(row)).collect();
            page.paragraph(format!("Claims that are false:\n\n{}", lines.join("\n")));
        }
        self.write_outcomes(page);
    }

    fn line(&self, name: &str) -> Vec<String> {
        let claimed = self.claimed();
        line(&[
            &name,
            &self.runs.len(),
            &claimed.len(),
            &percent(claimed.len(), self.runs.len()),
            &largest(&claimed, |row| row.mean_error),
            &largest(&claimed, |row| row.deviation_error),
            &self.false_claims().len(),
            &self.unclaimed().len(),
        ])
    }

    /// A line per outcome, with the largest errors among the runs that state it.
    fn write_outcomes(&self, page: &mut Page) {
        page.paragraph(format!(
            "All outcomes that are stated ({MISSING}: none), with the largest errors beside them:"
        ));
        let mut outcomes: Vec<Option<&str>> = self.runs.iter().map(|row| row.outcome.as_deref()).collect();
        outcomes.sort_unstable();
        outcomes.dedup();
        let line = |outcome: &Option<&str>| {
            let here = self.having(|row| row.outcome.as_deref() == *outcome);
            let larger = |row: &RunRow| Some(row.mean_error?.max(row.deviation_error?));
            line(&[
                outcome,
                &here.len(),
                &largest(&here, |row| row.mean_error),
                &largest(&here, |row| row.deviation_error),
                &largest(&here, |row| row.mass_error),
                &worst(&here, larger).map(|(_, case)| format!("`{case}`")),
            ])
        };
        let header = "outcome | runs | worst mean (sd) | worst sd (relative) | worst mode mass | worst case";
        page.table(header, outcomes.iter().map(line));
    }
}

fn is_within(row: &RunRow) -> bool {
    row.mean_error.is_some_and(|error| error <= LARGEST_MEAN_ERROR)
        && row
            .deviation_error
            .is_some_and(|error| error <= LARGEST_DEVIATION_ERROR)
}

fn largest(rows: &[&RunRow], quantity: Quantity) -> Option<f64> {
    worst(rows, quantity).map(|(value, _)| value)
}

fn false_claim(row: &RunRow) -> String {
    match row.mean_error.zip(row.deviation_error) {
        Some((mean, deviation)) => format!(
            "- `{}`: a mean is off by {} standard deviations, a standard deviation by {} %",
            row.case,
            number(mean),
            number(100.0 * deviation),
        ),
        None => row.failure(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A run on `target` that states `outcome` with the errors of a mean and of a standard deviation.
    fn run(case: &str, target: &str, outcome: Option<&str>, errors: Option<(f64, f64)>) -> RunRow {
        RunRow {
            case: case.to_owned(),
            target: target.to_owned(),
            outcome: outcome.map(str::to_owned),
            mean_error: errors.map(|errors| errors.0),
            deviation_error: errors.map(|errors| errors.1),
            method: "mpm".to_owned(),
            ..RunRow::default()
        }
    }

    fn rows() -> Vec<RunRow> {
        vec![
            run("a", "ring", Some("converged"), Some((0.1, 0.02))),
            run("b", "ring", Some("converged"), Some((0.01, 0.1001))),
            run("c", "ring", Some("stalled"), Some((0.01, 0.01))),
            run("d", "funnel", Some("budget exhausted"), Some((3.0, 0.5))),
            run("e", "funnel", Some("converged"), None),
            run("f", "funnel", None, Some((0.0, 0.0))),
            RunRow {
                case: "g".to_owned(),
                outcome: Some("converged".to_owned()),
                method: "svgd".to_owned(),
                ..RunRow::default()
            },
        ]
    }

    fn cases(rows: Vec<&RunRow>) -> Vec<&str> {
        rows.into_iter().map(|row| row.case.as_str()).collect()
    }

    #[test]
    fn claims_are_held_against_the_bounds() {
        let rows = rows();
        let claims = Claims::new("mpm", &rows);
        assert_eq!(cases(claims.claimed()), ["a", "b", "e"]);
        assert_eq!(cases(claims.false_claims()), ["b", "e"]);
        assert_eq!(cases(claims.unclaimed()), ["c", "f"]);
    }

    #[test]
    fn the_page_names_every_false_claim() {
        let rows = rows();
        let mut page = Page::default();
        Claims::new("mpm", &rows).write(&["ring".to_owned(), "funnel".to_owned()], &mut page);
        for line in [
            "| ring | 3 | 2 | 67 % | 0.100 | 0.100 | 1 | 1 |",
            "| funnel | 3 | 1 | 33 % | – | – | 1 | 1 |",
            "| all | 6 | 3 | 50 % | 0.100 | 0.100 | 2 | 2 |",
            "- `b`: a mean is off by 0.0100 standard deviations, a standard deviation by 10.0 %",
            "- `e`: finished: ",
            "| stalled | 1 | 0.0100 | 0.0100 | – | `c` |",
            "| budget exhausted | 1 | 3.00 | 0.500 | – | `d` |",
        ] {
            assert!(page.as_str().contains(line), "{line} is missing in {}", page.as_str());
        }
        assert!(!page.as_str().contains("`g`"));
    }

    #[test]
    fn silence_is_no_claim() {
        let rows = [run("a", "ring", None, Some((0.0, 0.0)))];
        let mut page = Page::default();
        Claims::new("mpm", &rows).write(&["ring".to_owned()], &mut page);
        assert!(page.as_str().contains("No run says anything"));
        let rows = [run("a", "ring", Some("converged"), Some((0.0, 0.0)))];
        let mut page = Page::default();
        Claims::new("mpm", &rows).write(&["ring".to_owned()], &mut page);
        assert!(page.as_str().contains("No claim is false."));
    }
}
