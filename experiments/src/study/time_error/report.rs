//! The report of the study `time-error`.

use super::TimeError;
use crate::plots::{TimeErrorCurve, TimeErrorPanel, time_error};
use crate::study::prelude::*;

/// SW₂.
const SLICED: &str = "sliced_wasserstein";

const SLICED_LABEL: &str = "sliced Wasserstein SW_{2}";

/// Tables and figures.
pub fn report(study: &TimeError, rows: &Rows<'_>, directory: &StudyDirectory) -> Result<Page, CommandError> {
    let mut page = directory.page(include_str!("report.md"), &[]);
    let of = |target: &TargetSpecification| (target.label(), rows.with("target", target.label()));
    let targets: Vec<(String, Rows<'_>)> = study.targets.iter().map(of).collect();
    page.heading("Figures");
    for [error_name, y_label, error] in [["energy", "ED²", ENERGY], ["sliced", SLICED_LABEL, SLICED]] {
        for [cost_name, x_label, cost] in [["time", "wall time (s)", SECONDS], ["evaluations"; 3]] {
            let panels = targets.iter().map(|target| panel(study, target, (cost, error)));
            let panels = panels.filter(|panel| !panel.curves.is_empty());
            let plot = time_error(x_label, y_label, panels);
            page.drawing(&format!("{error_name}-{cost_name}.svg"), multiples(&plot));
        }
    }
    let which = study.steps.as_ref().map_or("", |_| " at the largest number of steps");
    page.heading(&format!("Errors{which}"));
    targets.iter().for_each(|target| target_table(study, target, &mut page));
    paper_part(study, &rows.held(), &mut page);
    rows.references(&mut page);

    let page = rows.tell([Status::Finished, Status::Diverged, Status::Unsupported], page);
    Ok(rows.tell([Status::NoReference], page))
}

/// The runs of a method by their steps, from few to many; the method's own number, or draws, come first.
fn by_steps<'a>(rows: &Rows<'a>, method: &str) -> Vec<Rows<'a>> {
    let mut groups = rows.with("method", method).by("steps");
    groups.sort_by_key(|(_, runs)| runs.first().and_then(|row| row.count("steps")));
    groups.into_iter().map(|(_, runs)| runs).collect()
}

/// The error of independent draws from a target: what is expected of ED², else the median.
fn independent(here: &Rows<'_>, error: &str) -> Option<f64> {
    match error {
        ENERGY => here.first()?.number("energy_level"),
        _ => by_steps(here, "iid").first()?.median(error),
    }
}

/// One curve per method; independent draws are a level instead, and draws have no place on an axis of evaluations.
fn panel(study: &TimeError, (target, here): &(String, Rows<'_>), (cost, error): (&str, &str)) -> TimeErrorPanel {
    let has_place = |runs: &Rows<'_>| runs.median(cost).is_none_or(|cost| cost > 0.0);
    let curve = |method: &MethodSpecification| {
        let settings = by_steps(here, method.label()).into_iter().filter(has_place);
        let settings = settings.map(|runs| runs.pairs(cost, error)).collect();
        let method = method.label().to_owned();
        TimeErrorCurve { method, settings }
    };
    let methods = study.methods.iter().filter(|method| method.name != MethodName::Iid);
    TimeErrorPanel {
        target: target.clone(),
        curves: methods.map(curve).filter(TimeErrorCurve::is_drawable).collect(),
        iid_level: independent(here, error),
    }
}

fn target_table(study: &TimeError, (target, here): &(String, Rows<'_>), page: &mut Page) {
    let [energy, sliced] = [ENERGY, SLICED].map(|error| independent(here, error));
    let (level, known) = (energy.cell(), sliced.cell());
    page.part("targets", &[("target", target), ("energy", &level), ("sliced", &known)]);
    let line = |method: &MethodSpecification| {
        let runs = by_steps(here, method.label()).pop()?;
        let sliced = runs.median(SLICED).zip(sliced).map(|(value, level)| value / level);
        Some(Line::from(runs).with("sliced", sliced))
    };
    page.lines("targets", study.methods.iter().filter_map(line));
}

/// What the paper's two algorithms reach in the plane.
fn paper_part(study: &TimeError, rows: &Rows<'_>, page: &mut Page) {
    let methods = study.methods.iter().filter(|method| method.name.is_paper());
    let labels: Vec<&str> = methods.map(MethodSpecification::label).collect();
    if labels.is_empty() {
        return;
    }
    let in_the_plane = rows.with("dim", 2_usize);
    let runs = in_the_plane.having(|row| labels.contains(&row.text("method")));
    let targets = study.targets.iter().map(TargetSpecification::label);
    let settings = runs.lines_by(("target", targets), ("method", labels.iter().copied()));
    let lines = settings.iter().filter_map(|line| best_and_last(&line.rows));
    page.section("The paper's algorithms on the two-dimensional targets", &[], lines);
    page.paragraph(match &runs.failures()[..] {
        [] => "Every run finished with finite particles.".to_owned(),
        failures => format!("Runs that did not finish:\n\n{}", failures.join("\n")),
    });
}

/// The runs of a method with most steps, beside those with the best number.
fn best_and_last<'a>(runs: &Rows<'a>) -> Option<Line<'a>> {
    let steps = runs.places("steps");
    let last = runs.with("steps", *steps.last()?);
    let best = runs.best("steps", steps, |runs| runs.median(ENERGY));
    let (_, best) = best.unwrap_or_default();
    let line = Line::from(last).with("finished", runs.finished());
    let told = ["steps", "median energy_ratio", "median sliced_wasserstein"];
    Some(line.with_cells("best", &best, told))
}
