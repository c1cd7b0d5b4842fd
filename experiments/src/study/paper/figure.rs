//! The figures of the study `paper`.

use super::table::{BEST_RATIO, RATIO, START_RATIO, median};
use crate::plots::style::styles;
use crate::plots::{DotPlot, DotRow, DotSeries};
use crate::study::prelude::*;

/// Medians of a quantity over the abscissas, the lines by a name.
fn lines(rows: &Rows<'_>, x: Computed, name: &dyn Fn(&Row) -> String, y: Computed) -> Vec<LineSeries> {
    let line = |label: String| {
        let here = rows.having(|row| name(row) == label);
        let mut places = here.values(x);
        places.sort_by(f64::total_cmp);
        places.dedup();
        let at = |place: &f64| median(&here.having(|row| x(row) == Some(*place)), y).unwrap_or(f64::NAN);
        LineSeries {
            y: places.iter().map(at).collect(),
            x: places,
            ..LineSeries::named(label)
        }
    };
    each_once(rows.iter().map(name)).into_iter().map(line).collect()
}

/// ED² at the end over α and over E, one panel per variant and algorithm.
pub fn strength(alpha: &Rows<'_>, stiffness: &Rows<'_>) -> MultiplesPlot {
    // A constant α is stated as a number.
    let of_alpha: Computed = |row| row.text("schedule").parse().ok();
    let of_stiffness: Computed = |row| {
        let mut parts = row.text("material").split(' ');
        parts.find_map(|part| part.strip_prefix("E="))?.parse().ok()
    };
    let mut panels = Vec::new();
    for (name, rows, x) in [("α", alpha, of_alpha), ("E", stiffness, of_stiffness)] {
        for (variant, method) in each_once(rows.iter().map(|row| (row.text("variant"), row.text("method")))) {
            let here = rows.with("variant", variant).with("method", method);
            let title = format!("{name}: {}, {variant}", method.replace("algorithm ", ""));
            let lines = lines(&here, x, &|row| row.text("target").to_owned(), RATIO);
            panels.push(MultiplesPanel::new(title, lines).with_level(1.0, "independent draws"));
        }
    }
    // Where all runs diverged there is nothing to draw.
    let drawable = |panel: &MultiplesPanel| panel.series.iter().any(|line| line.y.iter().any(|y| y.is_finite()));
    panels.retain(drawable);
    MultiplesPlot::logarithmic("α or E", "ED^{2} relative to independent draws")
        .with_panels(panels)
        .with_note("By algorithm and variant; medians over the seeds. What diverged has no mark, and no panel where that is all.")
}

/// Start, best on the way and end, target by target.
pub fn transient(base: &Rows<'_>) -> DotPlot {
    let mut named: Vec<(String, Rows<'_>)> = Vec::new();
    for (setting, rows) in super::table::groups(base) {
        let setting = setting.replace("algorithm ", "");
        let of = |target: &str| (format!("{target}, {setting}"), rows.with("target", target));
        named.extend(rows.words("target").into_iter().map(of));
    }
    let (labels, rows): (Vec<String>, Vec<Rows<'_>>) = named.into_iter().unzip();
    let quantities = [("start", START_RATIO), ("best on the way", BEST_RATIO), ("end", RATIO)];
    let series = quantities.map(|(name, quantity)| {
        let value = |rows: &Rows<'_>| median(rows, quantity).unwrap_or(f64::NAN);
        (name.to_owned(), rows.iter().map(value).collect())
    });
    let note = "Medians over the seeds; no mark for what more than half of the runs did not reach.";
    ratios(labels, series.into(), note)
}

/// The end of every material, by algorithm, variant and place of the force.
pub fn materials(rows: &Rows<'_>) -> DotPlot {
    let named = |row: &Row| {
        let [method, variant, score] = ["method", "variant", "score"].map(|column| row.text(column));
        format!("{method}, {variant}, force at {score}")
    };
    let labels = rows.words("material");
    let values = |name: String| {
        let here = rows.having(|row| named(row) == name);
        let value = |material: &&str| median(&here.with("material", *material), RATIO).unwrap_or(f64::NAN);
        let values: Vec<f64> = labels.iter().map(value).collect();
        (name, values)
    };
    let mut series: Vec<_> = each_once(rows.iter().map(named)).into_iter().map(values).collect();
    // Where all runs diverged there is nothing to draw.
    series.retain(|(_, values)| values.iter().any(|value| value.is_finite()));
    let labels = labels.iter().map(|label| (*label).to_owned()).collect();
    ratios(labels, series, "Medians over targets and seeds.")
}

/// ED² over that of independent draws: a row per label, series by name.
fn ratios(labels: Vec<String>, series: Vec<(String, Vec<f64>)>, note: &str) -> DotPlot {
    let names: Vec<&str> = series.iter().map(|(name, _)| name.as_str()).collect();
    let styles = styles(&names);
    let series = series.into_iter().zip(styles);
    let bound = Some(1.0);
    DotPlot {
        x_label: "ED^{2} relative to independent draws".to_owned(),
        x_axis: AxisKind::Logarithmic,
        series: series
            .map(|((label, values), style)| DotSeries { label, style, values })
            .collect(),
        rows: labels.into_iter().map(|label| DotRow { label, bound }).collect(),
        bound_label: "independent draws".to_owned(),
        notes: vec![note.to_owned()],
        ..DotPlot::default()
    }
}

/// Time per step over M, a line per dimension, a panel per spacing.
pub fn cost(rows: &Rows<'_>) -> MultiplesPlot {
    let spacing = |row: &Row| {
        row.number("spacing")
            .map_or("default".to_owned(), |value| value.to_string())
    };
    let time: Computed = |row| Some(1e6 * row.number(SECONDS)? / row.number("steps")?);
    let panel = |title: String| {
        let here = rows.having(|row| spacing(row) == title);
        let dimension = |row: &Row| format!("d = {}", row.value("dim").cell());
        let lines = lines(&here, |row| row.number("particles"), &dimension, time);
        MultiplesPanel::new(format!("h = {title}"), lines)
    };
    let spacings = each_once(rows.iter().map(spacing));
    MultiplesPlot::logarithmic("M", "time per step (µs)").with_panels(spacings.into_iter().map(panel))
}
