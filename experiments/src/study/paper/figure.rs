//! The figures of the study `paper`.

use super::body::Schedule;
use super::row::Row;
use super::table::{Finding, Quantity, groups, median};
use crate::plots::style::styles;
use crate::plots::{AxisKind, DotPlot, DotRow, DotSeries, LineSeries, MultiplesPanel, MultiplesPlot, ReferenceLevel};
use crate::study::each_once::each_once;

/// Medians of a quantity over the abscissas, the lines by a name.
fn lines(
    findings: &[&Finding],
    x: &dyn Fn(&Finding) -> Option<f64>,
    name: &dyn Fn(&Row) -> String,
    y: Quantity,
) -> Vec<LineSeries> {
    let line = |label: String| {
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
        LineSeries {
            x: places,
            y,
            ..LineSeries::named(label)
        }
    };
    let labels = each_once(findings.iter().map(|finding| name(finding.1)));
    labels.into_iter().map(line).collect()
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
        for (variant, method) in each_once(findings.iter().map(|(_, row)| (&row.variant, &row.method))) {
            let here = |(_, row): &&Finding| (&row.variant, &row.method) == (variant, method);
            let here: Vec<&Finding> = findings.iter().filter(here).collect();
            panels.push(MultiplesPanel {
                title: format!("{name}: {}, {variant}", method.replace("algorithm ", "")),
                series: lines(&here, x, &|row| row.target.clone(), Row::ratio),
                levels: vec![ReferenceLevel::new(1.0, "independent draws")],
                ..MultiplesPanel::default()
            });
        }
    }
    // Where all runs diverged there is nothing to draw.
    let drawable = |panel: &MultiplesPanel| panel.series.iter().any(|line| line.y.iter().any(|y| y.is_finite()));
    panels.retain(drawable);
    MultiplesPlot {
        panels,
        notes: vec!["By algorithm and variant; medians over the seeds. What diverged has no mark, and no panel where that is all.".to_owned()],
        ..MultiplesPlot::logarithmic("α or E", "ED^{2} relative to independent draws")
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
    let quantities: [(&str, Quantity); 3] = [
        ("start", Row::start_ratio),
        ("best on the way", Row::best_ratio),
        ("end", Row::ratio),
    ];
    let value = |rows: &Vec<&Row>, quantity| median(rows.iter().copied(), quantity).unwrap_or(f64::NAN);
    let series =
        quantities.map(|(name, quantity)| (name.to_owned(), rows.iter().map(|rows| value(rows, quantity)).collect()));
    ratios(
        labels,
        series.into(),
        "Medians over the seeds; no mark for what more than half of the runs did not reach.",
    )
}

/// The end of every material, by algorithm, variant and place of the force.
pub fn materials(findings: &[Finding]) -> DotPlot {
    let named = |row: &Row| format!("{}, {}, force at {}", row.method, row.variant, row.score);
    let labels = each_once(findings.iter().map(|(_, row)| row.material.clone()));
    let series = each_once(findings.iter().map(|(_, row)| named(row)));
    let value = |name: &String, material: &String| {
        let here = findings
            .iter()
            .filter(|(_, row)| named(row) == *name && row.material == *material);
        median(here.map(|(_, row)| *row), Row::ratio).unwrap_or(f64::NAN)
    };
    let values = |name: String| {
        let values: Vec<f64> = labels.iter().map(|material| value(&name, material)).collect();
        (name, values)
    };
    let mut series: Vec<_> = series.into_iter().map(values).collect();
    // Where all runs diverged there is nothing to draw.
    series.retain(|(_, values)| values.iter().any(|value| value.is_finite()));
    ratios(labels, series, "Medians over targets and seeds.")
}

/// ED² over that of independent draws: a row per label, series by name.
fn ratios(labels: Vec<String>, series: Vec<(String, Vec<f64>)>, note: &str) -> DotPlot {
    let names: Vec<&str> = series.iter().map(|(name, _)| name.as_str()).collect();
    let styles = styles(&names);
    let series = series
        .into_iter()
        .zip(styles)
        .map(|((label, values), style)| DotSeries { label, style, values });
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
        notes: vec![note.to_owned()],
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
    let panel = |title: String| {
        let here: Vec<&Finding> = findings.iter().filter(|(case, _)| spacing(case) == title).collect();
        MultiplesPanel {
            title: format!("h = {title}"),
            series: lines(
                &here,
                &|(case, _)| Some(case.particles as f64),
                &|row| format!("d = {}", row.dim),
                |row| Some(1e6 * row.wall_seconds? / row.steps as f64),
            ),
            ..MultiplesPanel::default()
        }
    };
    let spacings = each_once(findings.iter().map(|(case, _)| spacing(case)));
    MultiplesPlot {
        panels: spacings.into_iter().map(panel).collect(),
        ..MultiplesPlot::logarithmic("M", "time per step (µs)")
    }
}
