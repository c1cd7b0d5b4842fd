//! The figures of the study `paper`.

use super::table::{RATIO, groups};
use crate::plots::DotPlot;
use crate::study::prelude::*;

/// Where all runs diverged there is nothing to draw.
fn is_drawable(values: &[f64]) -> bool {
    values.iter().any(|value| value.is_finite())
}

/// The median of a column; no number without rows.
fn median(rows: &Rows<'_>, column: &str) -> f64 {
    rows.median_of_all(column).unwrap_or(f64::NAN)
}

/// What says that a run is by one of the paper's algorithms, shorter.
fn short(text: &str) -> String {
    text.replace("algorithm ", "Alg. ")
}

/// ED² at the end over α and over E, one panel per variant and algorithm.
pub fn strength(alpha: &Rows<'_>, stiffness: &Rows<'_>) -> MultiplesPlot {
    let mut panels = Vec::new();
    for (name, rows, x) in [("α", alpha, "alpha"), ("E", stiffness, "youngs_modulus")] {
        let setting = |row: &Row| {
            let method = short(row.text("method"));
            format!("{name}: {method}, {}", row.text("variant"))
        };
        for (title, here) in rows.by_name(setting) {
            let panel = MultiplesPanel::new(title, here.medians_by(("", "target"), x, RATIO));
            panels.push(panel.with_level(1.0, "independent draws"));
        }
    }
    panels.retain(|panel| panel.series.iter().any(|line| is_drawable(&line.y)));
    MultiplesPlot::logarithmic("α or E", "ED^{2} relative to independent draws")
        .with_panels(panels)
        .with_note("By algorithm and variant; medians over the seeds. What diverged has no mark, and no panel where that is all.")
}

/// Start, best on the way and end, target by target.
pub fn transient<'a>(base: &Rows<'a>) -> DotPlot {
    let by_target = |(setting, rows): (String, Rows<'a>)| {
        let label = move |target: &str| format!("{target}, {}", short(&setting));
        rows.by("target")
            .into_iter()
            .map(move |(target, rows)| (label(&target), rows))
    };
    let (labels, rows): (Vec<String>, Vec<Rows<'a>>) = groups(base).into_iter().flat_map(by_target).unzip();
    let quantities = [
        ("start", "start_ratio"),
        ("best on the way", "best_ratio"),
        ("end", RATIO),
    ];
    let series = quantities.map(|(name, column)| {
        let values = rows.iter().map(|rows| median(rows, column));
        (name.to_owned(), values.collect())
    });
    let note = "Medians over the seeds; no mark for what more than half of the runs did not reach.";
    ratios(labels, series.into()).with_note(note)
}

/// The end of every material, by algorithm, variant and place of the force.
pub fn materials(rows: &Rows<'_>) -> DotPlot {
    let labels = rows.words("material");
    let values = |(name, here): (String, Rows<'_>)| {
        let value = |material: &String| median(&here.with("material", material.as_str()), RATIO);
        (name, labels.iter().map(value).collect())
    };
    let named = rows.by_name(|row| {
        let [method, variant, score] = ["method", "variant", "score"].map(|column| row.text(column));
        format!("{method}, {variant}, force at {score}")
    });
    let mut series: Vec<(String, Vec<f64>)> = named.into_iter().map(values).collect();
    series.retain(|(_, values)| is_drawable(values));
    ratios(labels, series).with_note("Medians over targets and seeds.")
}

/// ED² over that of independent draws: a row per label, series by name.
fn ratios(labels: Vec<String>, series: Vec<(String, Vec<f64>)>) -> DotPlot {
    let rows = labels.into_iter().map(|label| (label, 1.0));
    DotPlot::bounded("ED^{2} relative to independent draws", rows, "independent draws").with_series(series)
}

/// Time per step over M, a line per dimension, a panel per spacing.
pub fn cost(rows: &Rows<'_>) -> MultiplesPlot {
    let spacing = |row: &Row| format!("h = {}", super::body::part(row, "spacing"));
    let panel = |(title, here): (String, Rows<'_>)| {
        MultiplesPanel::new(
            title,
            here.medians_by(("d = ", "dim"), "particles", "step_microseconds"),
        )
    };
    MultiplesPlot::logarithmic("M", "time per step (µs)").with_panels(rows.by_name(spacing).into_iter().map(panel))
}
