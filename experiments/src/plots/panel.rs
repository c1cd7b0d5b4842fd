//! One pair of axes: frame, ticks, labels and the map from data to the page.

use super::scale::{Scale, Ticks};
use super::style::{AXIS_WIDTH, GRID, INK, LABEL_SIZE, MAJOR_TICK, MINOR_TICK, TEXT_SIZE};
use super::svg::{Drawing, Rectangle, Stroke};
use super::text::{Anchor, TextStyle, power_of_ten, width};

/// The distance between a tick and its label.
const TICK_GAP: f64 = 2.5;

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
    /// The label of the vertical axis and the distance of its centre line from the frame; `None` leaves it out.
    pub y_label: Option<(&'a str, f64)>,
    /// Whether the vertical ticks are labelled.
    pub y_tick_labels: bool,
}

impl Panel {
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
        (self.area.x..=self.area.right()).contains(&x)
            && (self.area.y..=self.area.bottom()).contains(&y)
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

    /// The frame, ticks and labels.
    pub fn draw_axes(&self, drawing: &mut Drawing, parts: &AxesParts<'_>) {
        let area = self.area;
        let axis = Stroke::solid(INK, AXIS_WIDTH);
        let bottom = area.bottom();
        let mut segments = Vec::new();
        let ticks = parts.x_ticks.minor.iter().map(|f| (f, MINOR_TICK));
        let ticks = ticks.chain(parts.x_ticks.major.iter().map(|t| (&t.0, MAJOR_TICK)));
        for (fraction, length) in ticks {
            let x = area.x + fraction * area.width;
            segments.push([(x, bottom), (x, bottom + length)]);
        }
        let ticks = parts.y_ticks.minor.iter().map(|f| (f, MINOR_TICK));
        let ticks = ticks.chain(parts.y_ticks.major.iter().map(|t| (&t.0, MAJOR_TICK)));
        for (fraction, length) in ticks {
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
            let label = with_exponent(label, parts.x_ticks.exponent);
            drawing.text(
                (middle, baseline + 3.5 + LABEL_SIZE),
                &label,
                TextStyle::sized(fitted_size(&label, area.width + 20.0), Anchor::Middle),
            );
        }
        if parts.y_tick_labels {
            let x = area.x - MAJOR_TICK - TICK_GAP;
            for (fraction, text) in &parts.y_ticks.major {
                let y = bottom - fraction * area.height + 0.36 * TEXT_SIZE;
                drawing.text((x, y), text, TextStyle::plain(Anchor::End));
            }
        }
        if let Some((label, distance)) = parts.y_label {
            let label = with_exponent(label, parts.y_ticks.exponent);
            let style = TextStyle {
                upwards: true,
                ..TextStyle::sized(fitted_size(&label, area.height + 20.0), Anchor::Middle)
            };
            let at = (
                area.x - distance + 0.36 * LABEL_SIZE,
                area.y + 0.5 * area.height,
            );
            drawing.text(at, &label, style);
        }
    }
}

/// The label with the power of ten that the tick labels leave out.
fn with_exponent(label: &str, exponent: i32) -> String {
    if exponent == 0 {
        return label.to_string();
    }
    format!("{label} (×{})", power_of_ten(exponent))
        .trim_start()
        .to_string()
}

/// The label size, reduced down to the text size for long labels.
fn fitted_size(label: &str, room: f64) -> f64 {
    let natural = width(label, LABEL_SIZE);
    (LABEL_SIZE * (room / natural.max(1.0)).min(1.0)).max(TEXT_SIZE)
}

/// The room that a horizontal axis needs below its frame: ticks, tick labels and the label.
pub const X_AXIS_ROOM: f64 = MAJOR_TICK + TICK_GAP + TEXT_SIZE + 4.0 + LABEL_SIZE;

/// Horizontal ticks for an axis `length` points long. Labels that would stick out of the axis by more than `overhang` are
/// left off.
pub fn x_ticks(scale: &Scale, length: f64, overhang: f64) -> Ticks {
    let inside = |(fraction, label): &(f64, String)| {
        let half = 0.5 * width(label, TEXT_SIZE);
        fraction * length - half >= -overhang && fraction * length + half <= length + overhang
    };
    let mut ticks = scale.ticks(|labels| {
        let kept: Vec<&(f64, String)> = labels.iter().filter(|label| inside(label)).collect();
        kept.len() >= 2.min(labels.len())
            && kept.windows(2).all(|pair| {
                let room = 0.5 * (width(&pair[0].1, TEXT_SIZE) + width(&pair[1].1, TEXT_SIZE));
                (pair[1].0 - pair[0].0) * length >= room + 7.0
            })
    });
    for tick in &mut ticks.major {
        if !inside(tick) {
            tick.1.clear();
        }
    }
    ticks
}

/// Vertical ticks for an axis `length` points long; labels that would stick out by more than `overhang` are left off.
pub fn y_ticks(scale: &Scale, length: f64, overhang: f64) -> Ticks {
    let mut ticks = scale.ticks(|labels| {
        labels
            .windows(2)
            .all(|pair| (pair[1].0 - pair[0].0) * length >= 2.0 * TEXT_SIZE)
    });
    let half = 0.5 * TEXT_SIZE;
    for (fraction, label) in &mut ticks.major {
        if *fraction * length < half - overhang || *fraction * length > length - half + overhang {
            label.clear();
        }
    }
    ticks
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
