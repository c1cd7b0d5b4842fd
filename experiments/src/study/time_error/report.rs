//! The report of the study `time-error`.

use super::TimeError;
use super::groups::{Setting, energy_level, independent_level, settings};
use crate::options::MethodName;
use crate::plots::page::{Cell, Page, line};
use crate::plots::{TimeErrorCurve, TimeErrorPanel, TimeErrorPlot, TimeErrorPoint, time_error};
use crate::study::attempt::Status;
use crate::study::definition::Report;
use crate::study::run_row::{ENERGY, EVALUATIONS, Quantity, RunRow, SECONDS, SLICED};

/// Tables and figures.
pub fn report(study: &TimeError, rows: &[RunRow]) -> Report {
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
    for target in targets(study) {
        target_table(study, rows, &target, &mut page);
    }
    if study.methods.iter().any(|method| is_paper(method.name)) {
        paper_part(study, rows, &mut page);
    }

    let count = |status: Status| rows.iter().filter(|row| row.status == status).count();
    Report::new(page)
        .with("finished", count(Status::Finished))
        .with("diverged", count(Status::Diverged))
        .with("unsupported", count(Status::Unsupported))
}

fn is_paper(name: MethodName) -> bool {
    matches!(name, MethodName::PaperPic | MethodName::PaperApic)
}

fn targets(study: &TimeError) -> Vec<String> {
    study.targets.iter().map(|target| target.label()).collect()
}

fn figures(study: &TimeError, rows: &[RunRow], page: &mut Page) {
    page.heading("Figures");
    let errors = [
        ("energy", "ED²", "ED²", ENERGY),
        ("sliced", "SW₂", "sliced Wasserstein SW_{2}", SLICED),
    ];
    let costs = [
        ("time", "wall time", "wall time (s)", SECONDS),
        ("evaluations", "evaluations", "evaluations", EVALUATIONS),
    ];
    for (error_file, error_name, y_label, error) in errors {
        for (cost_file, cost_name, x_label, cost) in costs {
            let panels = targets(study)
                .iter()
                .map(|target| TimeErrorPanel {
                    target: target.clone(),
                    curves: curves(study, rows, target, cost, error),
                    iid_level: if error_file == "energy" {
                        energy_level(rows, target)
                    } else {
                        independent_level(rows, target, error)
                    },
                })
                .filter(|panel: &TimeErrorPanel| !panel.curves.is_empty())
                .collect();
            let plot = TimeErrorPlot {
                x_label: x_label.to_owned(),
                y_label: y_label.to_owned(),
                iid_label: "independent draws".to_owned(),
                panels,
                ..TimeErrorPlot::default()
            };
            let caption = format!(
                "{error_name} against {cost_name}, a point per number of steps; medians over the seeds, bars from least to most."
            );
            let name = format!("{error_file}-{cost_file}.svg");
            page.figure(&name, &caption, time_error(&plot));
        }
    }
}

/// One curve per method; independent draws are a level instead, and draws have no place on an axis of evaluations.
fn curves(study: &TimeError, rows: &[RunRow], target: &str, cost: Quantity, error: Quantity) -> Vec<TimeErrorCurve> {
    let mut curves = Vec::new();
    for method in study.methods.iter().filter(|method| method.name != MethodName::Iid) {
        let points: Vec<TimeErrorPoint> = settings(rows, target, method.label())
            .iter()
            .filter(|setting| setting.median(cost).is_none_or(|cost| cost > 0.0))
            .map(|setting| TimeErrorPoint {
                cost: setting.runs.iter().map(|row| cost(row).unwrap_or(f64::NAN)).collect(),
                error: setting.runs.iter().map(|row| error(row).unwrap_or(f64::NAN)).collect(),
            })
            .collect();
        if points
            .iter()
            .any(|point| point.error.iter().any(|error| error.is_finite()))
        {
            curves.push(TimeErrorCurve {
                method: method.label().to_owned(),
                points,
            });
        }
    }
    curves
}

fn target_table(study: &TimeError, rows: &[RunRow], target: &str, page: &mut Page) {
    let level = energy_level(rows, target);
    let independent = independent_level(rows, target, SLICED);
    page.paragraph(format!(
        "**{target}**: independent draws have ED² {} and SW₂ {}.",
        level.cell(),
        independent.cell(),
    ));
    let header = "method | steps | finished | ED² | ED² / i.i.d. | SW₂ | SW₂ / i.i.d. | mean (sd) | sd (relative) | mode mass | evaluations | time (s)";
    let mut table = Vec::new();
    for method in &study.methods {
        let settings = settings(rows, target, method.label());
        let Some(setting) = settings.last() else { continue };
        let (energy, sliced) = (setting.median(ENERGY), setting.median(SLICED));
        let finished = format!("{}/{}", setting.finished(), setting.runs.len());
        let mut cells = line(&[&method.label(), &setting.steps, &finished]);
        cells.extend(line(&[
            &energy,
            &ratio(energy, level),
            &sliced,
            &ratio(sliced, independent),
        ]));
        let quantities: [Quantity; 5] = [
            |row| row.mean_error,
            |row| row.deviation_error,
            |row| row.mass_error,
            EVALUATIONS,
            SECONDS,
        ];
        cells.extend(quantities.map(|quantity| setting.median(quantity).cell()));
        table.push(cells);
    }
    page.table(header, &table);
}

fn ratio(value: Option<f64>, level: Option<f64>) -> Option<f64> {
    Some(value? / level?)
}

/// What the paper's two algorithms reach in the plane.
fn paper_part(study: &TimeError, rows: &[RunRow], page: &mut Page) {
    page.heading("The paper's algorithms on the two-dimensional targets");
    page.paragraph(
        "Finished runs had finite particles, with the guards of the method's options. The best setting is the number of steps \
         with the smallest median ED²; the last is the largest number of steps.",
    );
    let header = "target | method | finished | best steps | best ED² / i.i.d. | best SW₂ | last ED² / i.i.d. | last SW₂ | last mean (sd) | last sd (relative)";
    let mut table = Vec::new();
    let mut failures: Vec<String> = Vec::new();
    for target in targets(study) {
        if rows
            .iter()
            .find(|row| row.target == target)
            .is_none_or(|row| row.dim != 2)
        {
            continue;
        }
        for method in study.methods.iter().filter(|method| is_paper(method.name)) {
            let settings = settings(rows, &target, method.label());
            let Some(last) = settings.last() else { continue };
            table.push(paper_row(rows, &target, method.label(), &settings, last));
            let failed = settings
                .iter()
                .flat_map(|setting| &setting.runs)
                .filter(|row| !row.finished());
            failures.extend(failed.map(|row| row.failure()));
        }
    }
    page.table(header, &table);
    if failures.is_empty() {
        page.paragraph("Every run finished with finite particles.");
    } else {
        page.paragraph(format!("Runs that did not finish:\n\n{}", failures.join("\n")));
    }
}

fn paper_row(rows: &[RunRow], target: &str, method: &str, settings: &[Setting<'_>], last: &Setting<'_>) -> Vec<String> {
    let level = energy_level(rows, target);
    let over_level = |setting: &Setting<'_>| ratio(setting.median(ENERGY), level);
    let best = settings
        .iter()
        .filter_map(|setting| Some((setting, setting.median(ENERGY)?)))
        .min_by(|left, right| left.1.total_cmp(&right.1))
        .map(|(setting, _)| setting);
    let finished: usize = settings.iter().map(Setting::finished).sum();
    let all: usize = settings.iter().map(|setting| setting.runs.len()).sum();
    line(&[
        &target,
        &method,
        &format!("{finished}/{all}"),
        &best.and_then(|setting| setting.steps),
        &best.and_then(over_level),
        &best.and_then(|setting| setting.median(SLICED)),
        &over_level(last),
        &last.median(SLICED),
        &last.median(|row| row.mean_error),
        &last.median(|row| row.deviation_error),
    ])
}
