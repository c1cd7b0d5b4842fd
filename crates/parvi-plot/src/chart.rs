//! Grids of panels with lines, markers and error bars under one legend: what traces, scalings and error curves share.

use super::chart_panel::draw_panel;
use super::data::{PlotError, check_size};
use super::legend::{LegendEntry, Swatch, draw_legend, noted, titled};
use super::panel::{AxesParts, Panel, TITLE_ROOM, x_axis_room, x_ticks, y_tick_room, y_ticks};
use super::scale::{Scale, Ticks, plottable};
use super::series::ChartPanel;
use super::style::{FIGURE_WIDTH, GUIDE, MARGIN, SeriesStyle, styles};
use super::svg::Stroke;

/// Labels in the order in which they first appear, and the style of each.
pub(super) struct Legend<'a> {
    names: Vec<&'a str>,
    styles: Vec<SeriesStyle>,
}

impl<'a> Legend<'a> {
    /// Of all labels of a figure.
    pub fn of(labels: impl Iterator<Item = &'a String>) -> Self {
        let mut names: Vec<&str> = Vec::new();
        for label in labels {
            if !names.contains(&label.as_str()) {
                names.push(label);
            }
        }
        let styles = styles(&names);
        Self { names, styles }
    }

    /// The number of different labels.
    pub fn len(&self) -> usize {
        self.names.len()
    }

    /// How many labels before this one have its colour.
    pub fn turn(&self, label: &str) -> usize {
        let own = self.style(label).color;
        let before = self.names.iter().take_while(|name| **name != label);
        before.zip(&self.styles).filter(|(_, style)| style.color == own).count()
    }

    /// The style of a label.
    pub fn style(&self, label: &str) -> SeriesStyle {
        self.styles[self.names.iter().position(|name| *name == label).unwrap_or(0)]
    }
}

/// Panels in rows under one title and legend.
#[derive(Debug, Clone)]
pub(super) struct Chart {
    pub title: String,
    pub panels: Vec<ChartPanel>,
    /// Panels in a row; one that stands alone is narrower.
    pub columns: usize,
    pub panel_height: f64,
    pub notes: Vec<String>,
}

struct Prepared {
    x: Scale,
    y: Scale,
    y_ticks: Ticks,
    /// Labels of axes that would be logarithmic without zeros.
    linear_for_zeros: Vec<String>,
}

impl Chart {
    /// Draws the chart.
    pub fn draw(&self) -> Result<String, PlotError> {
        let prepared = self.prepare()?;
        let columns = self.columns.clamp(1, self.panels.len());
        let width = if self.columns == 1 {
            0.76 * FIGURE_WIDTH
        } else {
            FIGURE_WIDTH
        };
        let rows = self.panels.len().div_ceil(columns);
        let one_y_label = self.panels.windows(2).all(|p| p[0].y.label == p[1].y.label);
        let one_x_label = self.panels.windows(2).all(|p| p[0].x.label == p[1].x.label);
        let has_titles = self.panels.iter().any(|panel| !panel.title.is_empty());

        // Panels of one column start at one abscissa: the widest tick labels of the column decide.
        let column_ticks: Vec<f64> = (0..columns)
            .map(|column| {
                let members = prepared.iter().skip(column).step_by(columns);
                members.map(|p| y_tick_room(&p.y_ticks)).fold(0.0, f64::max)
            })
            .collect();
        // A common axis label stays unless the panels' powers of ten differ.
        let one_exponent = prepared
            .windows(2)
            .all(|p| p[0].y_ticks.exponent == p[1].y_ticks.exponent);
        let labelled = |column: usize| column == 0 || !one_y_label || !one_exponent;
        let left_rooms: Vec<f64> = (0..columns)
            .map(|column| {
                let members = self.panels.iter().zip(&prepared).skip(column).step_by(columns);
                let rooms =
                    members.map(|(panel, prepared)| prepared.y_ticks.label_room(&panel.y.label, self.panel_height));
                column_ticks[column] + rooms.filter(|_| labelled(column)).fold(0.0, f64::max)
            })
            .collect();
        let gap = 10.0;
        let right = MARGIN + 8.0;
        let taken: f64 = left_rooms.iter().sum::<f64>() + gap * (columns - 1) as f64 + MARGIN + right;
        let panel_width = ((width - taken) / columns as f64).max(40.0);

        let (mut drawing, mut top) = titled(&self.title, width);
        let entries = self.legend_entries();
        let indent = MARGIN + left_rooms[0];
        let legend = draw_legend(&mut drawing, (indent, top), width - indent - MARGIN, &entries);
        top += if legend > 0.0 { legend + 6.0 } else { 2.0 };

        let title_room = if has_titles { TITLE_ROOM } else { 4.0 };
        let x_ticks: Vec<Ticks> = prepared
            .iter()
            .map(|prepared| x_ticks(&prepared.x, panel_width, 10.0))
            .collect();
        // Within a column, equal labels of the horizontal axes are written below the lowest panel only.
        let x_label = |index: usize| {
            let lowest = index + columns >= self.panels.len();
            if lowest || !one_x_label || x_ticks[index].exponent != 0 {
                self.panels[index].x.label.as_str()
            } else {
                ""
            }
        };
        let mut row_tops = vec![top];
        for row in 0..rows {
            let members = row * columns..((row + 1) * columns).min(self.panels.len());
            let rooms = members.map(|index| x_ticks[index].label_room(x_label(index), panel_width));
            let below = x_axis_room(rooms.fold(0.0, f64::max)) + 6.0;
            row_tops.push(row_tops[row] + title_room + self.panel_height + below);
        }
        for (index, (panel, prepared)) in self.panels.iter().zip(&prepared).enumerate() {
            let (row, column) = (index / columns, index % columns);
            let left = MARGIN + left_rooms[..=column].iter().sum::<f64>() + column as f64 * (panel_width + gap);
            let axes = Panel::at(
                (left, row_tops[row] + title_room),
                (panel_width, self.panel_height),
                prepared.x,
                prepared.y,
            );
            let parts = AxesParts {
                x_ticks: x_ticks[index].clone(),
                y_ticks: prepared.y_ticks.clone(),
                x_label: Some(x_label(index)),
                y_label: if labelled(column) { &panel.y.label } else { "" },
                y_tick_room: Some(column_ticks[column]),
            };
            draw_panel(&mut drawing, &axes, panel, &parts);
        }
        let bottom = row_tops[rows];
        let mut notes = self.notes.clone();
        for label in prepared.iter().flat_map(|prepared| &prepared.linear_for_zeros) {
            let note = format!("The axis of {label} is linear, as some of the values are 0.");
            if !notes.contains(&note) {
                notes.push(note);
            }
        }
        Ok(noted(drawing, width, bottom - 4.0, &notes))
    }

    /// Checks sizes, fits the scales and divides the vertical axes.
    fn prepare(&self) -> Result<Vec<Prepared>, PlotError> {
        if self.panels.is_empty() {
            return Err(PlotError::empty("panels"));
        }
        let mut drawable = false;
        let mut prepared = Vec::with_capacity(self.panels.len());
        for panel in &self.panels {
            let (mut abscissas, mut ordinates) = (Vec::new(), Vec::new());
            for series in &panel.series {
                let series = &series.line;
                check_size(|| series.label.clone(), series.x.len(), series.y.len())?;
                if !series.bars.is_empty() {
                    let what = || format!("{}: error bars", series.label);
                    check_size(what, series.y.len(), series.bars.len())?;
                }
                let pairs = series.x.iter().zip(&series.y).enumerate();
                for (index, (x, y)) in pairs.filter(|(_, (x, y))| plottable(**x) && plottable(**y)) {
                    drawable |= panel.x.kind.can_show(*x) && panel.y.kind.can_show(*y);
                    abscissas.push(*x);
                    ordinates.push(*y);
                    if let Some(bar) = series.bars.get(index) {
                        ordinates.extend([bar.0, bar.1]);
                    }
                }
            }
            ordinates.extend(panel.levels.iter().map(|level| level.value));
            let for_zeros = [(&panel.x, &abscissas), (&panel.y, &ordinates)].into_iter();
            let for_zeros =
                for_zeros.filter(|(axis, values)| Scale::is_linear_for_zeros(values.iter().copied(), axis.kind));
            let linear_for_zeros = for_zeros.map(|(axis, _)| format!("“{}”", axis.label)).collect();
            let y = Scale::around(ordinates, panel.y.kind, 0.06);
            prepared.push(Prepared {
                x: Scale::around(abscissas, panel.x.kind, 0.04),
                y_ticks: y_ticks(&y, self.panel_height, 5.0),
                y,
                linear_for_zeros,
            });
        }
        if drawable {
            Ok(prepared)
        } else {
            Err(PlotError::empty("series"))
        }
    }

    /// One entry per label, in the order of appearance: series first, then levels.
    fn legend_entries(&self) -> Vec<LegendEntry<'_>> {
        let mut entries: Vec<LegendEntry<'_>> = Vec::new();
        let mut add = |swatch: Swatch<'static>, label: &str| {
            if !label.is_empty() && entries.iter().all(|entry| entry.label != label) {
                entries.push(LegendEntry::new(swatch, label));
            }
        };
        for series in self.panels.iter().flat_map(|panel| &panel.series) {
            let swatch = Swatch::Series {
                style: series.style,
                line: series.dash,
                markers: series.markers,
            };
            add(swatch, &series.line.label);
        }
        for level in self.panels.iter().flat_map(|panel| &panel.levels) {
            add(Swatch::Line(Stroke::dashed(GUIDE, 1.1)), &level.label);
        }
        entries
    }
}
