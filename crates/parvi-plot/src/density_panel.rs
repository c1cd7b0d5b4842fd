//! What histograms, corner plots and scatter plots share: marginals and particles over density contours.

use crate::statistics::{DensityGrid, bandwidth, equidistant, kernel_density, kernel_density_grid, weighted_quantile};

use super::contour::{contour_lines, levels_of_mass};
use super::data::{CheckedPlot, CheckedReference, Curve, PlotError, Reference};
use super::legend::{LegendEntry, Swatch};
use super::panel::Panel;
use super::scale::{Scale, plottable};
use super::style::{ESTIMATE, LINE_WIDTH, PARTICLES, REFERENCE};
use super::svg::{Drawing, Rectangle, Stroke};

/// The masses that the contours enclose.
pub(super) const CONTOUR_MASSES: [f64; 3] = [0.5, 0.9, 0.99];

/// No panel draws more particles than this; of more, every k-th is drawn.
pub(super) const MOST_POINTS: usize = 4000;

/// How legends show the reference.
pub(super) const REFERENCE_SWATCH: Swatch<'static> = Swatch::Line(Stroke::solid(REFERENCE, 1.1));

const HISTOGRAM_OPACITY: f64 = 0.32;

/// The particles' histogram and density estimate along one coordinate, and the reference density.
pub(super) struct Marginal {
    /// The ends and height of each bar.
    bars: Vec<(f64, f64, f64)>,
    estimate: Option<Curve>,
    reference: Option<Curve>,
}

/// The marginals of all coordinates.
pub(super) fn marginals(plot: &CheckedPlot<'_>, weights: Option<&[f64]>) -> Result<Vec<Marginal>, PlotError> {
    let columns = plot.columns.iter().zip(&plot.scales).enumerate();
    columns
        .map(|(axis, (column, scale))| Marginal::new(column, weights, &plot.reference, axis, scale))
        .collect()
}

impl Marginal {
    /// Computes the marginal of `column` on the interval that `scale` shows.
    fn new(
        column: &[f64],
        weights: Option<&[f64]>,
        reference: &CheckedReference<'_>,
        axis: usize,
        scale: &Scale,
    ) -> Result<Marginal, PlotError> {
        let locations = equidistant(scale.ends(), 301);
        // Without spread there is no estimate; the histogram's single bar says so.
        let estimate = |values: &[f64], weights: Option<&[f64]>| {
            kernel_density(values, weights, &locations).ok().map(|y| Curve {
                x: locations.clone(),
                y,
            })
        };
        Ok(Marginal {
            bars: histogram_bars(column, weights, scale)?,
            estimate: estimate(column, weights),
            reference: match reference.given {
                Reference::None => None,
                Reference::Draws(cloud) => estimate(&reference.draws[axis], cloud.weights),
                Reference::Exact { marginals, .. } => marginals.get(axis).cloned().flatten(),
            },
        })
    }

    /// The largest density drawn.
    pub fn peak(&self) -> f64 {
        let curves = self.estimate.iter().chain(&self.reference);
        self.bars
            .iter()
            .map(|bar| bar.2)
            .chain(curves.flat_map(|curve| curve.y.iter().copied()))
            .filter(|value| plottable(*value))
            .fold(0.0, f64::max)
    }

    /// Draws bars and curves.
    pub fn draw(&self, drawing: &mut Drawing, panel: &Panel) {
        drawing.clipped(panel.area, |drawing| {
            for (low, high, height) in &self.bars {
                let corners = (panel.point(*low, *height), panel.x_at(*high));
                if let (Some((x, y)), Some(right)) = corners {
                    // A hair of white between the bars; no bar thinner than it can be seen.
                    let bar = Rectangle::at((x, y), ((right - x - 0.3).max(0.5), panel.area.bottom() - y));
                    drawing.filled_rectangle(bar, PARTICLES, HISTOGRAM_OPACITY);
                }
            }
            if let Some(curve) = &self.reference {
                draw_curve(drawing, panel, curve, Stroke::solid(REFERENCE, 1.1));
            }
            if let Some(curve) = &self.estimate {
                draw_curve(drawing, panel, curve, Stroke::dashed(ESTIMATE, LINE_WIDTH));
            }
        });
    }
}

fn draw_curve(drawing: &mut Drawing, panel: &Panel, curve: &Curve, stroke: Stroke<'_>) {
    let points: Vec<(f64, f64)> = curve
        .x
        .iter()
        .zip(&curve.y)
        .filter_map(|(x, y)| panel.point(*x, *y))
        .collect();
    drawing.paths(&[points], stroke);
}

/// Bars of equal width over the shown interval, normalised by the weight of all points. The width is that of Freedman &
/// Diaconis, 2 IQR n^(−1/3) with the effective sample size, or, where smaller as for separated modes, what corresponds to it
/// for a kernel of the plug-in width, within 8…60 bars over the interval.
fn histogram_bars(column: &[f64], weights: Option<&[f64]>, scale: &Scale) -> Result<Vec<(f64, f64, f64)>, PlotError> {
    let (low, high) = scale.ends();
    let weight = |index: usize| weights.map_or(1.0, |weights| weights[index]);
    let total: f64 = (0..column.len()).map(weight).sum();
    let squares: f64 = (0..column.len()).map(|i| (weight(i) / total).powi(2)).sum();
    let quartiles = weighted_quantile(column, weights, &[0.25, 0.75])?;
    let mut natural = 2.0 * (quartiles[1] - quartiles[0]) * squares.cbrt();
    if let Ok(width) = bandwidth(column, weights) {
        // For a Gaussian: 2.7 σ n^(−1/3) = 2.55 h n^(−2/15) with h = 1.06 σ n^(−1/5).
        natural = natural.min(2.55 * width * squares.powf(2.0 / 15.0));
    }
    let count = if natural > 0.0 {
        ((high - low) / natural).clamp(8.0, 60.0) as usize
    } else {
        31
    };
    let width = (high - low) / count as f64;
    let mut masses = vec![0.0; count];
    for (index, value) in column.iter().enumerate() {
        let position = (value - low) / width;
        if (0.0..=count as f64).contains(&position) {
            masses[(position as usize).min(count - 1)] += weight(index) / total;
        }
    }
    Ok(masses
        .into_iter()
        .enumerate()
        .filter(|(_, mass)| *mass > 0.0)
        .map(|(index, mass)| {
            let start = low + index as f64 * width;
            (start, start + width, mass / width)
        })
        .collect())
}

/// The joint density of two coordinates for contours: the caller's grid, or an estimate from draws; `None` without one.
pub(super) fn pair_density(
    reference: &CheckedReference<'_>,
    horizontal: usize,
    vertical: usize,
    x: &Scale,
    y: &Scale,
) -> Option<DensityGrid> {
    match reference.given {
        Reference::None => None,
        Reference::Draws(cloud) => {
            let (first, second) = (&reference.draws[horizontal], &reference.draws[vertical]);
            // Wide enough that contours close before the grid ends.
            let range = |scale: &Scale| {
                let (low, high) = scale.ends();
                let margin = 0.08 * (high - low);
                (low - margin, high + margin)
            };
            kernel_density_grid(first, second, cloud.weights, (range(x), range(y)), 110).ok()
        }
        Reference::Exact { pairs, .. } => pairs
            .iter()
            .find(|pair| pair.horizontal == horizontal && pair.vertical == vertical)
            .map(|pair| pair.grid.clone()),
    }
}

/// Draws the particles as discs, smaller and fainter the more there are, their area in proportion to their weight up to
/// four times the mean, and the
/// contours of `density` over them.
pub(super) fn draw_cloud(
    drawing: &mut Drawing,
    panel: &Panel,
    (x, y): (&[f64], &[f64]),
    weights: Option<&[f64]>,
    density: Option<&DensityGrid>,
) {
    let stride = x.len().div_ceil(MOST_POINTS);
    let drawn = x.len().div_ceil(stride) as f64;
    let extent = panel.area.width.min(panel.area.height);
    let radius = (0.009 * extent * (500.0 / drawn).powf(0.35)).clamp(0.45, 1.7);
    let opacity = (0.7 * (500.0 / drawn).powf(0.25)).clamp(0.3, 0.8);
    let mean = weights.map_or(1.0, |w| w.iter().sum::<f64>() / w.len() as f64);
    // Radii in steps of a quarter of the usual one, so that discs of one size share paths.
    let mut sizes: Vec<Vec<(f64, f64)>> = vec![Vec::new(); 9];
    for index in (0..x.len()).step_by(stride) {
        let relative = weights.map_or(1.0, |weights| weights[index] / mean);
        let step = (4.0 * relative.sqrt()).round().min(8.0) as usize;
        if let Some(at) = panel.point(x[index], y[index])
            && panel.contains(at)
        {
            sizes[step].push(at);
        }
    }
    drawing.clipped(panel.area, |drawing| {
        for (step, centres) in sizes.iter().enumerate().skip(1).rev() {
            if !centres.is_empty() {
                let radius = (radius * step as f64 / 4.0).max(0.25);
                drawing.discs(centres, radius, PARTICLES, opacity);
            }
        }
        let Some(grid) = density else { return };
        for level in levels_of_mass(grid, &CONTOUR_MASSES) {
            let lines: Vec<Vec<(f64, f64)>> = contour_lines(grid, level)
                .into_iter()
                .map(|line| {
                    let points = line.into_iter().filter_map(|(x, y)| panel.point(x, y));
                    spaced(&points.collect::<Vec<_>>())
                })
                .collect();
            drawing.paths(&lines, Stroke::solid("#fff", 1.7));
            drawing.paths(&lines, Stroke::solid(REFERENCE, 0.9));
        }
    });
}

/// The line without points closer than 0.8 points on the page to the last one kept; its ends stay.
fn spaced(line: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let mut kept: Vec<(f64, f64)> = Vec::new();
    for (index, point) in line.iter().enumerate() {
        let far = |last: &(f64, f64)| (point.0 - last.0).hypot(point.1 - last.1) > 0.8;
        if index + 1 == line.len() || kept.last().is_none_or(far) {
            kept.push(*point);
        }
    }
    kept
}

/// How many of the points lie outside the given scales in at least one coordinate.
pub(super) fn outside(columns: &[Vec<f64>], scales: &[Scale]) -> usize {
    let visible = |axis: usize, index: usize| {
        scales[axis]
            .fraction(columns[axis][index])
            .is_some_and(|fraction| (0.0..=1.0).contains(&fraction))
    };
    let count = columns.first().map_or(0, Vec::len);
    (0..count)
        .filter(|&index| (0..columns.len()).any(|axis| !visible(axis, index)))
        .count()
}

/// How many of all particles are not seen.
pub(super) fn outside_note(outside: usize, total: usize) -> String {
    let lie = if outside == 1 { "lies" } else { "lie" };
    format!("{outside} of {total} particles {lie} outside the axes.")
}

/// The notes about particles that a figure does not show.
pub(super) fn cloud_notes(total: usize, outside: usize, thinned: bool) -> Vec<String> {
    let mut notes = Vec::new();
    if outside > 0 {
        notes.push(outside_note(outside, total));
    }
    let stride = total.div_ceil(MOST_POINTS);
    if thinned && stride > 1 {
        notes.push(format!("One of every {stride} particles is drawn."));
    }
    notes
}

/// The legend's entries for marginals.
pub(super) fn marginal_entries<'a>(marginals: &[Marginal], reference_label: &str) -> Vec<LegendEntry<'a>> {
    let histogram = Swatch::Area(PARTICLES, HISTOGRAM_OPACITY);
    let mut entries = vec![LegendEntry::new(histogram, "particles, histogram")];
    if marginals.iter().any(|marginal| marginal.estimate.is_some()) {
        let estimate = Swatch::Line(Stroke::dashed(ESTIMATE, LINE_WIDTH));
        entries.push(LegendEntry::new(estimate, "particles, kernel density"));
    }
    if marginals.iter().any(|marginal| marginal.reference.is_some()) {
        entries.push(LegendEntry::new(REFERENCE_SWATCH, or_target(reference_label)));
    }
    entries
}

fn or_target(label: &str) -> String {
    if label.is_empty() { "target" } else { label }.to_string()
}

/// The legend's entries for scattered particles, and for the contours of a density called so, if there is one.
pub(super) fn cloud_entries<'a>(density: Option<&str>) -> Vec<LegendEntry<'a>> {
    let mut entries = vec![LegendEntry::new(Swatch::Disc(PARTICLES), "particles")];
    if let Some(label) = density {
        let label = format!("{}; contours hold 50, 90, 99 %", or_target(label));
        entries.push(LegendEntry::new(REFERENCE_SWATCH, label));
    }
    entries
}
