//! The report of the study `time-error`.

use super::TimeError;
use crate::plots::{TimeErrorCurve, TimeErrorPanel, time_error};
use crate::study::prelude::*;

/// Tables and figures.
pub fn report(study: &TimeError, rows: &Rows<'_>, directory: &StudyDirectory) -> Result<Page, CommandError> {
    let mut page = directory.page(include_str!("report.md"), &[]);
    figures(study, rows, &mut page);
    page.heading(match study.steps {
        Some(_) => "Errors at the largest number of steps",
        None => "Errors",
    });
    for target in &study.targets {
        target_table(study, rows, &target.label(), &mut page);
    }
    if study.methods.iter().any(|method| method.name.is_paper()) {
        paper_part(study, rows, &mut page);
    }

    Ok(rows.tell([Status::Finished, Status::Diverged, Status::Unsupported], page))
}

/// The runs of a method by their steps, from few to many; the method's own number, or draws, come first.
fn by_steps<'a>(rows: &Rows<'a>, method: &str) -> Vec<Rows<'a>> {
    let groups = rows.with("method", method).by("steps").into_iter();
    let mut groups: Vec<Rows<'_>> = groups.map(|(_, runs)| runs).collect();
    groups.sort_by_key(|runs| runs.first().and_then(|row| row.count("steps")));
    groups
}

/// The median of the sliced distance over the independent draws from a target.
fn independent_level(here: &Rows<'_>) -> Option<f64> {
    by_steps(here, "iid").first()?.median(SLICED)
}

/// SW₂.
const SLICED: &str = "sliced_wasserstein";

fn figures(study: &TimeError, rows: &Rows<'_>, page: &mut Page) {
    page.heading("Figures");
    let errors = [
        ("energy", "ED²", ENERGY),
        ("sliced", "sliced Wasserstein SW_{2}", SLICED),
    ];
    let costs = [
        ("time", "wall time (s)", SECONDS),
        ("evaluations", "evaluations", "evaluations"),
    ];
    for (error_file, y_label, error) in errors {
        for (cost_file, x_label, cost) in costs {
            let panel = |target: &TargetSpecification| {
                let here = rows.with("target", target.label());
                TimeErrorPanel {
                    target: target.label(),
                    curves: curves(study, &here, cost, error),
                    iid_level: match error {
                        ENERGY => here.first().and_then(|row| row.number("energy_level")),
                        _ => independent_level(&here),
                    },
                }
            };
            let panels = study.targets.iter().map(panel).filter(|panel| !panel.curves.is_empty());
            let plot = time_error(x_label, y_label, panels);
            page.drawing(&format!("{error_file}-{cost_file}.svg"), multiples(&plot));
        }
    }
}

/// One curve per method; independent draws are a level instead, and draws have no place on an axis of evaluations.
fn curves(study: &TimeError, here: &Rows<'_>, cost: &str, error: &str) -> Vec<TimeErrorCurve> {
    let has_place = |runs: &Rows<'_>| runs.median(cost).is_none_or(|cost| cost > 0.0);
    let curve = |method: &MethodSpecification| {
        let settings = by_steps(here, method.label()).into_iter().filter(has_place);
        TimeErrorCurve {
            method: method.label().to_owned(),
            settings: settings.map(|runs| runs.pairs(cost, error)).collect(),
        }
    };
    let methods = study.methods.iter().filter(|method| method.name != MethodName::Iid);
    methods.map(curve).filter(TimeErrorCurve::is_drawable).collect()
}

fn target_table(study: &TimeError, rows: &Rows<'_>, target: &str, page: &mut Page) {
    let here = rows.with("target", target);
    let independent = independent_level(&here);
    let (level, sliced) = (here.cell("energy_level"), independent.cell());
    let known = format!("ED² {level} and SW₂ {sliced}");
    page.paragraph(format!("**{target}**: independent draws have {known}."));
    let line = |method: &MethodSpecification| {
        let runs = by_steps(&here, method.label()).pop()?;
        let sliced = runs.median(SLICED).zip(independent).map(|(value, level)| value / level);
        Some(Line::from(runs).with("sliced", sliced))
    };
    page.lines("targets", study.methods.iter().filter_map(line));
}

/// What the paper's two algorithms reach in the plane.
fn paper_part(study: &TimeError, rows: &Rows<'_>, page: &mut Page) {
    page.part("The paper's algorithms on the two-dimensional targets", &[]);
    let mut lines = Vec::new();
    let mut failures: Vec<String> = Vec::new();
    for target in study.targets.iter().map(TargetSpecification::label) {
        let here = rows.with("target", target.as_str()).with("dim", 2_usize);
        for method in study.methods.iter().filter(|method| method.name.is_paper()) {
            let settings = by_steps(&here, method.label());
            failures.extend(settings.iter().flat_map(RunRows::failures));
            lines.extend(best_and_last(&settings));
        }
    }
    page.lines("The paper's algorithms on the two-dimensional targets", lines);
    page.paragraph(match &failures[..] {
        [] => "Every run finished with finite particles.".to_owned(),
        failures => format!("Runs that did not finish:\n\n{}", failures.join("\n")),
    });
}

/// The last of the settings of a method, by their steps, beside the best one.
fn best_and_last<'a>(settings: &[Rows<'a>]) -> Option<Line<'a>> {
    let last = settings.last()?;
    let all: Rows<'_> = settings.iter().flat_map(Rows::iter).collect();
    let errors = settings.iter().filter_map(|runs| Some((runs.median(ENERGY)?, runs)));
    let best = errors.min_by(|left, right| left.0.total_cmp(&right.0));
    let best = best.map(|(_, runs)| runs.clone()).unwrap_or_default();
    let line = Line::from(last.clone()).with("finished", all.finished());
    let line = line.with("best steps", best.cell("steps"));
    let line = line.with("best energy", best.cell("median energy_ratio"));
    Some(line.with("best sliced", best.cell("median sliced_wasserstein")))
}
