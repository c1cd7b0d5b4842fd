//! The figures of the study `paper`.

use super::body::Schedule;
use super::row::Row;
use super::table::{Finding, Quantity, groups, median};
use crate::plots::style::styles;
use crate::plots::{AxisKind, DotPlot, DotRow, DotSeries, LineSeries, MultiplesPanel, MultiplesPlot, ReferenceLevel};

/// Medians of a quantity over the abscissas, the lines by a name.
fn lines(
    findings: &[&Finding],
    x: &dyn Fn(&Finding) -> Option<f64>,
    name: &dyn Fn(&Row) -> String,
    y: Quantity,
) -> Vec<LineSeries> {
    let mut series: Vec<LineSeries> = Vec::new();
    for finding in findings {
        let label = name(finding.1);
        if series.iter().any(|line| line.label == label) {
            continue;
        }
        let here: Vec<&&Finding> = findings.iter().filter(|(_, row)| name(row) == label).collect();
        let mut places: Vec<f64> = here.iter().filter_map(|finding| x(finding)).collect();
        places.sort_by(f64::total_cmp);
        places.dedup();
        let at = |place: &f64| {
            let rows = here
                .iter()
                .filter(|finding| x(finding) == Some(*place))
                .map(|(_, row)| *row);
            median(rows, y).unwrap_or(f64::NAN)
        };
        let y = places.iter().map(at).collect();
        series.push(LineSeries {
            x: places,
            y,
            ..LineSeries::named(label)
        });
    }
    series
}

/// ED² at the end over α and over E, one panel per variant and algorithm.
pub fn strength(alpha: &[Finding], stiffness: &[Finding]) -> MultiplesPlot {
    let of_alpha = |(case, _): &Finding| match case.body.schedule {
        Schedule::Constant { alpha } => Some(alpha),
        _ => None,
    };
    let of_stiffness = |(case, _): &Finding| case.body.material.youngs_modulus();
    let mut panels = Vec::new();
    for (name, findings, x) in [
        ("α", alpha, &of_alpha as &dyn Fn(&Finding) -> Option<f64>),
        ("E", stiffness, &of_stiffness),
    ] {
        let mut titles: Vec<(String, String)> = Vec::new();
        for (_, row) in findings {
            let title = (row.variant.clone(), row.method.clone());
            if titles.contains(&title) {
                continue;
            }
            let here: Vec<&Finding> = findings
                .iter()
                .filter(|(_, row)| (&row.variant, &row.method) == (&title.0, &title.1))
                .collect();
            panels.push(MultiplesPanel {
                title: format!("{name}: {}, {}", title.1.replace("algorithm ", ""), title.0),
                series: lines(&here, x, &|row| row.target.clone(), Row::ratio),
                levels: vec![ReferenceLevel {
                    value: 1.0,
                    label: "independent draws".to_owned(),
                }],
                ..MultiplesPanel::default()
            });
            titles.push(title);
        }
    }
    // Where all runs diverged there is nothing to draw.
    let drawable = |panel: &MultiplesPanel| panel.series.iter().any(|line| line.y.iter().any(|y| y.is_finite()));
    panels.retain(drawable);
    MultiplesPlot {
        x_label: "α or E".to_owned(),
        y_label: "ED^{2} relative to independent draws".to_owned(),
        x_axis: AxisKind::Logarithmic,
        y_axis: AxisKind::Logarithmic,
        panels,
        notes: vec!["By algorithm and variant; medians over the seeds. What diverged has no mark, and no panel where that is all.".to_owned()],
        ..MultiplesPlot::default()
    }
}

/// Start, best on the way and end, target by target.
pub fn transient(base: &[Finding]) -> DotPlot {
    let mut labels: Vec<String> = Vec::new();
    let mut rows: Vec<Vec<&Row>> = Vec::new();
    for (setting, of_setting) in groups(base) {
        for row in of_setting {
            let label = format!("{}, {}", row.target, setting.replace("algorithm ", ""));
            match labels.iter().position(|known| *known == label) {
                Some(place) => rows[place].push(row),
                None => {
                    labels.push(label);
                    rows.push(vec![row]);
                }
            }
        }
    }
    let names = ["start", "best on the way", "end"];
    let quantities: [Quantity; 3] = [Row::start_ratio, Row::best_ratio, Row::ratio];
    let series = names
        .iter()
        .zip(quantities)
        .zip(styles(&names))
        .map(|((name, quantity), style)| DotSeries {
            label: (*name).to_owned(),
            style,
            values: rows
                .iter()
                .map(|rows| median(rows.iter().copied(), quantity).unwrap_or(f64::NAN))
                .collect(),
        });
    DotPlot {
        x_label: "ED^{2} relative to independent draws".to_owned(),
        x_axis: AxisKind::Logarithmic,
        series: series.collect(),
        rows: labels
            .into_iter()
            .map(|label| DotRow {
                label,
                bound: Some(1.0),
            })
            .collect(),
        bound_label: "independent draws".to_owned(),
        notes: vec!["Medians over the seeds; no mark for what more than half of the runs did not reach.".to_owned()],
        ..DotPlot::default()
    }
}

/// Time per step over M, a line per dimension, a panel per spacing.
pub fn cost(findings: &[Finding]) -> MultiplesPlot {
    let spacing = |case: &super::Case| {
        case.body
            .spacing
            .map_or("default".to_owned(), |value| value.to_string())
    };
    let mut titles: Vec<String> = Vec::new();
    let mut panels = Vec::new();
    for (case, _) in findings {
        let title = spacing(case);
        if titles.contains(&title) {
            continue;
        }
        let here: Vec<&Finding> = findings.iter().filter(|(case, _)| spacing(case) == title).collect();
        panels.push(MultiplesPanel {
            title: format!("h = {title}"),
            series: lines(
                &here,
                &|(case, _)| Some(case.particles as f64),
                &|row| format!("d = {}", row.dim),
                |row| Some(1e6 * row.wall_seconds? / row.steps as f64),
            ),
            ..MultiplesPanel::default()
        });
        titles.push(title);
    }
    MultiplesPlot {
        x_label: "M".to_owned(),
        y_label: "time per step (µs)".to_owned(),
        x_axis: AxisKind::Logarithmic,
        y_axis: AxisKind::Logarithmic,
        panels,
        ..MultiplesPlot::default()
    }
}
