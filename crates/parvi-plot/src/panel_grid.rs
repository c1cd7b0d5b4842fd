//! Panels of one size on common axes, in rows.

use super::legend::{LegendEntry, draw_legend, noted, titled};
use super::panel::{AxesParts, Panel, TITLE_ROOM, x_axis_room, y_tick_room};
use super::scale::{Scale, Ticks};
use super::style::FIGURE_WIDTH;
use super::svg::Drawing;

/// Where the panels are, and their axes.
pub struct PanelGrid<'a> {
    /// Panels in a row.
    pub columns: usize,
    /// The left edge of the first column.
    pub left: f64,
    /// The space between two columns.
    pub gap: f64,
    /// Width and height of a panel.
    pub size: (f64, f64),
    /// The horizontal axis: scale, ticks and label.
    pub x: (Scale, Ticks, &'a str),
    /// The vertical axis.
    pub y: (Scale, Ticks, &'a str),
}

impl PanelGrid<'_> {
    /// A figure of titled panels with their content: its title and a legend in `room` above them, notes below.
    pub fn figure<T>(
        &self,
        (title, notes): (&str, &[String]),
        (legend, room): (&[LegendEntry<'_>], f64),
        panels: &[(&str, T)],
        content: impl Fn(&mut Drawing, &Panel, &T),
    ) -> String {
        let (mut drawing, mut top) = titled(title, FIGURE_WIDTH);
        top += draw_legend(&mut drawing, (self.left, top), room, legend) + 6.0;
        let (width, height) = self.size;
        let ((x, x_ticks, x_label), (y, y_ticks, y_label)) = (&self.x, &self.y);
        let rows = panels.chunks(self.columns);
        let last = rows.len();
        for (row, members) in (1..).zip(rows) {
            let x_label = if row == last { *x_label } else { "" };
            for (column, (title, panel)) in members.iter().enumerate() {
                let left = self.left + column as f64 * (width + self.gap);
                let axes = Panel::at((left, top + TITLE_ROOM), self.size, *x, *y);
                content(&mut drawing, &axes, panel);
                let parts = AxesParts {
                    x_ticks: x_ticks.clone(),
                    y_ticks: y_ticks.clone(),
                    x_label: Some(x_label),
                    y_label: if column == 0 { y_label } else { "" },
                    y_tick_room: Some(y_tick_room(y_ticks)),
                };
                axes.draw_axes(&mut drawing, &parts);
                axes.draw_title(&mut drawing, title);
            }
            let label = match x_label {
                "" => 0.0,
                label => x_ticks.label_room(label, width),
            };
            top += TITLE_ROOM + height + x_axis_room(label) + 6.0;
        }
        noted(drawing, FIGURE_WIDTH, top - 4.0, notes)
    }
}
