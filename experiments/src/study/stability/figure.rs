//! The figure of the study `stability`: where the paper's algorithms diverge.

use super::diverged;
use super::draw::{SPACINGS, TIME_STEPS};
use crate::plots::{HeatMapPlot, HeatPanel, cell_of, logarithmic_edges};
use crate::study::prelude::*;

/// Cells along each axis.
pub const CELLS: usize = 6;

/// The shares of diverged runs of Algorithms 1 and 2 over time step and spacing, without guards and with them.
pub fn plot(rows: &Rows<'_>) -> HeatMapPlot {
    let panels = [
        ("Algorithm 1 (PIC), guards off", MethodName::PaperPic, "off"),
        ("Algorithm 1 (PIC), guards on", MethodName::PaperPic, "on"),
        ("Algorithm 2 (APIC), guards off", MethodName::PaperApic, "off"),
        ("Algorithm 2 (APIC), guards on", MethodName::PaperApic, "on"),
    ];
    let (x_edges, y_edges) = (logarithmic_edges(TIME_STEPS, CELLS), logarithmic_edges(SPACINGS, CELLS));
    let place = |row: &Row| {
        let column = cell_of(&x_edges, row.number("time_step_factor")?)?;
        Some((column, cell_of(&y_edges, row.number("spacing_factor")?)?))
    };
    let panel = |(title, method, guards): (&str, MethodName, &str)| {
        let here = rows.with("method", method.as_str()).with("guards", guards);
        let share = |index: usize| {
            let inside = here.having(|row| place(row) == Some((index % CELLS, index / CELLS)));
            (!inside.is_empty()).then(|| inside.count(diverged) as f64 / inside.len() as f64)
        };
        HeatPanel {
            title: title.to_owned(),
            shares: (0..CELLS * CELLS).map(share).collect(),
        }
    };
    HeatMapPlot {
        x_label: "time step / default".to_owned(),
        y_label: "spacing / default".to_owned(),
        axis: AxisKind::Logarithmic,
        panels: panels.into_iter().map(panel).collect(),
        notes: vec!["Percent of the runs that diverged, over all targets, frames, starts and elastic laws.".to_owned()],
        x_edges,
        y_edges,
        ..HeatMapPlot::default()
    }
}
