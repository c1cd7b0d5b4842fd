//! Snapshots of bodies: particles in a plane, coloured by classes of a value, one panel per instant, both axes on one scale.

use super::data::{PlotError, check_size};
use super::legend::{LegendEntry, Swatch};
use super::panel::{ONE_LINE, Panel, x_ticks, y_tick_room, y_ticks};
use super::panel_grid::PanelGrid;
use super::scale::{AxisKind, Scale, plottable};
use super::style::{FIGURE_WIDTH, MARGIN};
use super::svg::{Drawing, Stroke};

/// Colours of classes from low to high, each darker than the one before.
const CLASSES: [&str; 5] = ["#c6d5e8", "#8fb8de", "#f2b46b", "#d55e00", "#5a1200"];

/// Room for the labels of vertical ticks, at least.
const LEAST_TICK_ROOM: f64 = 20.0;

/// One instant.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SnapshotPanel {
    /// Which one.
    pub title: String,
    /// Where the particles are.
    pub positions: Vec<[f64; 2]>,
    /// A value of each particle; one that is not a number is left out.
    pub values: Vec<f64>,
}

/// A figure of snapshots.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SnapshotsPlot {
    /// The title; empty for none.
    pub title: String,
    /// What the values are, with their unit.
    pub value_label: String,
    /// The label of the horizontal axis, with its unit.
    pub x_label: String,
    /// The label of the vertical axis, with its unit.
    pub y_label: String,
    /// The part of the plane, lowest and highest corner.
    pub extent: [[f64; 2]; 2],
    /// Distance between particles: the size they are drawn with.
    pub spacing: f64,
    /// Bounds between the classes, up to four, growing.
    pub bounds: Vec<f64>,
    /// Panels in a row.
    pub columns: usize,
    /// The panels.
    pub panels: Vec<SnapshotPanel>,
    /// Notes below the figure.
    pub notes: Vec<String>,
}

/// Draws snapshots as an SVG document.
///
/// # Errors
/// [`PlotError::Empty`] without a particle that can be drawn or an area to draw it in; [`PlotError::Size`] if a panel has not one value per particle.
pub fn snapshots(plot: &SnapshotsPlot) -> Result<String, PlotError> {
    for panel in &plot.panels {
        check_size(|| panel.title.clone(), panel.positions.len(), panel.values.len())?;
    }
    let mut all = plot
        .panels
        .iter()
        .flat_map(|panel| panel.positions.iter().zip(&panel.values));
    if !all.any(|(x, value)| plottable(x[0]) && plottable(x[1]) && !value.is_nan()) {
        return Err(PlotError::empty("particles"));
    }
    let [low, high] = plot.extent;
    if !(0..2).all(|a| plottable(low[a]) && plottable(high[a]) && low[a] < high[a]) {
        return Err(PlotError::empty("extent"));
    }
    let x = Scale::around([low[0], high[0]], AxisKind::Linear, 0.0);
    let y = Scale::around([low[1], high[1]], AxisKind::Linear, 0.0);
    let columns = plot.columns.clamp(1, plot.panels.len());
    // Left margin, gap, width and height with so much room for the labels of vertical ticks.
    let layout = |room: f64| {
        let (left, gap) = (MARGIN + room + 4.0 + ONE_LINE, room + 6.0);
        let width = (FIGURE_WIDTH - left - MARGIN - 8.0 - gap * (columns - 1) as f64) / columns as f64;
        let height = (width / (high[0] - low[0]) * (high[1] - low[1])).clamp(20.0, 640.0);
        (left, gap, width, height)
    };
    // What these labels are hangs on the height, which hangs on their room.
    let (_, _, _, first_height) = layout(LEAST_TICK_ROOM);
    let (left, gap, width, height) = layout(y_tick_room(&y_ticks(&y, first_height, 5.0)).max(LEAST_TICK_ROOM));
    let unit = width / (high[0] - low[0]);
    let (horizontal, vertical) = (x_ticks(&x, width, 4.0), y_ticks(&y, height, 5.0));

    let grid = PanelGrid {
        columns,
        left,
        gap,
        size: (width, height),
        x: (x, horizontal, &plot.x_label),
        y: (y, vertical, &plot.y_label),
    };
    let panels: Vec<_> = plot.panels.iter().map(|panel| (panel.title.as_str(), panel)).collect();
    let (words, legend) = ((plot.title.as_str(), &plot.notes[..]), legend(plot));
    Ok(grid.figure(
        words,
        (&legend, FIGURE_WIDTH - 2.0 * MARGIN - left),
        &panels,
        |drawing, axes, panel| {
            draw_particles(drawing, axes, plot, panel, unit);
        },
    ))
}

/// The class of a value: how many bounds it reaches.
fn class(plot: &SnapshotsPlot, value: f64) -> usize {
    let reached = plot.bounds.iter().take_while(|bound| value >= **bound).count();
    reached.min(CLASSES.len() - 1)
}

fn legend(plot: &SnapshotsPlot) -> Vec<LegendEntry<'static>> {
    let count = plot.bounds.len().min(CLASSES.len() - 1);
    let label = |class: usize| match (class, plot.bounds.get(class)) {
        (0, None) => plot.value_label.clone(),
        (0, Some(bound)) => format!("{} < {bound}", plot.value_label),
        (_, Some(bound)) if class < count => format!("{} to {bound}", plot.bounds[class - 1]),
        _ => format!("≥ {}", plot.bounds[class - 1]),
    };
    let entry = |class: usize| LegendEntry::new(Swatch::Area(CLASSES[class], 1.0), label(class));
    (0..=count).map(entry).collect()
}

/// The particles of a panel, the lowest class first: squares as short thick lines, one path per class.
fn draw_particles(drawing: &mut Drawing, axes: &Panel, plot: &SnapshotsPlot, panel: &SnapshotPanel, unit: f64) {
    let size = (unit * plot.spacing).max(0.6);
    drawing.clipped(axes.area, |drawing| {
        for (number, color) in CLASSES.iter().enumerate() {
            let particles = panel.positions.iter().zip(&panel.values);
            let members = particles.filter(|(_, value)| !value.is_nan() && class(plot, **value) == number);
            let square = |(at, _): (&[f64; 2], &f64)| {
                let (x, y) = axes.point(at[0], at[1])?;
                Some([(x - 0.5 * size, y), (x + 0.5 * size, y)])
            };
            let squares: Vec<_> = members.filter_map(square).collect();
            drawing.lines(&squares, Stroke::solid(color, size));
        }
    });
}
