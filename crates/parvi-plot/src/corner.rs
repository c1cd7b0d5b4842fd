//! Corner plots: every pair of coordinates over the target's contours, marginals on the diagonal.

use super::data::{CheckedPlot, DensityPlot, PlotError};
use super::density_panel::{
    REFERENCE_SWATCH, cloud_entries, cloud_notes, draw_cloud, marginal_entries, marginals, outside, pair_density,
};
use super::legend::{draw_legend, entry_width, noted, titled};
use super::panel::{AxesParts, ONE_LINE, Panel, x_axis_room, x_ticks, y_tick_room, y_ticks};
use super::scale::{Scale, Ticks};
use super::style::{FIGURE_WIDTH, MARGIN};

/// The space between panels.
const GAP: f64 = 7.0;

/// Draws the corner plot as an SVG document, d = 1 … 6.
///
/// # Errors
/// As for [`super::histogram::histogram`].
pub fn corner(plot: &DensityPlot<'_>) -> Result<String, PlotError> {
    let checked = plot.check(1, 6)?;
    let marginals = marginals(&checked, plot.particles.weights)?;
    let CheckedPlot {
        columns,
        labels,
        reference,
        scales,
    } = checked;
    let dimension = columns.len();
    let weights = plot.particles.weights;
    let width = match dimension {
        1 | 2 => 0.72 * FIGURE_WIDTH,
        3 => 0.85 * FIGURE_WIDTH,
        _ => FIGURE_WIDTH,
    };
    // The rows' tick labels and axis labels decide the left margin; a first guess of the panels' size decides those.
    let guess = (width - 70.0) / dimension as f64 - GAP;
    let vertical: Vec<Ticks> = scales.iter().map(|scale| y_ticks(scale, guess, GAP / 2.0)).collect();
    let tick_room = vertical.iter().skip(1).map(y_tick_room).fold(8.0, f64::max);
    let rooms = (1..dimension).map(|row| vertical[row].label_room(&labels[row], guess));
    let left = MARGIN + rooms.reduce(f64::max).unwrap_or(ONE_LINE) + tick_room;
    let size = (width - left - MARGIN - 2.0 - GAP * (dimension - 1) as f64) / dimension as f64;
    let height = if dimension == 1 { 0.6 * size } else { size };

    let (mut drawing, mut top) = titled(plot.title, width);
    let densities: Vec<Vec<_>> = (0..dimension)
        .map(|row| {
            (0..row)
                .map(|column| pair_density(&reference, column, row, &scales[column], &scales[row]))
                .collect()
        })
        .collect();
    let contours = densities.iter().flatten().any(Option::is_some);
    let mut entries = marginal_entries(&marginals, plot.reference_label);
    if contours {
        entries.retain(|entry| entry.swatch != REFERENCE_SWATCH);
    }
    if dimension > 1 {
        entries.extend(cloud_entries(contours.then_some(plot.reference_label)));
    }
    // The legend stands in the empty upper triangle where it fits, else above.
    let corner_room = (dimension - 1) as f64 * (size + GAP) - 12.0;
    if entry_width(&entries) <= corner_room {
        top += 2.0;
        let at = (left + size + GAP + 12.0, top);
        draw_legend(&mut drawing, at, entry_width(&entries), &entries);
    } else {
        top += draw_legend(&mut drawing, (left, top), width - left - MARGIN, &entries) + 8.0;
    }

    let horizontal: Vec<Ticks> = scales.iter().map(|scale| x_ticks(scale, size, GAP / 2.0)).collect();
    for row in 0..dimension {
        for column in 0..=row {
            let corner = (left + column as f64 * (size + GAP), top + row as f64 * (height + GAP));
            let axes = |y: Scale| Panel::at(corner, (size, height), scales[column], y);
            let mut parts = AxesParts {
                x_ticks: horizontal[column].clone(),
                x_label: (row == dimension - 1).then_some(labels[column].as_str()),
                ..AxesParts::default()
            };
            if row == column {
                let peak = marginals[row].peak();
                let panel = axes(Scale::linear(0.0, if peak > 0.0 { 1.1 * peak } else { 1.0 }, 0.0));
                marginals[row].draw(&mut drawing, &panel);
                if dimension == 1 {
                    parts.y_label = "density";
                    parts.y_tick_room = Some(tick_room);
                }
                panel.draw_axes(&mut drawing, &parts);
                continue;
            }
            let panel = axes(scales[row]);
            let density = densities[row][column].as_ref();
            let pair = (columns[column].as_slice(), columns[row].as_slice());
            draw_cloud(&mut drawing, &panel, pair, weights, density);
            parts.y_ticks = vertical[row].clone();
            if column == 0 {
                parts.y_label = &labels[row];
                parts.y_tick_room = Some(tick_room);
            }
            panel.draw_axes(&mut drawing, &parts);
        }
    }
    let rooms = (0..dimension).map(|axis| horizontal[axis].label_room(&labels[axis], size));
    let bottom = top + dimension as f64 * (height + GAP) - GAP + x_axis_room(rooms.fold(0.0, f64::max)) + 2.0;
    let hidden = outside(&columns, &scales);
    let notes = cloud_notes(columns[0].len(), hidden, dimension > 1);
    Ok(noted(drawing, width, bottom, &notes))
}
