//! What runs say of themselves, beside what is measured.

use crate::study::prelude::*;

/// The claim holds where no mean is farther off than this, in standard deviations of the target, and no standard deviation by more than this part of it.
const LARGEST_ERROR: f64 = 0.1;

/// Claims beyond the bounds by more than the reference may be off; particles that could not be measured are beyond any bound.
pub fn false_claims<'a>(runs: &Rows<'a>) -> Rows<'a> {
    runs.false_claims("certain_error", LARGEST_ERROR)
}

/// How often the runs of a method claim to have converged, what that is worth, and every claim that is false.
pub fn write<'a>(runs: &Rows<'_>, targets: impl Iterator<Item = &'a str>, page: &mut Page) {
    if runs.words("outcome") == [""] || runs.is_empty() {
        page.heading("Claims");
        page.part("none", &[]);
        return;
    }
    let percent = 100.0 * LARGEST_ERROR;
    page.part("Claims", &[("mean", &LARGEST_ERROR), ("percent", &percent)]);
    let all = Line::from(runs.clone()).with("target", "all");
    let most = [each("most", [LARGEST_ERROR])];
    page.lines_over("Claims", &most, runs.lines("target", targets).into_iter().chain([all]));
    page.list_of("false claims", false_claims(runs).iter());
    // A line per outcome, with the largest errors among the runs that state it.
    page.part("outcomes", &[("none", &MISSING)]);
    let mut outcomes = runs.by("outcome");
    outcomes.sort_by(|left, right| left.0.cmp(&right.0));
    page.lines("outcomes", outcomes.into_iter().map(|(_, here)| here));
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
            .with("mean_error", errors.map(|errors| errors.0))
            .with("deviation_error", errors.map(|errors| errors.1))
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

    fn judged(rows: &[Row]) -> Rows<'_> {
        rows.iter().collect::<Rows<'_>>().with("method", "mpm")
    }

    fn cases(rows: Rows<'_>) -> Vec<String> {
        rows.iter().map(|row| row.case().to_owned()).collect()
    }

    #[test]
    fn claims_are_held_against_the_bounds() {
        let rows = rows();
        let runs = judged(&rows);
        assert_eq!(cases(runs.having(Row::claims)), ["a", "b", "e"]);
        assert_eq!(cases(false_claims(&runs)), ["b", "e"]);
    }

    #[test]
    fn the_page_names_every_false_claim() {
        let rows = rows();
        let mut page = Page::of(include_str!("report.md"), &[]);
        write(&judged(&rows), ["ring", "funnel"].into_iter(), &mut page);
        for line in [
            "| ring | 3 | 2 | 67 % | 0.100 | 0.100 | 1 | 1 |",
            "| funnel | 3 | 1 | 33 % | – | – | 1 | 1 |",
            "| all | 6 | 3 | 50 % | 0.100 | 0.100 | 2 | 2 |",
            "- `b`: a mean is off by 0.0100 standard deviations, a standard deviation by 10.0 %",
            "- `e`: finished\n",
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
        let mut page = Page::of(include_str!("report.md"), &[]);
        write(&judged(&rows), ["ring"].into_iter(), &mut page);
        assert!(page.text.contains("No run says anything"));
        let rows = [completed(&run("a", "ring", Some("converged"), Some((0.0, 0.0))))];
        let mut page = Page::of(include_str!("report.md"), &[]);
        write(&judged(&rows), ["ring"].into_iter(), &mut page);
        assert!(page.text.contains("No claim is false."));
    }
}
