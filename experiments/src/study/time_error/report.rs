//! The report of the study `time-error`.

use super::TimeError;
use crate::plots::{TimeErrorCurve, TimeErrorPanel, TimeErrorPlot, TimeErrorPoint, time_error};
use crate::study::prelude::*;

/// Tables and figures.
pub fn report(study: &TimeError, rows: &Rows<'_>) -> Report {
    let mut page = Page::new("Error against wall time and evaluations");
    page.paragraph(format!(
        "M = {} particles, {} seeds; medians over the seeds. ED² is the squared energy distance, exact against Gaussians and \
         against {} quasi-random reference points else; SW₂ is the sliced Wasserstein distance over {} directions. Regressions are measured in posterior standard deviations \
         per axis. The yardstick is the error of M independent draws: for ED² its expectation E‖Y − Y'‖/M, else the median \
         over the seeds (draws from the importance sample where a target has no exact ones). Evaluations are those of the score and of the log density at a point together.",
        study.particles,
        study.seeds.len(),
        study.reference_points,
        study.directions,
    ));
    figures(study, rows, &mut page);
    page.heading(match study.steps {
        Some(_) => "Errors at the largest number of steps",
        None => "Errors",
    });
    for target in &study.targets {
        target_table(study, rows, &target.label(), &mut page);
    }
    if study.methods.iter().any(|method| is_paper(method.name)) {
        paper_part(study, rows, &mut page);
    }

    let count = |status: Status| rows.count(|row| row.status() == status);
    Report::new(page)
        .with("finished", count(Status::Finished))
        .with("diverged", count(Status::Diverged))
        .with("unsupported", count(Status::Unsupported))
}

fn is_paper(name: MethodName) -> bool {
    matches!(name, MethodName::PaperPic | MethodName::PaperApic)
}

/// The runs of a method on a target by their steps, from few to many; `None`: the method's own, or draws.
fn by_steps<'a>(rows: &Rows<'a>, target: &str, method: &str) -> Vec<(Option<usize>, Rows<'a>)> {
    let here = rows.with("target", target).with("method", method);
    let mut steps = each_once(here.iter().map(|row| row.count("steps")));
    steps.sort_unstable();
    steps
        .into_iter()
        .map(|steps| (steps, here.with("steps", steps)))
        .collect()
}

/// The expected squared energy distance of M independent draws from a target.
fn energy_level(rows: &Rows<'_>, target: &str) -> Option<f64> {
    rows.with("target", target).first()?.number("energy_level")
}

/// The median of a quantity over the independent draws from a target.
fn independent_level(rows: &Rows<'_>, target: &str, quantity: &str) -> Option<f64> {
    by_steps(rows, target, "iid").first()?.1.median(quantity)
}

fn figures(study: &TimeError, rows: &Rows<'_>, page: &mut Page) {
    page.heading("Figures");
    let errors = [
        ("energy", "ED²", "ED²", ENERGY),
        ("sliced", "SW₂", "sliced Wasserstein SW_{2}", SLICED),
    ];
    let costs: [(&str, &str, &str, Computed); 2] = [
        ("time", "wall time", "wall time (s)", |row| row.number(SECONDS)),
        ("evaluations", "evaluations", "evaluations", EVALUATIONS),
    ];
    for (error_file, error_name, y_label, error) in errors {
        for (cost_file, cost_name, x_label, cost) in costs {
            let panel = |target: &TargetSpecification| TimeErrorPanel {
                target: target.label(),
                curves: curves(study, rows, &target.label(), cost, error),
                iid_level: match error {
                    ENERGY => energy_level(rows, &target.label()),
                    _ => independent_level(rows, &target.label(), error),
                },
            };
            let panels = study.targets.iter().map(panel).filter(|panel| !panel.curves.is_empty());
            let plot = TimeErrorPlot::new(x_label, y_label, panels);
            let caption = format!(
                "{error_name} against {cost_name}, a point per number of steps; medians over the seeds, bars from least to most."
            );
            let name = format!("{error_file}-{cost_file}.svg");
            page.figure(&name, &caption, time_error(&plot));
        }
    }
}

/// One curve per method; independent draws are a level instead, and draws have no place on an axis of evaluations.
fn curves(study: &TimeError, rows: &Rows<'_>, target: &str, cost: Computed, error: &str) -> Vec<TimeErrorCurve> {
    let point = |runs: &Rows<'_>| TimeErrorPoint {
        cost: runs.iter().map(|row| cost(row).unwrap_or(f64::NAN)).collect(),
        error: runs.iter().map(|row| row.number(error).unwrap_or(f64::NAN)).collect(),
    };
    let curve = |method: &MethodSpecification| TimeErrorCurve {
        method: method.label().to_owned(),
        points: by_steps(rows, target, method.label())
            .iter()
            .filter(|(_, runs)| runs.median(cost).is_none_or(|cost| cost > 0.0))
            .map(|(_, runs)| point(runs))
            .collect(),
    };
    let methods = study.methods.iter().filter(|method| method.name != MethodName::Iid);
    let drawable = |curve: &TimeErrorCurve| {
        curve
            .points
            .iter()
            .flat_map(|point| &point.error)
            .any(|y| y.is_finite())
    };
    methods.map(curve).filter(drawable).collect()
}

fn target_table(study: &TimeError, rows: &Rows<'_>, target: &str, page: &mut Page) {
    let level = energy_level(rows, target);
    let independent = independent_level(rows, target, SLICED);
    page.paragraph(format!(
        "**{target}**: independent draws have ED² {} and SW₂ {}.",
        level.cell(),
        independent.cell(),
    ));
    let header = "method | steps | finished | ED² | ED² / i.i.d. | SW₂ | SW₂ / i.i.d. | mean (sd) | sd (relative) | mode mass | evaluations | time (s)";
    let cells = |method: &MethodSpecification| {
        let (steps, runs) = by_steps(rows, target, method.label()).pop()?;
        let (energy, sliced) = (runs.median(ENERGY), runs.median(SLICED));
        let mut cells = line(&[&method.label(), &steps, &runs.finished()]);
        cells.extend(line(&[
            &energy,
            &ratio(energy, level),
            &sliced,
            &ratio(sliced, independent),
        ]));
        cells.extend(runs.medians(&[&"mean_error", &"deviation_error", &"mass_error", &EVALUATIONS, &SECONDS]));
        Some(cells)
    };
    page.table(header, study.methods.iter().filter_map(cells));
}

fn ratio(value: Option<f64>, level: Option<f64>) -> Option<f64> {
    Some(value? / level?)
}

/// What the paper's two algorithms reach in the plane.
fn paper_part(study: &TimeError, rows: &Rows<'_>, page: &mut Page) {
    page.heading("The paper's algorithms on the two-dimensional targets");
    page.paragraph(
        "Finished runs had finite particles, with the guards of the method's options. The best setting is the number of steps \
         with the smallest median ED²; the last is the largest number of steps.",
    );
    let header = "target | method | finished | best steps | best ED² / i.i.d. | best SW₂ | last ED² / i.i.d. | last SW₂ | last mean (sd) | last sd (relative)";
    let mut table = Vec::new();
    let mut failures: Vec<String> = Vec::new();
    let planar = |target: &String| {
        rows.with("target", target.as_str())
            .first()
            .is_some_and(|row| row.is("dim", 2_usize))
    };
    for target in study.targets.iter().map(TargetSpecification::label).filter(planar) {
        for method in study.methods.iter().filter(|method| is_paper(method.name)) {
            table.extend(paper_row(rows, &target, method.label()));
            let runs = by_steps(rows, &target, method.label());
            failures.extend(runs.iter().flat_map(|(_, runs)| runs.failures()));
        }
    }
    page.table(header, &table);
    if failures.is_empty() {
        page.paragraph("Every run finished with finite particles.");
    } else {
        page.paragraph(format!("Runs that did not finish:\n\n{}", failures.join("\n")));
    }
}

fn paper_row(rows: &Rows<'_>, target: &str, method: &str) -> Option<Vec<String>> {
    let level = energy_level(rows, target);
    let settings = by_steps(rows, target, method);
    let (_, last) = settings.last()?;
    let errors = settings
        .iter()
        .filter_map(|(steps, runs)| Some((runs.median(ENERGY)?, *steps, runs)));
    let best = errors.min_by(|left, right| left.0.total_cmp(&right.0));
    let mut cells = line(&[
        &target,
        &method,
        &rows.with("target", target).with("method", method).finished(),
        &best.as_ref().and_then(|(_, steps, _)| *steps),
        &ratio(best.as_ref().map(|(energy, ..)| *energy), level),
        &best.as_ref().and_then(|(.., runs)| runs.median(SLICED)),
        &ratio(last.median(ENERGY), level),
    ]);
    cells.extend(last.medians(&[&SLICED, &"mean_error", &"deviation_error"]));
    Some(cells)
}
