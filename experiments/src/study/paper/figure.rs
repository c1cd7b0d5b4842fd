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
    let (mut labels, mut series): (Vec<String>, Vec<String>) = Default::default();
    let named = |row: &Row| format!("{}, {}, force at {}", row.method, row.variant, row.score);
    for (_, row) in findings {
        for (known, name) in [(&mut labels, row.material.clone()), (&mut series, named(row))] {
            if !known.contains(&name) {
                known.push(name);
            }
        }
    }
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
