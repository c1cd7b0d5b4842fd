//! A cloud of particles in the plane at several moments, over the target's contours.

use super::data::{CheckedReference, PlotError, PointCloud, Reference, coordinate_labels};
use super::density_panel::{cloud_entries, cloud_notes, draw_cloud, outside, outside_note, pair_density};
use super::legend::{draw_legend, noted, titled};
use super::panel::{AxesParts, Panel, TITLE_ROOM, x_axis_room, x_ticks, y_tick_room, y_ticks};
use super::scale::{AxisKind, Scale};
use super::style::{FIGURE_WIDTH, MARGIN};

/// One moment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StripPanel<'a> {
    /// Which one.
    pub title: &'a str,
    /// The particles with their weights.
    pub particles: PointCloud<'a>,
}

/// A strip of two-dimensional clouds, three in a row, all on the same axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StripPlot<'a> {
    /// The title; empty for none.
    pub title: &'a str,
    /// The moments.
    pub panels: &'a [StripPanel<'a>],
    /// The labels of both coordinates, with their units; empty for x₁ and x₂.
    pub labels: &'a [String],
    /// The density to compare with: the pair (0, 1) or draws.
    pub reference: Reference<'a>,
    /// The text in the legend for the reference; empty for "target".
    pub reference_label: &'a str,
}

/// Panels in a row.
const COLUMNS: usize = 3;
/// The space between panels.
const GAP: f64 = 8.0;

/// The places, among growing steps, of so many moments from the first step to the last one, closer together at the beginning, where most happens: nearest to
/// s + (N − s) (k / n)², k = 0 … n − 1; all, if there are not more.
pub fn moments(steps: &[usize], count: usize) -> Vec<usize> {
    let (Some(&first), Some(&last)) = (steps.first(), steps.last()) else {
        return Vec::new();
    };
    let count = count.min(steps.len());
    let (first, last) = (first as f64, last as f64);
    let mut chosen: Vec<usize> = Vec::with_capacity(count);
    for k in 0..count {
        let goal = first + (last - first) * (k as f64 / count as f64).powi(2);
        let away = |place: usize| (steps[place] as f64 - goal).abs();
        let from = chosen.last().map_or(0, |place| place + 1);
        // Later ones need a place each.
        let places = from..steps.len() - (count - 1 - k);
        chosen.extend(places.min_by(|&a, &b| away(a).total_cmp(&away(b))));
    }
    chosen
}

/// Draws the strip as an SVG document. A unit has the same length along both axes as far as panels between 0.6 and 1.5 times as high as wide allow; beyond, an axis shows more
/// than the particles.
///
/// # Errors
/// As for [`super::histogram::histogram`], for every panel; the dimension must be 2.
pub fn strip(plot: &StripPlot<'_>) -> Result<String, PlotError> {
    let labels = coordinate_labels(plot.labels, 2)?;
    let reference = plot.reference.check(2)?;
    let clouds = plot.panels.iter().map(|panel| panel.particles.columns(2, 2));
    let clouds: Vec<Vec<Vec<f64>>> = clouds.collect::<Result<_, _>>()?;
    let columns = COLUMNS.min(plot.panels.len());
    let mut x = scale(0, plot, &clouds, &reference)?;
    let mut y = scale(1, plot, &clouds, &reference)?;
    let shape = (y.span() / x.span()).clamp(0.6, 1.5);
    (x, y) = (x.widened(y.span() / shape), y.widened(x.span() * shape));
    // The ticks' labels need room that their number, which follows the height, decides; a first guess of it serves.
    let guess = shape * FIGURE_WIDTH / COLUMNS as f64;
    let tick_room = y_tick_room(&y_ticks(&y, guess, 5.0));
    let left = MARGIN + tick_room + y_ticks(&y, guess, 5.0).label_room(&labels[1], guess);
    let taken = left + GAP * (COLUMNS - 1) as f64 + MARGIN + 8.0;
    let width = (FIGURE_WIDTH - taken) / COLUMNS as f64;
    let height = shape * width;
    let (horizontal, vertical) = (x_ticks(&x, width, 0.5 * GAP), y_ticks(&y, height, 5.0));
    let total = left + width * columns as f64 + GAP * (columns - 1) as f64 + MARGIN + 8.0;
    let total = total.max(0.55 * FIGURE_WIDTH);

    let (mut drawing, mut top) = titled(plot.title, total);
    let density = pair_density(&reference, 0, 1, &x, &y);
    let entries = cloud_entries(density.is_some().then_some(plot.reference_label));
    top += draw_legend(&mut drawing, (left, top), total - left - MARGIN, &entries) + 4.0;
    let x_label_room = horizontal.label_room(&labels[0], width);
    let rows = plot.panels.len().div_ceil(COLUMNS);
    for (index, (panel, cloud)) in plot.panels.iter().zip(&clouds).enumerate() {
        let (row, column) = (index / COLUMNS, index % COLUMNS);
        let axes = Panel::at(
            (
                left + column as f64 * (width + GAP),
                top + TITLE_ROOM + row as f64 * (height + TITLE_ROOM + GAP),
            ),
            (width, height),
            x,
            y,
        );
        let pair = (cloud[0].as_slice(), cloud[1].as_slice());
        draw_cloud(&mut drawing, &axes, pair, panel.particles.weights, density.as_ref());
        let lowest = index + COLUMNS >= plot.panels.len();
        let first = column == 0;
        let parts = AxesParts {
            x_ticks: horizontal.clone(),
            y_ticks: vertical.clone(),
            x_label: lowest.then_some(labels[0].as_str()),
            y_label: if first { &labels[1] } else { "" },
            y_tick_room: first.then_some(tick_room),
        };
        axes.draw_axes(&mut drawing, &parts);
        axes.draw_title(&mut drawing, panel.title);
    }
    let bottom = top + rows as f64 * (height + TITLE_ROOM + GAP) - GAP + x_axis_room(x_label_room) + 2.0;
    Ok(noted(drawing, total, bottom, &notes(plot, &clouds, &[x, y])))
}

/// One scale for all moments and the reference.
fn scale(
    axis: usize,
    plot: &StripPlot<'_>,
    clouds: &[Vec<Vec<f64>>],
    reference: &CheckedReference<'_>,
) -> Result<Scale, PlotError> {
    if clouds.is_empty() {
        return Err(PlotError::empty("panels"));
    }
    let mut ends = Vec::with_capacity(2 * clouds.len());
    for (panel, cloud) in plot.panels.iter().zip(clouds) {
        let (low, high) = reference.scale(axis, &cloud[axis], panel.particles.weights)?.ends();
        ends.extend([low, high]);
    }
    Ok(Scale::around(ends, AxisKind::Linear, 0.0))
}

/// What is not shown, by the panel with the most particles outside.
fn notes(plot: &StripPlot<'_>, clouds: &[Vec<Vec<f64>>], scales: &[Scale]) -> Vec<String> {
    let most = plot
        .panels
        .iter()
        .zip(clouds)
        .map(|(panel, cloud)| (outside(cloud, scales), panel.title, cloud[0].len()))
        .max_by_key(|(outside, ..)| *outside);
    let hidden = match most {
        Some((count, title, all)) if count > 0 => Some(format!("{title}: {}", outside_note(count, all))),
        _ => None,
    };
    let largest = clouds.iter().map(|cloud| cloud[0].len()).max().unwrap_or(0);
    hidden.into_iter().chain(cloud_notes(largest, 0, true)).collect()
}
