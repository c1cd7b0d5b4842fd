//! Marginal histograms and kernel density estimates of the particles (step 3 of Algorithm 1 of arXiv 2407.20287).

use super::data::{CheckedPlot, DensityPlot, PlotError};
use super::density_panel::{cloud_notes, marginal_entries, marginals, outside};
use super::legend::{draw_legend, noted, titled};
use super::panel::{AxesParts, Panel, x_axis_room, x_ticks, y_tick_room, y_ticks};
use super::scale::Scale;
use super::style::{FIGURE_WIDTH, MARGIN};

/// Draws the marginals as an SVG document, one panel per coordinate, d = 1 … 8.
///
/// # Errors
/// See [`PlotError`]: no points, points of different or unsupported dimension, coordinates that are not finite, weights
/// that do not fit or are all zero, a reference of another size.
pub fn histogram(plot: &DensityPlot<'_>) -> Result<String, PlotError> {
    let checked = plot.check(1, 8)?;
    let marginals = marginals(&checked, plot.particles.weights)?;
    let CheckedPlot {
        columns,
        labels,
        scales,
        ..
    } = checked;
    let dimension = columns.len();
    let (per_row, width) = match dimension {
        1 => (1, 0.7 * FIGURE_WIDTH),
        2 | 4 => (2, FIGURE_WIDTH),
        _ => (3, FIGURE_WIDTH),
    };
    let height = if per_row < 3 { 140.0 } else { 100.0 };
    let heights: Vec<Scale> = marginals
        .iter()
        .map(|marginal| {
            let peak = marginal.peak();
            let peak = if peak > 0.0 { peak } else { 1.0 };
            Scale::linear(0.0, 1.08 * peak, 0.0)
        })
        .collect();
    let vertical: Vec<_> = heights.iter().map(|y| y_ticks(y, height, 5.0)).collect();
    let y_label = |axis: usize| {
        // One label per row, except where a panel has a power of ten of its own.
        if axis.is_multiple_of(per_row) || vertical[axis].exponent != 0 {
            "density"
        } else {
            ""
        }
    };
    let widest = |column: usize, room: &dyn Fn(usize) -> f64| {
        let members = (column..dimension).step_by(per_row);
        members.map(room).fold(0.0, f64::max)
    };
    let tick_room: Vec<f64> = (0..per_row)
        .map(|column| widest(column, &|axis| y_tick_room(&vertical[axis])))
        .collect();
    let left_room =
        |column: usize| tick_room[column] + widest(column, &|axis| vertical[axis].label_room(y_label(axis), height));
    let gap = 10.0;
    let left_rooms: f64 = (0..per_row).map(left_room).sum();
    let taken = left_rooms + gap * (per_row - 1) as f64 + 2.0 * MARGIN + 8.0;
    let panel_width = (width - taken) / per_row as f64;

    let (mut drawing, mut top) = titled(plot.title, width);
    let entries = marginal_entries(&marginals, plot.reference_label);
    let indent = MARGIN + left_room(0);
    top += draw_legend(&mut drawing, (indent, top), width - indent - MARGIN, &entries) + 8.0;
    let horizontal: Vec<_> = scales.iter().map(|x| x_ticks(x, panel_width, 8.0)).collect();
    let rooms = (0..dimension).map(|axis| horizontal[axis].label_room(&labels[axis], panel_width));
    let row_height = height + x_axis_room(rooms.fold(0.0, f64::max)) + 10.0;
    for (axis, marginal) in marginals.iter().enumerate() {
        let (row, column) = (axis / per_row, axis % per_row);
        let left = MARGIN + (0..=column).map(left_room).sum::<f64>() + column as f64 * (panel_width + gap);
        let panel = Panel::at(
            (left, top + row as f64 * row_height),
            (panel_width, height),
            scales[axis],
            heights[axis],
        );
        marginal.draw(&mut drawing, &panel);
        let parts = AxesParts {
            x_ticks: horizontal[axis].clone(),
            y_ticks: vertical[axis].clone(),
            x_label: Some(&labels[axis]),
            y_label: y_label(axis),
            y_tick_room: Some(tick_room[column]),
        };
        panel.draw_axes(&mut drawing, &parts);
    }
    let bottom = top + dimension.div_ceil(per_row) as f64 * row_height - 6.0;
    let notes = cloud_notes(columns[0].len(), outside(&columns, &scales), false);
    Ok(noted(drawing, width, bottom - 2.0, &notes))
}
