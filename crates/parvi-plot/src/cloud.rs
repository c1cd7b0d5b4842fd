//! One cloud of particles in the plane over the target's contours.

use super::data::{CheckedPlot, DensityPlot, PlotError};
use super::density_panel::{cloud_entries, cloud_notes, draw_cloud, outside, pair_density};
use super::legend::{draw_legend, noted, titled};
use super::panel::{AxesParts, Panel, x_axis_room, x_ticks, y_tick_room, y_ticks};
use super::style::{FIGURE_WIDTH, MARGIN};

/// Draws the scatter plot as an SVG document.
///
/// # Errors
/// As for [`super::histogram::histogram`]; the dimension must be 2.
pub fn cloud(plot: &DensityPlot<'_>) -> Result<String, PlotError> {
    let CheckedPlot {
        columns,
        labels,
        reference,
        scales,
    } = plot.check(2, 2)?;
    let (mut x, mut y) = (scales[0], scales[1]);
    let mut width = 0.72 * FIGURE_WIDTH;
    let mut height = 0.55 * FIGURE_WIDTH;
    let vertical = y_ticks(&y, height, 5.0);
    let left = MARGIN + vertical.label_room(&labels[1], height) + y_tick_room(&vertical);
    let edge = MARGIN + 8.0;
    let mut panel_width = width - left - edge;
    // A unit has the same length along both axes. The frame takes the data's shape between two limits; beyond them an axis shows more than the data.
    let shape = (y.span() / x.span()).clamp(0.6, 1.8);
    height = (shape * panel_width).min(1.15 * panel_width);
    panel_width = height / shape;
    width = (left + panel_width + edge).max(0.55 * FIGURE_WIDTH);
    (x, y) = (x.widened(y.span() / shape), y.widened(x.span() * shape));
    let vertical = y_ticks(&y, height, 5.0);
    let tick_room = y_tick_room(&vertical);
    let (mut drawing, mut top) = titled(plot.title, width);
    let density = pair_density(&reference, 0, 1, &x, &y);
    let entries = cloud_entries(density.is_some().then_some(plot.reference_label));
    top += draw_legend(&mut drawing, (left, top), width - left - MARGIN, &entries) + 8.0;
    let panel = Panel::at((left, top), (panel_width, height), x, y);
    let pair = (columns[0].as_slice(), columns[1].as_slice());
    draw_cloud(&mut drawing, &panel, pair, plot.particles.weights, density.as_ref());
    let parts = AxesParts {
        x_ticks: x_ticks(&x, panel_width, 8.0),
        y_ticks: vertical,
        x_label: Some(&labels[0]),
        y_label: &labels[1],
        y_tick_room: Some(tick_room),
    };
    panel.draw_axes(&mut drawing, &parts);
    let bottom = panel.area.bottom() + x_axis_room(parts.x_ticks.label_room(&labels[0], panel_width)) + 2.0;
    let notes = cloud_notes(columns[0].len(), outside(&columns, &[x, y]), true);
    Ok(noted(drawing, width, bottom, &notes))
}
