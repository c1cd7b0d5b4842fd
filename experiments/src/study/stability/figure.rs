//! The figure of the study `stability`: where the paper's algorithms diverge.

use super::diverged;
use super::draw::{SPACINGS, TIME_STEPS};
use crate::plots::{CellAxis, HeatMapPlot};
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
    let plot = HeatMapPlot {
        x: CellAxis::logarithmic("time step / default", TIME_STEPS, CELLS),
        y: CellAxis::logarithmic("spacing / default", SPACINGS, CELLS),
        notes: vec!["Percent of the runs that diverged, over all targets, frames, starts and elastic laws.".to_owned()],
        ..HeatMapPlot::default()
    };
    panels.into_iter().fold(plot, |plot, (title, method, guards)| {
        let here = rows.with("method", method.as_str()).with("guards", guards);
        plot.with_shares(title, &here, ["time_step_factor", "spacing_factor"], diverged)
    })
}
