//! What runs say of themselves, beside what is measured.

use crate::study::prelude::*;

/// The claim holds where no mean is farther off than this, in standard deviations of the target …
const LARGEST_MEAN_ERROR: f64 = 0.1;
/// … and no standard deviation by more than this part of it.
const LARGEST_DEVIATION_ERROR: f64 = 0.1;
/// The column of the one …
const MEAN: &str = "mean_error";
/// … and of the other.
const DEVIATION: &str = "deviation_error";

/// The runs of a method, by what they claim and what is measured.
pub struct Claims<'a> {
    /// All of them.
    pub runs: Rows<'a>,
}

impl<'a> Claims<'a> {
    /// Of the runs of one method.
    pub fn new(runs: Rows<'a>) -> Self {
        Self { runs }
    }

    /// Runs that claim to have converged.
    pub fn claimed(&self) -> Rows<'a> {
        self.runs.having(Row::claims)
    }

    /// Claims beyond the bounds; particles that could not be measured are beyond any bound.
    pub fn false_claims(&self) -> Rows<'a> {
        self.runs.having(|row| row.claims() && !is_within(row))
    }

    /// Runs within the bounds that do not claim it.
    pub fn unclaimed(&self) -> Rows<'a> {
        self.runs.having(|row| !row.claims() && is_within(row))
    }

    /// How often the claim is made, what it is worth, and every claim that is false.
    pub fn write(&self, targets: &[String], page: &mut Page) {
        page.heading("Claims");
        if self.runs.words("outcome") == [""] || self.runs.is_empty() {
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
        let on = |target: &String| Self::new(self.runs.with("target", target.as_str())).line(target);
        let lines = targets.iter().map(on);
        page.table(header, lines.chain([self.line("all")]));
        let false_claims: Vec<String> = self.false_claims().iter().map(false_claim).collect();
        page.paragraph(match false_claims.is_empty() {
            true => "No claim is false.".to_owned(),
            false => format!("Claims that are false:\n\n{}", false_claims.join("\n")),
        });
        self.write_outcomes(page);
    }

    fn line(&self, name: &str) -> Vec<String> {
        let (all, claimed) = (self.runs.len(), self.claimed());
        let counts = line(&[&name, &all, &claimed.len(), &percent(claimed.len(), all)]);
        let errors = claimed.cells("largest mean_error | largest deviation_error");
        let others = line(&[&self.false_claims().len(), &self.unclaimed().len()]);
        [counts, errors, others].concat()
    }

    /// A line per outcome, with the largest errors among the runs that state it.
    fn write_outcomes(&self, page: &mut Page) {
        page.paragraph(format!(
            "All outcomes that are stated ({MISSING}: none), with the largest errors beside them:"
        ));
        let mut outcomes = self.runs.by("outcome");
        outcomes.sort_by(|left, right| left.0.cmp(&right.0));
        let statistics = "first outcome | rows | largest mean_error | largest deviation_error | largest mass_error | worst larger_error";
        let header = "outcome | runs | worst mean (sd) | worst sd (relative) | worst mode mass | worst case";
        page.table(header, outcomes.iter().map(|(_, here)| here.cells(statistics)));
    }
}

fn is_within(row: &Row) -> bool {
    row.is_within(MEAN, LARGEST_MEAN_ERROR) && row.is_within(DEVIATION, LARGEST_DEVIATION_ERROR)
}

fn false_claim(row: &Row) -> String {
    match row.number(MEAN).zip(row.number(DEVIATION)) {
        Some((mean, deviation)) => format!(
            "- `{}`: a mean is off by {} standard deviations, a standard deviation by {} %",
            row.case(),
            number(mean),
            number(100.0 * deviation),
        ),
        None => row.failure(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::derived::completed;

    /// A run on `target` that states `outcome` with the errors of a mean and of a standard deviation.
    fn run(case: &str, target: &str, outcome: Option<&str>, errors: Option<(f64, f64)>) -> Row {
        Row::of(case)
            .with("target", target)
            .with("outcome", outcome)
            .with(MEAN, errors.map(|errors| errors.0))
            .with(DEVIATION, errors.map(|errors| errors.1))
            .with("method", "mpm")
    }

    fn rows() -> Vec<Row> {
        let rows = [
            run("a", "ring", Some("converged"), Some((0.1, 0.02))),
            run("b", "ring", Some("converged"), Some((0.01, 0.1001))),
            run("c", "ring", Some("stalled"), Some((0.01, 0.01))),
            run("d", "funnel", Some("budget exhausted"), Some((3.0, 0.5))),
            run("e", "funnel", Some("converged"), None),
            run("f", "funnel", None, Some((0.0, 0.0))),
            Row::of("g").with("outcome", "converged").with("method", "svgd"),
        ];
        rows.iter().map(completed).collect()
    }

    fn claims(rows: &[Row]) -> Claims<'_> {
        Claims::new(rows.iter().collect::<Rows<'_>>().with("method", "mpm"))
    }

    fn cases(rows: Rows<'_>) -> Vec<String> {
        rows.iter().map(|row| row.case().to_owned()).collect()
    }

    #[test]
    fn claims_are_held_against_the_bounds() {
        let rows = rows();
        let claims = claims(&rows);
        assert_eq!(cases(claims.claimed()), ["a", "b", "e"]);
        assert_eq!(cases(claims.false_claims()), ["b", "e"]);
        assert_eq!(cases(claims.unclaimed()), ["c", "f"]);
    }

    #[test]
    fn the_page_names_every_false_claim() {
        let rows = rows();
        let mut page = Page::default();
        claims(&rows).write(&["ring".to_owned(), "funnel".to_owned()], &mut page);
        for line in [
            "| ring | 3 | 2 | 67 % | 0.100 | 0.100 | 1 | 1 |",
            "| funnel | 3 | 1 | 33 % | – | – | 1 | 1 |",
            "| all | 6 | 3 | 50 % | 0.100 | 0.100 | 2 | 2 |",
            "- `b`: a mean is off by 0.0100 standard deviations, a standard deviation by 10.0 %",
            "- `e`: finished: ",
            "| stalled | 1 | 0.0100 | 0.0100 | – | `c` |",
            "| budget exhausted | 1 | 3.00 | 0.500 | – | `d` |",
        ] {
            assert!(page.text.contains(line), "{line} is missing in {}", page.text);
        }
        assert!(!page.text.contains("`g`"));
    }

    #[test]
    fn silence_is_no_claim() {
        let rows = [run("a", "ring", None, Some((0.0, 0.0)))];
        let mut page = Page::default();
        claims(&rows).write(&["ring".to_owned()], &mut page);
        assert!(page.text.contains("No run says anything"));
        let rows = [run("a", "ring", Some("converged"), Some((0.0, 0.0)))];
        let mut page = Page::default();
        claims(&rows).write(&["ring".to_owned()], &mut page);
        assert!(page.text.contains("No claim is false."));
    }
}
