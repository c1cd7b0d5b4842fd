//! Heat maps: shares over the cells of a plane, one panel per setting, with the number in every cell that has room for it.

use super::data::{PlotError, check_size};
use super::legend::{LegendEntry, Swatch};
use super::page::{Line, number};
use super::panel::{Panel, x_ticks, y_tick_room, y_ticks};
use super::panel_grid::PanelGrid;
use super::results::{Row, Rows};
use super::scale::{Axis, Scale};
use super::style::{ESTIMATE, FIGURE_WIDTH, GRID, MARGIN};
use super::svg::{Drawing, Rectangle};
use super::text::{Anchor, TextStyle};

/// The colour of a share of one; smaller shares are as much paler.
const FULL: &str = ESTIMATE;
/// The size of the numbers in the cells.
const CELL_TEXT: f64 = 7.0;
/// Narrower cells have no number.
const NARROWEST: f64 = 9.0;
/// The height of a panel.
const PANEL_HEIGHT: f64 = 150.0;

/// One setting.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct HeatPanel {
    /// The setting.
    pub title: String,
    /// The shares, from 0 to 1: column by column along the horizontal axis, row after row upwards. `None` or a value that is no
    /// number: a cell without data, which is grey.
    pub shares: Vec<Option<f64>>,
}

/// An axis that is divided into cells.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CellAxis {
    /// Label and division.
    pub axis: Axis,
    /// The edges of the cells, growing.
    pub edges: Vec<f64>,
}

impl CellAxis {
    /// So many cells of equal factors between two positive ends, as [`logarithmic_edges`] has them.
    pub fn logarithmic(label: impl Into<String>, ends: [f64; 2], cells: usize) -> Self {
        Self {
            axis: Axis::logarithmic(label),
            edges: logarithmic_edges(ends, cells),
        }
    }

    fn cells(&self) -> usize {
        self.edges.len().saturating_sub(1)
    }

    fn scale(&self) -> Scale {
        Scale::around(self.edges.iter().copied(), self.axis.kind, 0.0)
    }
}

/// A figure of heat maps over one plane.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct HeatMapPlot {
    /// The title; empty for none.
    pub title: String,
    /// The horizontal axis.
    pub x: CellAxis,
    /// The vertical axis.
    pub y: CellAxis,
    /// The panels, two in a row.
    pub panels: Vec<HeatPanel>,
    /// Notes below the figure.
    pub notes: Vec<String>,
}

impl HeatMapPlot {
    /// The same with a panel more: the share of the rows that have a property, over two columns whose edges are those of the plot.
    pub fn with_shares(
        mut self,
        title: &str,
        rows: &Rows<'_>,
        columns: [&str; 2],
        property: impl Fn(&Row) -> bool,
    ) -> Self {
        let place = |row: &Row, column: &str, edges: &[f64]| cell_of(edges, row.number(column)?);
        let [across, up] = [&self.x, &self.y].map(CellAxis::cells);
        let mut shares = Vec::with_capacity(across * up);
        for y in 0..up {
            let here = rows.having(|row| place(row, columns[1], &self.y.edges) == Some(y));
            for x in 0..across {
                let inside = here.having(|row| place(row, columns[0], &self.x.edges) == Some(x));
                let share = || inside.count(&property) as f64 / inside.len() as f64;
                shares.push((!inside.is_empty()).then(share));
            }
        }
        let title = title.to_owned();
        self.panels.push(HeatPanel { title, shares });
        self
    }
}

impl<'a> Rows<'a> {
    /// A line for each of so many cells of equal factors between two positive ends, which has its ends as `label`, of the rows that have a column in it.
    pub fn lines_in_cells(&self, column: &str, ends: [f64; 2], cells: usize) -> Vec<Line<'a>> {
        let edges = logarithmic_edges(ends, cells);
        let line = |(cell, ends): (usize, &[f64])| {
            let is_inside = |row: &Row| row.number(column).and_then(|value| cell_of(&edges, value)) == Some(cell);
            let label = format!("{} to {}", number(ends[0]), number(ends[1]));
            Line::from(self.having(is_inside)).with("label", label)
        };
        edges.windows(2).enumerate().map(line).collect()
    }
}

/// The edges of so many cells of equal factors between two ends. None without cells, nor where the ends are not positive, finite and growing.
pub fn logarithmic_edges([least, most]: [f64; 2], cells: usize) -> Vec<f64> {
    let divided = cells > 0 && least > 0.0 && least < most && most.is_finite();
    if !divided {
        return Vec::new();
    }
    let edge = |edge: usize| least * (most / least).powf(edge as f64 / cells as f64);
    (0..=cells).map(edge).collect()
}

/// The cell that holds a positive value; the last one holds its upper edge as well. `None` outside.
pub fn cell_of(edges: &[f64], value: f64) -> Option<usize> {
    let last = edges.len().checked_sub(2)?;
    // The ends are met up to rounding.
    let inside = value >= edges[0] * (1.0 - 1e-9) && value <= edges[last + 1] * (1.0 + 1e-9);
    inside.then(|| edges[1..=last].iter().filter(|edge| value >= **edge).count())
}

/// Draws heat maps as an SVG document.
///
/// # Errors
/// [`PlotError::Empty`] without panels, cells or data; [`PlotError::Size`] if a panel has not one share per cell.
pub fn heat_map(plot: &HeatMapPlot) -> Result<String, PlotError> {
    let cells = plot.x.cells() * plot.y.cells();
    for panel in &plot.panels {
        check_size(|| panel.title.clone(), cells, panel.shares.len())?;
    }
    if !plot.panels.iter().any(|panel| panel.shares.iter().any(drawable)) {
        return Err(PlotError::empty("cells"));
    }
    let (x, y) = (plot.x.scale(), plot.y.scale());
    let vertical = y_ticks(&y, PANEL_HEIGHT, 5.0);
    let columns = plot.panels.len().min(2);
    let tick_room = y_tick_room(&vertical);
    let left = MARGIN + tick_room + vertical.label_room(&plot.y.axis.label, PANEL_HEIGHT);
    let gap = tick_room + 12.0;
    let panel_width = (FIGURE_WIDTH - left - MARGIN - 8.0 - gap * (columns - 1) as f64) / columns as f64;
    let horizontal = x_ticks(&x, panel_width, 10.0);

    let grid = PanelGrid {
        columns,
        left,
        gap,
        size: (panel_width, PANEL_HEIGHT),
        x: (x, horizontal, &plot.x.axis.label),
        y: (y, vertical, &plot.y.axis.label),
    };
    let panels: Vec<_> = plot.panels.iter().map(|panel| (panel.title.as_str(), panel)).collect();
    let (words, legend) = ((plot.title.as_str(), &plot.notes[..]), legend_entries());
    Ok(grid.figure(
        words,
        (&legend, FIGURE_WIDTH - left - MARGIN),
        &panels,
        |drawing, axes, panel| {
            draw_cells(drawing, axes, plot, panel);
        },
    ))
}

fn drawable(share: &Option<f64>) -> bool {
    share.is_some_and(f64::is_finite)
}

/// The shade of some shares, and of cells without data.
fn legend_entries() -> Vec<LegendEntry<'static>> {
    let shade = |share: f64| LegendEntry::new(Swatch::Area(FULL, share), format!("{:.0} %", 100.0 * share));
    let without_data = LegendEntry::new(Swatch::Area(GRID, 1.0), "no data");
    [0.25, 0.5, 0.75, 1.0]
        .into_iter()
        .map(shade)
        .chain([without_data])
        .collect()
}

/// The cells of a panel with their percentages.
fn draw_cells(drawing: &mut Drawing, axes: &Panel, plot: &HeatMapPlot, panel: &HeatPanel) {
    let columns = plot.x.cells();
    for (index, share) in panel.shares.iter().enumerate() {
        let (column, row) = (index % columns, index / columns);
        let corner = |x: usize, y: usize| axes.point(plot.x.edges[x], plot.y.edges[y]);
        let (Some(low), Some(high)) = (corner(column, row), corner(column + 1, row + 1)) else {
            continue;
        };
        let area = Rectangle::at((low.0, high.1), (high.0 - low.0, low.1 - high.1));
        let Some(share) = share.filter(|share| share.is_finite()) else {
            drawing.filled_rectangle(area, GRID, 1.0);
            continue;
        };
        let share = share.clamp(0.0, 1.0);
        drawing.filled_rectangle(area, FULL, share);
        if area.width < NARROWEST || area.height < CELL_TEXT {
            continue;
        }
        let at = (0.5 * (low.0 + high.0), 0.5 * (low.1 + high.1) + 0.36 * CELL_TEXT);
        let text = format!("{:.0}", 100.0 * share);
        drawing.text(at, &text, TextStyle::sized(CELL_TEXT, Anchor::Middle));
    }
}
