//! The figure of the study `stability`: where the paper's algorithms diverge.

use super::draw::{SPACINGS, TIME_STEPS};
use super::row::Row;
use crate::options::{MethodName, Switch};
use crate::plots::{AxisKind, HeatMapPlot, HeatPanel};

/// Cells along each axis.
const CELLS: usize = 6;

/// The shares of diverged runs of Algorithms 1 and 2 over time step and spacing, without guards and with them.
pub fn plot(rows: &[Row]) -> HeatMapPlot {
    let panels = [
        ("Algorithm 1 (PIC), guards off", MethodName::PaperPic, Switch::Off),
        ("Algorithm 1 (PIC), guards on", MethodName::PaperPic, Switch::On),
        ("Algorithm 2 (APIC), guards off", MethodName::PaperApic, Switch::Off),
        ("Algorithm 2 (APIC), guards on", MethodName::PaperApic, Switch::On),
    ];
    let (x_edges, y_edges) = (edges(TIME_STEPS), edges(SPACINGS));
    let panel = |(title, method, guards): (&str, MethodName, Switch)| {
        let here = |row: &&Row| row.method == method && row.guards == Some(guards);
        let place = |row: &Row| {
            let column = cell(&x_edges, row.time_step_factor)?;
            Some((column, cell(&y_edges, row.spacing_factor)?))
        };
        let placed: Vec<_> = rows.iter().filter(here).map(|row| (row, place(row))).collect();
        let share = |index: usize| {
            let place = Some((index % CELLS, index / CELLS));
            let inside = || placed.iter().filter(|(_, found)| *found == place);
            let diverged = inside().filter(|(row, _)| row.diverged()).count();
            let all = inside().count();
            (all > 0).then(|| diverged as f64 / all as f64)
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

/// The edges of cells of equal factors.
pub fn edges([least, most]: [f64; 2]) -> Vec<f64> {
    (0..=CELLS)
        .map(|edge| least * (most / least).powf(edge as f64 / CELLS as f64))
        .collect()
}

/// The cell that holds a value; the last one holds its upper edge as well.
pub fn cell(edges: &[f64], value: f64) -> Option<usize> {
    let last = edges.len().checked_sub(2)?;
    // The ends are met up to rounding.
    let inside = value >= edges[0] * (1.0 - 1e-9) && value <= edges[last + 1] * (1.0 + 1e-9);
    inside.then(|| edges[1..=last].iter().filter(|edge| value >= **edge).count())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_cover_the_range() {
        let edges = edges([0.1, 10.0]);
        assert_eq!(edges.len(), CELLS + 1);
        assert_eq!(cell(&edges, 0.1), Some(0));
        assert_eq!(cell(&edges, 10.0), Some(CELLS - 1));
        assert_eq!(cell(&edges, 1.01), Some(CELLS / 2));
        assert_eq!(cell(&edges, 11.0), None);
        assert_eq!(cell(&edges, f64::NAN), None);
        assert_eq!(cell(&[], 1.0), None);
    }
}
