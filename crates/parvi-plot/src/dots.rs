//! Dot plots: one row per setting, its values as markers on one axis, with a bound per row.

use super::data::{PlotError, check_size};
use super::legend::{LegendEntry, Swatch, draw_legend, noted, titled};
use super::panel::{AxesParts, Panel, x_axis_room, x_ticks};
use super::scale::{AxisKind, Scale};
use super::style::{FIGURE_WIDTH, GRID, GUIDE, MARGIN, SeriesStyle, TEXT_SIZE, crossed_styles, styles};
use super::svg::{Drawing, Stroke};
use super::text::{Anchor, TextStyle, width};

/// The height of a row.
const ROW: f64 = 14.0;
/// The part of a row's height over which its markers are spread, so that equal values stay apart.
const SPREAD: f64 = 0.62;

/// How wide the label of a row may be.
const WIDEST_LABEL: f64 = 0.5 * FIGURE_WIDTH;

/// A series with one value per row.
#[derive(Debug, Clone, PartialEq)]
pub struct DotSeries {
    /// The text in the legend.
    pub label: String,
    /// Colour and marker.
    pub style: SeriesStyle,
    /// The values, row by row; those that cannot be drawn are left out.
    pub values: Vec<f64>,
}

/// A dot plot.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct DotPlot {
    /// The label of the axis, with its unit.
    pub x_label: String,
    /// The rows, from top to bottom: the setting, and a value for comparison, which is not a number where there is none.
    pub rows: Vec<(String, f64)>,
    /// The series.
    pub series: Vec<DotSeries>,
    /// The text in the legend for the bounds.
    pub bound_label: String,
    /// Notes below the figure.
    pub notes: Vec<String>,
}

impl DotPlot {
    /// Labelled rows with a bound each over a logarithmic axis, and no series yet.
    pub fn bounded(x_label: &str, rows: impl IntoIterator<Item = (String, f64)>, bound_label: &str) -> Self {
        Self {
            x_label: x_label.to_owned(),
            rows: rows.into_iter().collect(),
            bound_label: bound_label.to_owned(),
            ..Self::default()
        }
    }

    /// The same with series by their names, each with a value per row.
    pub fn with_series(self, named: Vec<(String, Vec<f64>)>) -> Self {
        let names: Vec<&str> = named.iter().map(|(name, _)| name.as_str()).collect();
        let styles = styles(&names);
        self.styled(styles, named)
    }

    /// The same with series of two numbers each, which have a value per row: colours tell the first numbers apart, markers the second ones.
    pub fn with_crossed(self, named: Vec<(String, [f64; 2], Vec<f64>)>) -> Self {
        let numbers: Vec<[f64; 2]> = named.iter().map(|(_, numbers, _)| *numbers).collect();
        let named = named.into_iter().map(|(name, _, values)| (name, values));
        self.styled(crossed_styles(&numbers), named)
    }

    fn styled(self, styles: Vec<SeriesStyle>, named: impl IntoIterator<Item = (String, Vec<f64>)>) -> Self {
        let series = named.into_iter().zip(styles);
        let series = series.map(|((label, values), style)| DotSeries { label, style, values });
        Self {
            series: series.collect(),
            ..self
        }
    }

    /// The same with a note below.
    pub fn with_note(mut self, note: impl Into<String>) -> Self {
        self.notes.push(note.into());
        self
    }

    /// How many values are no numbers.
    pub fn missing(&self) -> usize {
        let values = self.series.iter().flat_map(|series| &series.values);
        values.filter(|value| value.is_nan()).count()
    }
}

/// Draws a dot plot as an SVG document.
///
/// # Errors
/// [`PlotError::Empty`] if no value can be drawn, [`PlotError::Size`] if a series has not one value per row.
pub fn dots(plot: &DotPlot) -> Result<String, PlotError> {
    for series in &plot.series {
        check_size(|| series.label.clone(), plot.rows.len(), series.values.len())?;
    }
    let values = || plot.series.iter().flat_map(|series| series.values.iter().copied());
    if !values().any(|value| AxisKind::Logarithmic.can_show(value)) {
        return Err(PlotError::empty("dots"));
    }
    let bounds = plot.rows.iter().map(|(_, bound)| *bound);
    let scale = Scale::around(values().chain(bounds), AxisKind::Logarithmic, 0.04);
    let (mut drawing, mut top) = titled("", FIGURE_WIDTH);
    let labels = plot.rows.iter().map(|(label, _)| width(label, TEXT_SIZE));
    let left = MARGIN + labels.fold(0.0, f64::max).min(WIDEST_LABEL) + 6.0;
    let legend_room = FIGURE_WIDTH - left - MARGIN;
    let legend = draw_legend(&mut drawing, (left, top), legend_room, &legend_entries(plot));
    top += legend + 8.0;

    let axes = Panel::at(
        (left, top),
        (FIGURE_WIDTH - left - MARGIN - 8.0, ROW * plot.rows.len() as f64),
        scale,
        Scale::linear(0.0, 1.0, 0.0),
    );
    draw_rows(&mut drawing, &axes, plot);
    let parts = AxesParts {
        x_ticks: x_ticks(&scale, axes.area.width, 10.0),
        x_label: Some(&plot.x_label),
        ..AxesParts::default()
    };
    axes.draw_axes(&mut drawing, &parts);
    let room = parts.x_ticks.label_room(&plot.x_label, axes.area.width);
    let bottom = axes.area.bottom() + x_axis_room(room) + 6.0;
    Ok(noted(drawing, FIGURE_WIDTH, bottom - 4.0, &plot.notes))
}

/// The series, then the bound.
fn legend_entries(plot: &DotPlot) -> Vec<LegendEntry<'static>> {
    let series = plot.series.iter().map(|series| {
        let swatch = Swatch::Series {
            style: series.style,
            line: None,
            markers: true,
        };
        LegendEntry::new(swatch, &series.label)
    });
    let bound = LegendEntry::new(Swatch::Line(Stroke::dashed(GUIDE, 1.1)), &plot.bound_label);
    let bounded = plot.rows.iter().any(|(_, bound)| !bound.is_nan());
    series.chain(bounded.then_some(bound)).collect()
}

/// Labels, guides, bounds and markers.
fn draw_rows(drawing: &mut Drawing, axes: &Panel, plot: &DotPlot) {
    let area = axes.area;
    let ticks = x_ticks(&axes.x, area.width, 10.0);
    axes.draw_grid(drawing, &ticks, &Default::default());
    let middle = |row: usize| area.y + (row as f64 + 0.5) * ROW;
    for (index, (label, bound)) in plot.rows.iter().enumerate() {
        let y = middle(index);
        drawing.line((area.x, y), (area.right(), y), Stroke::solid(GRID, 0.6));
        let at = (area.x - 5.0, y + 0.36 * TEXT_SIZE);
        drawing.fitted_text(at, label, WIDEST_LABEL, TextStyle::plain(Anchor::End));
        if let Some(x) = axes.x_at(*bound) {
            let (from, to) = ((x, y - 0.5 * ROW), (x, y + 0.5 * ROW));
            drawing.line(from, to, Stroke::dashed(GUIDE, 1.1));
        }
    }
    let step = SPREAD * ROW / (plot.series.len().max(2) - 1) as f64;
    for (number, series) in plot.series.iter().enumerate() {
        let offset = (number as f64 - 0.5 * (plot.series.len() - 1) as f64) * step;
        for (index, value) in series.values.iter().enumerate() {
            if let Some(x) = axes.x_at(*value) {
                drawing.marker((x, middle(index) + offset), series.style);
            }
        }
    }
}
