//! The report of the study `catalogue`.

use super::claims::{Claims, worst};
use super::figure::plot;
use super::requirement::Requirement;
use super::{Catalogue, is_from, runs};
use crate::CommandError;
use crate::options::TargetSpecification;
use crate::plots::dots;
use crate::plots::page::{Cell, Header, Page, number};
use crate::study::definition::Report;
use crate::study::run_row::{ENERGY_RATIO, EVALUATIONS, Quantity, RunRow, SECONDS, SLICED_RATIO, failures, median};
use crate::study::start_law::StartLaw;

/// Tables and figure.
pub fn report(study: &Catalogue, rows: &[RunRow]) -> Result<Report, CommandError> {
    let mut page = Page::new("Defaults on every target");
    page.paragraph(format!(
        "M = {} particles, {} seeds, nothing set per target. ED² is the squared energy distance and SW₂ the sliced Wasserstein \
         distance over {} directions, both in coordinates in which the target has mean zero and unit covariance, exact or \
         against {} quasi-random points; relative to independent draws means ED² over its expectation E‖Y − Y'‖/M, and SW₂ \
         over the median of {} sets of M draws. Starts N(m, s²) are in target scales, the mean m in every coordinate.",
        study.particles,
        study.seeds.len(),
        study.directions,
        study.reference_points,
        study.draws,
    ));
    page.heading("Figure");
    let caption = "ED² relative to independent draws, by target and start, with the requirement.";
    page.figure("catalogue.svg", caption, dots(&plot(study, rows)?));

    let targets = study.all_targets()?;
    let judged = study.judged().map_or("", |method| method.label());
    let verdicts = verdicts(&targets, judged, rows)?;
    requirements(study, judged, &verdicts, &mut page);
    for start in &study.starts {
        page.heading(&format!("From N({}, {}²)", start.mean, start.standard_deviation));
        start_table(study, &targets, rows, *start, &mut page)?;
    }
    let claims = Claims::new(judged, rows);
    let labels: Vec<String> = targets.iter().map(TargetSpecification::label).collect();
    claims.write(&labels, &mut page);
    let missed: Vec<&Verdict<'_>> = verdicts.iter().filter(|verdict| !verdict.met()).collect();
    let misses: Vec<String> = missed.iter().map(|verdict| verdict.miss()).collect();
    page.list("Cases that miss their bound", &misses, Some("None."));
    let others = failures(rows.iter().filter(|row| row.method != judged));
    page.list("Runs of other methods that did not finish", &others, None);

    Ok(Report::new(page)
        .with("cases", rows.len())
        .with("judged", verdicts.len())
        .with("missed", missed.len())
        .with("claimed", claims.claimed().len())
        .with("false_claims", claims.false_claims().len()))
}

/// A run of the judged method beside what is asked of it.
struct Verdict<'a> {
    row: &'a RunRow,
    requirement: Requirement,
}

impl Verdict<'_> {
    fn met(&self) -> bool {
        ENERGY_RATIO(self.row).is_some_and(|ratio| ratio <= self.requirement.bound())
    }

    /// What is missed, as an item of a list.
    fn miss(&self) -> String {
        match ENERGY_RATIO(self.row) {
            Some(ratio) => format!(
                "- `{}`: ED² {} of independent draws, at most {}",
                self.row.case,
                number(ratio),
                self.requirement.bound()
            ),
            None => self.row.failure(),
        }
    }
}

fn verdicts<'a>(
    targets: &[TargetSpecification],
    judged: &str,
    rows: &'a [RunRow],
) -> Result<Vec<Verdict<'a>>, CommandError> {
    let mut verdicts = Vec::new();
    for target in targets {
        let (label, requirement) = (target.label(), Requirement::of(target)?);
        let here = rows.iter().filter(|row| row.target == label && row.method == judged);
        verdicts.extend(here.map(|row| Verdict { row, requirement }));
    }
    Ok(verdicts)
}

/// How many cases meet what is asked, by class and by start.
fn requirements(study: &Catalogue, judged: &str, verdicts: &[Verdict<'_>], page: &mut Page) {
    page.heading("Requirements");
    page.paragraph(format!(
        "What is asked of {judged}: ED² relative to independent draws at most the bound, in every case. A cell counts the cases \
         that meet it.",
    ));
    let mut header = vec!["targets".to_owned(), "bound".to_owned()];
    header.extend(
        study
            .starts
            .iter()
            .map(|start| format!("N({}, {}²)", start.mean, start.standard_deviation)),
    );
    header.extend(["all".to_owned(), "worst".to_owned(), "worst case".to_owned()]);
    let count = |here: &[&Verdict<'_>]| {
        let met = here.iter().filter(|verdict| verdict.met()).count();
        (!here.is_empty()).then(|| format!("{met}/{}", here.len())).cell()
    };
    let mut table = Vec::new();
    for class in Requirement::ALL {
        let here: Vec<&Verdict<'_>> = verdicts.iter().filter(|verdict| verdict.requirement == class).collect();
        let mut line = vec![class.in_words().to_owned(), number(class.bound())];
        for start in &study.starts {
            let from = here
                .iter()
                .copied()
                .filter(|verdict| is_from(verdict.row, Some(*start)));
            line.push(count(&from.collect::<Vec<_>>()));
        }
        line.push(count(&here));
        let rows: Vec<&RunRow> = here.iter().map(|verdict| verdict.row).collect();
        let worst = worst(&rows, ENERGY_RATIO);
        line.extend([
            worst.map(|(value, _)| value).cell(),
            worst.map(|(_, case)| format!("`{case}`")).cell(),
        ]);
        table.push(line);
    }
    page.table(&header, &table);
}

/// A line per target: both distances of every method, and the errors and costs of the judged one.
fn start_table(
    study: &Catalogue,
    targets: &[TargetSpecification],
    rows: &[RunRow],
    start: StartLaw,
    page: &mut Page,
) -> Result<(), CommandError> {
    let mut header = vec!["target".to_owned(), "bound".to_owned()];
    for method in &study.methods {
        header.push(format!("ED² {}", method.label()));
        header.push(format!("SW₂ {}", method.label()));
    }
    header.extend("finished | mean (sd) | sd (relative) | mode mass | residual | evaluations | time (s)".names());
    let mut table = Vec::new();
    for target in targets {
        let label = target.label();
        let mut line = vec![label.clone(), number(Requirement::of(target)?.bound())];
        for method in &study.methods {
            let here = runs(rows, &label, method.label(), Some(start));
            line.extend([ENERGY_RATIO, SLICED_RATIO].map(|quantity| median(&here, quantity).cell()));
        }
        let judged = study.judged().map_or("", |method| method.label());
        let here = runs(rows, &label, judged, Some(start));
        let finished = here.iter().filter(|row| row.finished()).count();
        line.push(format!("{finished}/{}", here.len()));
        let quantities: [Quantity; 6] = [
            |row| row.mean_error,
            |row| row.deviation_error,
            |row| row.mass_error,
            |row| row.residual,
            EVALUATIONS,
            SECONDS,
        ];
        line.extend(quantities.map(|quantity| median(&here, quantity).cell()));
        table.push(line);
    }
    page.paragraph("Medians over the seeds; ED² and SW₂ relative to independent draws.");
    page.table(&header, &table);
    Ok(())
}
