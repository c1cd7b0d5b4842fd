//! One pair of axes: frame, ticks, labels and the map from data to the page.

use super::scale::{Scale, Ticks};
use super::style::{AXIS_WIDTH, GRID, INK, LABEL_SIZE, MAJOR_TICK, MINOR_TICK, TEXT_SIZE};
use super::svg::{Drawing, Rectangle, Stroke};
use super::text::{Anchor, TextStyle, cut, power_of_ten, width, wrap};

/// The distance between a tick and its label.
const TICK_GAP: f64 = 2.5;

/// Widths of bold letters over those of plain ones, and the least size of a title that is too wide, over the usual one.
const BOLDER: f64 = 1.12;
const LEAST_TITLE: f64 = 0.75;
/// How far a title may stick out of its panel.
const BESIDE: f64 = 8.0;

/// A rectangle with a horizontal and a vertical scale.
#[derive(Debug, Clone, Copy)]
pub struct Panel {
    /// The area inside the frame.
    pub area: Rectangle,
    /// The horizontal scale.
    pub x: Scale,
    /// The vertical scale.
    pub y: Scale,
}

/// Which parts of the axes a panel shows.
#[derive(Debug, Clone, Default)]
pub struct AxesParts<'a> {
    /// The ticks of the horizontal axis.
    pub x_ticks: Ticks,
    /// The ticks of the vertical axis; none for an axis without a scale.
    pub y_ticks: Ticks,
    /// The label of the horizontal axis; `None` leaves out tick labels too.
    pub x_label: Option<&'a str>,
    /// The label of the vertical axis.
    pub y_label: &'a str,
    /// The room for the tick labels between the frame and the vertical axis' label; `None` leaves out both.
    pub y_tick_room: Option<f64>,
}

impl Ticks {
    /// The room that a label needs beside an axis of this length with these ticks.
    pub fn label_room(&self, label: &str, length: f64) -> f64 {
        match label_lines(label, self.exponent, length).len() {
            0 => 0.0,
            lines => lines as f64 * LINE_HEIGHT + 5.0,
        }
    }

    /// Where its ticks are, and how long.
    fn lengths(&self) -> impl Iterator<Item = (f64, f64)> {
        let minor = self.minor.iter().map(|&fraction| (fraction, MINOR_TICK));
        minor.chain(self.major.iter().map(|&(fraction, _)| (fraction, MAJOR_TICK)))
    }
}

impl Panel {
    /// Scales on an area of this width and height with its top left corner there.
    pub fn at(corner: (f64, f64), size: (f64, f64), x: Scale, y: Scale) -> Self {
        let area = Rectangle::at(corner, size);
        Self { area, x, y }
    }

    /// The page position of a point, `None` if one of its coordinates cannot be drawn.
    pub fn point(&self, x: f64, y: f64) -> Option<(f64, f64)> {
        Some((self.x_at(x)?, self.y_at(y)?))
    }

    /// The horizontal page position of a value.
    pub fn x_at(&self, x: f64) -> Option<f64> {
        let position = self.area.x + self.x.fraction(x)? * self.area.width;
        Some(position.clamp(-1e5, 1e5))
    }

    /// The vertical page position of a value.
    pub fn y_at(&self, y: f64) -> Option<f64> {
        let position = self.area.bottom() - self.y.fraction(y)? * self.area.height;
        Some(position.clamp(-1e5, 1e5))
    }

    /// Whether a page position lies inside the frame.
    pub fn contains(&self, (x, y): (f64, f64)) -> bool {
        (self.area.x..=self.area.right()).contains(&x) && (self.area.y..=self.area.bottom()).contains(&y)
    }

    /// Light lines at the labelled ticks.
    pub fn draw_grid(&self, drawing: &mut Drawing, x_ticks: &Ticks, y_ticks: &Ticks) {
        let area = self.area;
        let mut segments = Vec::new();
        for (fraction, _) in &x_ticks.major {
            let x = area.x + fraction * area.width;
            segments.push([(x, area.y), (x, area.bottom())]);
        }
        for (fraction, _) in &y_ticks.major {
            let y = area.bottom() - fraction * area.height;
            segments.push([(area.x, y), (area.right(), y)]);
        }
        drawing.lines(&segments, Stroke::solid(GRID, 0.6));
    }

    /// A title above the frame, smaller where it would be wider than that, and cut where it still is.
    pub fn draw_title(&self, drawing: &mut Drawing, title: &str) {
        let share = self.area.width / (BOLDER * width(title, LABEL_SIZE)).max(f64::MIN_POSITIVE);
        let style = TextStyle {
            bold: true,
            ..TextStyle::sized(LABEL_SIZE * share.clamp(LEAST_TITLE, 1.0), Anchor::Start)
        };
        let room = (self.area.width + BESIDE) / BOLDER;
        drawing.fitted_text((self.area.x, self.area.y - 4.5), title, room, style);
    }

    /// The frame, ticks and labels.
    pub fn draw_axes(&self, drawing: &mut Drawing, parts: &AxesParts<'_>) {
        let area = self.area;
        let axis = Stroke::solid(INK, AXIS_WIDTH);
        let bottom = area.bottom();
        let mut segments = Vec::new();
        for (fraction, length) in parts.x_ticks.lengths() {
            let x = area.x + fraction * area.width;
            segments.push([(x, bottom), (x, bottom + length)]);
        }
        for (fraction, length) in parts.y_ticks.lengths() {
            let y = bottom - fraction * area.height;
            segments.push([(area.x - length, y), (area.x, y)]);
        }
        drawing.lines(&segments, axis);
        drawing.frame(area, axis);
        if let Some(label) = parts.x_label {
            let baseline = bottom + MAJOR_TICK + TICK_GAP + 0.76 * TEXT_SIZE;
            for (fraction, text) in &parts.x_ticks.major {
                let x = area.x + fraction * area.width;
                drawing.text((x, baseline), text, TextStyle::plain(Anchor::Middle));
            }
            let middle = area.x + 0.5 * area.width;
            let lines = label_lines(label, parts.x_ticks.exponent, area.width);
            for (index, line) in lines.iter().enumerate() {
                let y = baseline + 3.5 + LABEL_SIZE + index as f64 * LINE_HEIGHT;
                let style = TextStyle::sized(LABEL_SIZE, Anchor::Middle);
                drawing.titled_text((middle, y), (line, whole(line, label)), style);
            }
        }
        if let Some(tick_room) = parts.y_tick_room {
            let x = area.x - MAJOR_TICK - TICK_GAP;
            for (fraction, text) in &parts.y_ticks.major {
                let y = bottom - fraction * area.height + 0.36 * TEXT_SIZE;
                drawing.text((x, y), text, TextStyle::plain(Anchor::End));
            }
            let lines = label_lines(parts.y_label, parts.y_ticks.exponent, area.height);
            for (index, line) in lines.iter().rev().enumerate() {
                let distance = tick_room + 6.5 + index as f64 * LINE_HEIGHT;
                let style = TextStyle {
                    upwards: true,
                    ..TextStyle::sized(LABEL_SIZE, Anchor::Middle)
                };
                let middle = area.y + 0.5 * area.height;
                drawing.titled_text((area.x - distance, middle), (line, whole(line, parts.y_label)), style);
            }
        }
    }
}

/// The room that the title of a panel needs above its frame.
pub const TITLE_ROOM: f64 = LABEL_SIZE + 5.0;

/// The distance between the lines of a label.
const LINE_HEIGHT: f64 = 1.2 * LABEL_SIZE;

/// Lines of an axis label, at most, and how long one may be over the axis.
const MOST_LINES: usize = 4;
const LONGER: f64 = 1.15;

/// What a line of a label stands for: all of it where the line was cut.
fn whole<'a>(line: &'a str, label: &'a str) -> &'a str {
    if line.ends_with('…') { label } else { line }
}

/// An axis label with the power of ten that the tick labels leave out, in a few lines not much longer than the axis; what has no room is cut, but never the power.
fn label_lines(label: &str, exponent: i32, length: f64) -> Vec<String> {
    let power = format!("(×{})", power_of_ten(exponent));
    let label = if exponent == 0 {
        label.to_string()
    } else {
        format!("{label} {power}")
    };
    // What stands in parentheses, such as a unit, stays together.
    let mut depth = 0;
    let joined: String = label
        .chars()
        .map(|character| {
            match character {
                '(' => depth += 1,
                ')' => depth -= 1,
                _ => {}
            }
            if character == ' ' && depth > 0 {
                '\u{a0}'
            } else {
                character
            }
        })
        .collect();
    let mut lines = wrap(&joined, length, LABEL_SIZE);
    if lines.len() > MOST_LINES {
        lines.truncate(MOST_LINES);
        if exponent != 0 {
            lines[MOST_LINES - 1] = power;
        }
        let last = MOST_LINES - 1 - usize::from(exponent != 0);
        lines[last].push('…');
    }
    for line in &mut lines {
        *line = cut(line, LONGER * length, LABEL_SIZE);
    }
    lines
}

/// The room of a label of one line.
pub const ONE_LINE: f64 = LINE_HEIGHT + 5.0;

/// The room below a frame for ticks, tick labels and a label that needs so much.
pub fn x_axis_room(label: f64) -> f64 {
    MAJOR_TICK + TICK_GAP + TEXT_SIZE + label
}

/// Horizontal ticks for an axis `length` points long. Labels that would stick out of the axis by more than `overhang` are
/// left off.
pub fn x_ticks(scale: &Scale, length: f64, overhang: f64) -> Ticks {
    let inside = |(fraction, label): &(f64, String)| {
        let half = 0.5 * width(label, TEXT_SIZE);
        fraction * length - half >= -overhang && fraction * length + half <= length + overhang
    };
    let ticks = scale.ticks(|labels| {
        let kept: Vec<&(f64, String)> = labels.iter().filter(|label| inside(label)).collect();
        let apart = kept.windows(2).all(|pair| {
            let room = 0.5 * (width(&pair[0].1, TEXT_SIZE) + width(&pair[1].1, TEXT_SIZE));
            (pair[1].0 - pair[0].0) * length >= room + 5.0
        });
        apart.then_some(kept.len())
    });
    thin(scale, ticks, length, inside)
}

/// The ticks without the labels that are not inside, and without the minor ticks of a linear axis where they would stand closer than 3 points.
fn thin(scale: &Scale, mut ticks: Ticks, length: f64, inside: impl Fn(&(f64, String)) -> bool) -> Ticks {
    ticks
        .major
        .iter_mut()
        .filter(|tick| !inside(tick))
        .for_each(|tick| tick.1.clear());
    let count = ticks.minor.len() + ticks.major.len();
    if !scale.logarithmic && count as f64 * 3.0 > length {
        ticks.minor.clear();
    }
    ticks
}

/// Vertical ticks for an axis `length` points long; labels that would stick out by more than `overhang` are left off.
pub fn y_ticks(scale: &Scale, length: f64, overhang: f64) -> Ticks {
    let half = 0.5 * TEXT_SIZE - overhang;
    let inside = |(fraction, _): &(f64, String)| (half..=length - half).contains(&(fraction * length));
    let ticks = scale.ticks(|labels| {
        let apart = labels
            .windows(2)
            .all(|pair| (pair[1].0 - pair[0].0) * length >= 1.6 * TEXT_SIZE);
        apart.then(|| labels.iter().filter(|label| inside(label)).count())
    });
    thin(scale, ticks, length, inside)
}

/// The room that the tick labels of a vertical axis need to the left of its frame.
pub fn y_tick_room(ticks: &Ticks) -> f64 {
    let widest = ticks
        .major
        .iter()
        .map(|tick| width(&tick.1, TEXT_SIZE))
        .fold(0.0, f64::max);
    MAJOR_TICK + TICK_GAP + widest
}
