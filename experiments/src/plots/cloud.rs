//! One cloud of particles in the plane over the target's contours.

use super::data::{PlotError, PointCloud, Reference, coordinate_labels};
use super::density_panel::{cloud_notes, contour_entry, draw_cloud, outside, pair_density, particle_entry};
use super::legend::{draw_legend, draw_notes, draw_title};
use super::panel::{AxesParts, Panel, label_lines, label_room, x_axis_room, x_ticks, y_tick_room, y_ticks};
use super::style::{FIGURE_WIDTH, MARGIN};
use super::svg::{Drawing, Rectangle};

/// A scatter plot of two-dimensional particles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CloudPlot<'a> {
    /// The title; empty for none.
    pub title: &'a str,
    /// The particles with their weights.
    pub particles: PointCloud<'a>,
    /// The text in the legend for the particles; empty for "particles".
    pub particles_label: &'a str,
    /// The labels of both coordinates, with their units; empty for x₁ and x₂.
    pub labels: &'a [String],
    /// The density to compare with: the pair (0, 1) or draws.
    pub reference: Reference<'a>,
    /// The text in the legend for the reference; empty for "target".
    pub reference_label: &'a str,
    /// Whether a unit has the same length along both axes, as befits two coordinates of one kind.
    pub equal_units: bool,
}

/// Draws the scatter plot as an SVG document.
///
/// # Errors
/// As for [`super::histogram::histogram`]; the dimension must be 2.
pub fn cloud(plot: &CloudPlot<'_>) -> Result<String, PlotError> {
    let columns = plot.particles.columns(2, 2)?;
    let labels = coordinate_labels(plot.labels, 2)?;
    let reference = plot.reference.check(2)?;
    let weights = plot.particles.weights;
    let mut x = reference.scale(0, &columns[0], weights)?;
    let mut y = reference.scale(1, &columns[1], weights)?;
    let mut width = 0.72 * FIGURE_WIDTH;
    let mut height = 0.55 * FIGURE_WIDTH;
    let vertical = y_ticks(&y, height, 5.0);
    let y_lines = label_lines(&labels[1], vertical.exponent, height).len();
    let left = MARGIN + label_room(y_lines) + y_tick_room(&vertical);
    let edge = MARGIN + 8.0;
    let mut panel_width = width - left - edge;
    if plot.equal_units {
        // The frame takes the data's shape between two limits; beyond them an axis shows more than the data.
        let shape = (y.span() / x.span()).clamp(0.6, 1.8);
        height = (shape * panel_width).min(1.15 * panel_width);
        panel_width = height / shape;
        width = (left + panel_width + edge).max(0.55 * FIGURE_WIDTH);
        (x, y) = (x.widened(y.span() / shape), y.widened(x.span() * shape));
    }
    let vertical = y_ticks(&y, height, 5.0);
    let tick_room = y_tick_room(&vertical);
    let mut drawing = Drawing::new(plot.title);
    let room = width - 2.0 * MARGIN;
    let mut top = MARGIN + draw_title(&mut drawing, (MARGIN, MARGIN), room, plot.title);
    let density = pair_density(&reference, 0, 1, &x, &y);
    let mut entries = vec![particle_entry(if plot.particles_label.is_empty() {
        "particles"
    } else {
        plot.particles_label
    })];
    if density.is_some() {
        entries.push(contour_entry(plot.reference_label));
    }
    top += draw_legend(&mut drawing, (left, top), width - left - MARGIN, &entries) + 8.0;
    let panel = Panel {
        area: Rectangle {
            x: left,
            y: top,
            width: panel_width,
            height,
        },
        x,
        y,
    };
    let pair = (columns[0].as_slice(), columns[1].as_slice());
    draw_cloud(&mut drawing, &panel, pair, weights, density.as_ref());
    let parts = AxesParts {
        x_ticks: x_ticks(&x, panel_width, 8.0),
        y_ticks: vertical,
        x_label: Some(&labels[0]),
        y_label: &labels[1],
        y_tick_room: Some(tick_room),
    };
    let x_lines = label_lines(&labels[0], parts.x_ticks.exponent, panel_width).len();
    panel.draw_axes(&mut drawing, &parts);
    let bottom = panel.area.bottom() + x_axis_room(x_lines) + 2.0;
    let notes = cloud_notes(columns[0].len(), outside(&columns, &[x, y]), true);
    let notes = draw_notes(&mut drawing, (MARGIN, bottom), room, &notes);
    Ok(drawing.finish(width, bottom + notes + MARGIN))
}
