//! The report of the study `time-error`.

use super::groups::{Setting, energy_level, independent_level, settings};
use super::{Row, TimeError};
use crate::CommandError;
use crate::options::MethodName;
use crate::plots::{Spread, TimeErrorCurve, TimeErrorPanel, TimeErrorPlot, TimeErrorPoint, time_error};
use crate::study::attempt::Status;
use crate::study::definition::Report;
use crate::study::directory::StudyDirectory;
use crate::study::document::{Document, MISSING, optional_number};

/// A quantity of a row, where the run has it.
type Quantity = fn(&Row) -> Option<f64>;
const ENERGY: Quantity = |row| row.energy_distance_squared;
const SLICED: Quantity = |row| row.sliced_wasserstein;
const SECONDS: Quantity = |row| row.wall_seconds;
const EVALUATIONS: Quantity = Row::evaluations;

/// Tables and figures.
pub fn report(study: &TimeError, rows: &[Row], directory: &StudyDirectory) -> Result<Report, CommandError> {
    let mut document = Document::new("Error against wall time and evaluations");
    document.paragraph(format!(
        "M = {} particles, {} seeds; medians over the seeds. ED² is the squared energy distance, exact against Gaussians and \
         against {} quasi-random reference points else; SW₂ is the sliced Wasserstein distance over {} directions. Regressions are measured in posterior standard deviations \
         per axis. The yardstick is the error of M independent draws: for ED² its expectation E‖Y − Y'‖/M, else the median \
         over the seeds (draws from the importance sample where a target has no exact ones). Evaluations are those of the score and of the log density at a point together.",
        study.particles,
        study.seeds.len(),
        study.reference_points,
        study.directions,
    ));
    figures(study, rows, directory, &mut document)?;
    document.heading(match study.steps {
        Some(_) => "Errors at the largest number of steps",
        None => "Errors",
    });
    for target in targets(study) {
        target_table(study, rows, &target, &mut document);
    }
    if study.methods.iter().any(|method| is_paper(method.name)) {
        paper_part(study, rows, &mut document);
    }

    let count = |status: Status| rows.iter().filter(|row| row.status == status).count().to_string();
    let summary = vec![
        ("study", "time-error".to_owned()),
        ("finished", count(Status::Finished)),
        ("diverged", count(Status::Diverged)),
        ("unsupported", count(Status::Unsupported)),
    ];
    Ok(Report { document, summary })
}

fn is_paper(name: MethodName) -> bool {
    matches!(name, MethodName::PaperPic | MethodName::PaperApic)
}

fn targets(study: &TimeError) -> Vec<String> {
    study.targets.iter().map(|target| target.label()).collect()
}

fn figures(
    study: &TimeError,
    rows: &[Row],
    directory: &StudyDirectory,
    document: &mut Document,
) -> Result<(), CommandError> {
    document.heading("Figures");
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
                title: String::new(),
                x_label: x_label.to_owned(),
                y_label: y_label.to_owned(),
                iid_label: "independent draws".to_owned(),
                spread: Spread::Extremes,
                panels,
            };
            let caption = format!(
                "{error_name} against {cost_name}, a point per number of steps; medians over the seeds, bars from least to most."
            );
            document.figure(
                directory,
                &format!("{error_file}-{cost_file}.svg"),
                &caption,
                time_error(&plot),
            )?;
        }
    }
    Ok(())
}

/// One curve per method; independent draws are a level instead, and draws have no place on an axis of evaluations.
fn curves(study: &TimeError, rows: &[Row], target: &str, cost: Quantity, error: Quantity) -> Vec<TimeErrorCurve> {
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

fn target_table(study: &TimeError, rows: &[Row], target: &str, document: &mut Document) {
    let level = energy_level(rows, target);
    let independent = independent_level(rows, target, SLICED);
    document.paragraph(format!(
        "**{target}**: independent draws have ED² {} and SW₂ {}.",
        optional_number(level),
        optional_number(independent),
    ));
    let header = [
        "method",
        "steps",
        "finished",
        "ED²",
        "ED² / i.i.d.",
        "SW₂",
        "SW₂ / i.i.d.",
        "mean (sd)",
        "sd (relative)",
        "mode mass",
        "evaluations",
        "time (s)",
    ];
    let mut table = Vec::new();
    for method in &study.methods {
        let settings = settings(rows, target, method.label());
        let Some(setting) = settings.last() else { continue };
        let (energy, sliced) = (setting.median(ENERGY), setting.median(SLICED));
        let ratio = |value: Option<f64>, level: Option<f64>| value.zip(level).map(|(value, level)| value / level);
        table.push(vec![
            method.label().to_owned(),
            setting.steps.map_or(MISSING.to_owned(), |steps| steps.to_string()),
            format!("{}/{}", setting.finished(), setting.runs.len()),
            optional_number(energy),
            optional_number(ratio(energy, level)),
            optional_number(sliced),
            optional_number(ratio(sliced, independent)),
            optional_number(setting.median(|row| row.mean_error)),
            optional_number(setting.median(|row| row.deviation_error)),
            optional_number(setting.median(|row| row.mass_error)),
            optional_number(setting.median(EVALUATIONS)),
            optional_number(setting.median(SECONDS)),
        ]);
    }
    document.table(&header, &table);
}

/// What the paper's two algorithms reach in the plane.
fn paper_part(study: &TimeError, rows: &[Row], document: &mut Document) {
    document.heading("The paper's algorithms on the two-dimensional targets");
    document.paragraph(
        "Finished runs had finite particles, with the guards of the method's options. The best setting is the number of steps \
         with the smallest median ED²; the last is the largest number of steps.",
    );
    let header = [
        "target",
        "method",
        "finished",
        "best steps",
        "best ED² / i.i.d.",
        "best SW₂",
        "last ED² / i.i.d.",
        "last SW₂",
        "last mean (sd)",
        "last sd (relative)",
    ];
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
            for row in settings
                .iter()
                .flat_map(|setting| &setting.runs)
                .filter(|row| row.status != Status::Finished)
            {
                failures.push(format!("- `{}`: {}: {}", row.case, row.status.as_str(), row.note));
            }
        }
    }
    document.table(&header, &table);
    if failures.is_empty() {
        document.paragraph("Every run finished with finite particles.");
    } else {
        document.paragraph(format!("Runs that did not finish:\n\n{}", failures.join("\n")));
    }
}

fn paper_row(rows: &[Row], target: &str, method: &str, settings: &[Setting<'_>], last: &Setting<'_>) -> Vec<String> {
    let level = energy_level(rows, target);
    let ratio = |setting: &Setting<'_>| setting.median(ENERGY).zip(level).map(|(value, level)| value / level);
    let best = settings
        .iter()
        .filter_map(|setting| Some((setting, setting.median(ENERGY)?)))
        .min_by(|left, right| left.1.total_cmp(&right.1))
        .map(|(setting, _)| setting);
    let finished: usize = settings.iter().map(Setting::finished).sum();
    let all: usize = settings.iter().map(|setting| setting.runs.len()).sum();
    let steps = best.and_then(|setting| setting.steps);
    vec![
        target.to_owned(),
        method.to_owned(),
        format!("{finished}/{all}"),
        steps.map_or(MISSING.to_owned(), |steps| steps.to_string()),
        optional_number(best.and_then(ratio)),
        optional_number(best.and_then(|setting| setting.median(SLICED))),
        optional_number(ratio(last)),
        optional_number(last.median(SLICED)),
        optional_number(last.median(|row| row.mean_error)),
        optional_number(last.median(|row| row.deviation_error)),
    ]
}
