//! Legends, which stand outside the panels and so never cover data, and the notes below a figure.

use super::style::{LINE_WIDTH, MARGIN, SeriesStyle, TEXT_SIZE, TITLE_SIZE};
use super::svg::{Drawing, Rectangle, Stroke};
use super::text::{Anchor, TextStyle, width, wrap};

/// What a legend shows before a label.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Swatch<'a> {
    /// A marker, with a line through it if `line` is set.
    Series {
        /// Colour and marker.
        style: SeriesStyle,
        /// Whether points are connected, and how.
        line: Option<&'a str>,
        /// Whether points are marked.
        markers: bool,
    },
    /// A line of the given colour, width and dash pattern.
    Line(Stroke<'a>),
    /// A filled area of the given colour and opacity.
    Area(&'a str, f64),
    /// A disc of the given colour.
    Disc(&'a str),
}

/// A line of a legend.
#[derive(Debug, Clone, PartialEq)]
pub struct LegendEntry<'a> {
    /// What the entry explains.
    pub swatch: Swatch<'a>,
    /// The explanation.
    pub label: String,
}

impl<'a> LegendEntry<'a> {
    /// A swatch and what it stands for.
    pub fn new(swatch: Swatch<'a>, label: impl Into<String>) -> Self {
        let label = label.into();
        Self { swatch, label }
    }
}

const SWATCH: f64 = 20.0;
const GAP: f64 = 5.0;
const COLUMN_GAP: f64 = 14.0;
const ROW: f64 = 13.0;

/// The width of the widest entry, swatch included.
pub fn entry_width(entries: &[LegendEntry<'_>]) -> f64 {
    entries
        .iter()
        .map(|entry| SWATCH + GAP + width(&entry.label, TEXT_SIZE))
        .fold(0.0, f64::max)
}

/// Draws the entries, column by column in as many columns as fit into `room`, from the point `at` (top left) and returns the
/// height taken.
pub fn draw_legend(drawing: &mut Drawing, at: (f64, f64), room: f64, entries: &[LegendEntry<'_>]) -> f64 {
    let fits = |rows: &usize| {
        let columns = entries.chunks(*rows);
        columns.map(|c| entry_width(c) + COLUMN_GAP).sum::<f64>() <= room + COLUMN_GAP
    };
    let Some(rows) = (1..=entries.len()).find(|rows| fits(rows) || *rows == entries.len()) else {
        return 0.0;
    };
    let mut x = at.0;
    for column in entries.chunks(rows) {
        for (row, entry) in column.iter().enumerate() {
            let middle = at.1 + (row as f64 + 0.5) * ROW;
            draw_swatch(drawing, (x, middle), entry.swatch);
            let from = x + SWATCH + GAP;
            let (start, room) = ((from, middle + 0.36 * TEXT_SIZE), at.0 + room - from);
            drawing.fitted_text(start, &entry.label, room + 0.01, TextStyle::plain(Anchor::Start));
        }
        x += entry_width(column) + COLUMN_GAP;
    }
    rows as f64 * ROW
}

fn draw_swatch(drawing: &mut Drawing, (x, y): (f64, f64), swatch: Swatch<'_>) {
    let (from, to, middle) = ((x, y), (x + SWATCH, y), (x + 0.5 * SWATCH, y));
    match swatch {
        Swatch::Series { style, line, markers } => {
            if let Some(dash) = line {
                let stroke = Stroke {
                    color: style.color,
                    width: LINE_WIDTH,
                    dash,
                };
                drawing.line(from, to, stroke);
            }
            if markers {
                drawing.marker(middle, style);
            }
        }
        Swatch::Line(stroke) => drawing.line(from, to, stroke),
        Swatch::Area(color, opacity) => {
            drawing.filled_rectangle(Rectangle::at((x, y - 4.0), (SWATCH, 8.0)), color, opacity);
        }
        Swatch::Disc(color) => drawing.discs(&[middle], 2.0, color, 1.0),
    }
}

/// A drawing of this width with its title at the top, and where the rest begins.
pub fn titled(title: &str, width: f64) -> (Drawing, f64) {
    let mut drawing = Drawing::new(title);
    let style = TextStyle {
        bold: true,
        ..TextStyle::sized(TITLE_SIZE, Anchor::Start)
    };
    // Bold letters are about a tenth wider.
    let room = (width - 2.0 * MARGIN) / 1.1;
    let lines = wrap(title, room, TITLE_SIZE);
    for (index, line) in lines.iter().enumerate() {
        let baseline = MARGIN + TITLE_SIZE * (0.85 + 1.25 * index as f64);
        drawing.fitted_text((MARGIN, baseline), line, room, style);
    }
    let taken = match lines.len() {
        0 => 0.0,
        count => count as f64 * 1.25 * TITLE_SIZE + 3.0,
    };
    (drawing, MARGIN + taken)
}

/// The document of a drawing with notes from `bottom` on.
pub fn noted(mut drawing: Drawing, width: f64, bottom: f64, notes: &[String]) -> String {
    let room = width - 2.0 * MARGIN;
    let lines: Vec<String> = notes.iter().flat_map(|note| wrap(note, room, TEXT_SIZE)).collect();
    for (index, line) in lines.iter().enumerate() {
        let baseline = bottom + 4.0 + TEXT_SIZE * (0.85 + 1.3 * index as f64);
        drawing.text((MARGIN, baseline), line, TextStyle::plain(Anchor::Start));
    }
    let taken = match lines.len() {
        0 => 0.0,
        count => count as f64 * 1.3 * TEXT_SIZE + 4.0,
    };
    drawing.finish(width, bottom + taken + MARGIN)
}
