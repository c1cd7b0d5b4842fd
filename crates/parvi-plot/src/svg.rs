//! A drawing that becomes an SVG document; all lengths in points, the origin at the top left.

use std::fmt::Write as _;

use super::style::{FONT_FAMILY, INK, MARKER_RADIUS, Marker, SeriesStyle};
use super::text::{Anchor, TextStyle, cut, escape, markup, number, plain_text};

/// A rectangle on the page.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rectangle {
    /// The left edge.
    pub x: f64,
    /// The top edge.
    pub y: f64,
    /// The extent to the right.
    pub width: f64,
    /// The extent downwards.
    pub height: f64,
}

impl Rectangle {
    /// A rectangle of this width and height with its top left corner there.
    pub fn at((x, y): (f64, f64), (width, height): (f64, f64)) -> Self {
        Self { x, y, width, height }
    }

    /// The right edge.
    pub fn right(&self) -> f64 {
        self.x + self.width
    }

    /// The bottom edge.
    pub fn bottom(&self) -> f64 {
        self.y + self.height
    }

    fn attributes(&self) -> String {
        format!(
            "x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"",
            number(self.x),
            number(self.y),
            number(self.width.max(0.0)),
            number(self.height.max(0.0))
        )
    }
}

/// How a line is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stroke<'a> {
    /// The colour.
    pub color: &'a str,
    /// The width.
    pub width: f64,
    /// The dash pattern, empty for a solid line.
    pub dash: &'a str,
}

impl<'a> Stroke<'a> {
    /// A solid line.
    pub const fn solid(color: &'a str, width: f64) -> Stroke<'a> {
        Stroke { color, width, dash: "" }
    }

    /// A dashed line.
    pub const fn dashed(color: &'a str, width: f64) -> Stroke<'a> {
        Stroke {
            color,
            width,
            dash: "4.5 2.5",
        }
    }

    fn attributes(&self) -> String {
        let mut text = format!("stroke=\"{}\" stroke-width=\"{}\"", self.color, number(self.width));
        if !self.dash.is_empty() {
            let _ = write!(text, " stroke-dasharray=\"{}\"", self.dash);
        }
        text
    }
}

/// An SVG document under construction.
#[derive(Debug, Clone)]
pub struct Drawing {
    title: String,
    body: String,
    clips: usize,
}

impl Drawing {
    /// An empty drawing; `title` names it to readers of the document tree, it is not drawn.
    pub fn new(title: &str) -> Drawing {
        Drawing {
            title: plain_text(title),
            body: String::new(),
            clips: 0,
        }
    }

    /// A straight line.
    pub fn line(&mut self, from: (f64, f64), to: (f64, f64), stroke: Stroke<'_>) {
        let _ = writeln!(
            self.body,
            "<path d=\"M{} {}L{} {}\" fill=\"none\" {}/>",
            number(from.0),
            number(from.1),
            number(to.0),
            number(to.1),
            stroke.attributes()
        );
    }

    /// Many straight lines with one stroke.
    pub fn lines(&mut self, segments: &[[(f64, f64); 2]], stroke: Stroke<'_>) {
        let paths: Vec<Vec<(f64, f64)>> = segments.iter().map(|ends| ends.to_vec()).collect();
        self.paths(&paths, stroke);
    }

    /// Polygonal lines with one stroke; a line whose last point equals its first is closed.
    pub fn paths(&mut self, paths: &[Vec<(f64, f64)>], stroke: Stroke<'_>) {
        let data: String = paths.iter().map(|path| path_data(path)).collect();
        if !data.is_empty() {
            let _ = writeln!(
                self.body,
                "<path d=\"{data}\" fill=\"none\" stroke-linejoin=\"round\" {}/>",
                stroke.attributes()
            );
        }
    }

    /// A filled rectangle.
    pub fn filled_rectangle(&mut self, area: Rectangle, fill: &str, opacity: f64) {
        self.rectangle(area, &format!("fill=\"{fill}\" fill-opacity=\"{}\"", number(opacity)));
    }

    /// The outline of a rectangle.
    pub fn frame(&mut self, area: Rectangle, stroke: Stroke<'_>) {
        self.rectangle(area, &format!("fill=\"none\" {}", stroke.attributes()));
    }

    fn rectangle(&mut self, area: Rectangle, paint: &str) {
        let _ = writeln!(self.body, "<rect {} {paint}/>", area.attributes());
    }

    /// A text whose baseline starts, ends or is centred at a point; `^{…}` and `_{…}` mark scripts.
    pub fn text(&mut self, at: (f64, f64), label: &str, style: TextStyle) {
        self.titled_text(at, (label, label), style);
    }

    /// The same with no more of it than fits into `room`; all of it is the title of the element, which viewers show at the pointer.
    pub fn fitted_text(&mut self, at: (f64, f64), label: &str, room: f64, style: TextStyle) {
        self.titled_text(at, (&cut(label, room, style.size), label), style);
    }

    /// What is shown of a text, which is the title of the element where it is another.
    pub fn titled_text(&mut self, at: (f64, f64), (label, whole): (&str, &str), style: TextStyle) {
        if label.is_empty() {
            return;
        }
        let title = match label == whole {
            true => String::new(),
            false => format!("<title>{}</title>", escape(&plain_text(whole))),
        };
        let (x, y) = (number(at.0), number(at.1));
        let anchor = match style.anchor {
            Anchor::Start => "",
            Anchor::Middle => " text-anchor=\"middle\"",
            Anchor::End => " text-anchor=\"end\"",
        };
        let weight = if style.bold { " font-weight=\"bold\"" } else { "" };
        let rotation = if style.upwards {
            format!(" transform=\"rotate(-90 {x} {y})\"")
        } else {
            String::new()
        };
        let _ = writeln!(
            self.body,
            "<text x=\"{x}\" y=\"{y}\" font-size=\"{}\"{anchor}{weight}{rotation}>{title}{}</text>",
            number(style.size),
            markup(label, style.size)
        );
    }

    /// Many discs of one size. Each of a few paths holds every n-th disc, so that overlapping ones darken each other while
    /// the document stays small.
    pub fn discs(&mut self, centres: &[(f64, f64)], radius: f64, color: &str, opacity: f64) {
        // Larger discs overlap sooner and get more layers.
        let members = (80.0 / (radius * radius)).clamp(4.0, 200.0) as usize;
        let layers = centres.len().div_ceil(members).clamp(1, 40);
        for layer in 0..layers {
            let mut data = String::new();
            for (x, y) in centres.iter().skip(layer).step_by(layers) {
                if x.is_finite() && y.is_finite() {
                    let _ = write!(data, "M{} {}h.01", number(*x), number(*y));
                }
            }
            if !data.is_empty() {
                let _ = writeln!(
                    self.body,
                    "<path d=\"{data}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"{}\" stroke-linecap=\"round\" stroke-opacity=\"{}\"/>",
                    number(2.0 * radius),
                    number(opacity)
                );
            }
        }
    }

    /// A data point.
    pub fn marker(&mut self, at: (f64, f64), style: SeriesStyle) {
        let r = MARKER_RADIUS;
        let polygon = |corners: &[(f64, f64)]| {
            let mut points: Vec<(f64, f64)> = corners
                .iter()
                .map(|corner| (at.0 + r * corner.0, at.1 + r * corner.1))
                .collect();
            points.push(points[0]);
            path_data(&points)
        };
        let filled = format!("fill=\"{}\" stroke=\"#fff\" stroke-width=\"0.4\"", style.color);
        let open = format!("fill=\"none\" stroke=\"{}\" stroke-width=\"1.3\"", style.color);
        let cross = |a: f64, b: f64| {
            path_data(&[(at.0 - a * r, at.1 - b * r), (at.0 + a * r, at.1 + b * r)])
                + &path_data(&[(at.0 - b * r, at.1 + a * r), (at.0 + b * r, at.1 - a * r)])
        };
        let (data, paint) = match style.marker {
            Marker::Square => (polygon(&[(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)]), filled),
            Marker::TriangleUp => (polygon(&[(0.0, -1.2), (1.1, 0.8), (-1.1, 0.8)]), filled),
            Marker::TriangleDown => (polygon(&[(0.0, 1.2), (1.1, -0.8), (-1.1, -0.8)]), filled),
            Marker::Diamond => (polygon(&[(0.0, -1.25), (1.25, 0.0), (0.0, 1.25), (-1.25, 0.0)]), filled),
            Marker::Plus => (cross(1.15, 0.0), open),
            Marker::Cross => (cross(0.9, 0.9), open),
            Marker::Circle | Marker::Ring => {
                let paint = if style.marker == Marker::Ring { open } else { filled };
                let _ = writeln!(
                    self.body,
                    "<circle cx=\"{}\" cy=\"{}\" r=\"{}\" {paint}/>",
                    number(at.0),
                    number(at.1),
                    number(r)
                );
                return;
            }
        };
        let _ = writeln!(self.body, "<path d=\"{data}\" {paint}/>");
    }

    /// Draws what `content` draws, cut off at the edges of `area`.
    pub fn clipped(&mut self, area: Rectangle, content: impl FnOnce(&mut Drawing)) {
        self.clips += 1;
        let _ = writeln!(
            self.body,
            "<clipPath id=\"panel{0}\"><rect {1}/></clipPath>\n<g clip-path=\"url(#panel{0})\">",
            self.clips,
            area.attributes(),
        );
        content(self);
        self.body.push_str("</g>\n");
    }

    /// The document with its final size.
    pub fn finish(self, width: f64, height: f64) -> String {
        let (width, height) = (number(width), number(height));
        let title = escape(&self.title);
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}pt\" height=\"{height}pt\" viewBox=\"0 0 {width} {height}\" font-family=\"{FONT_FAMILY}\" fill=\"{INK}\">\n<title>{title}</title>\n<rect width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>\n{}</svg>\n",
            self.body
        )
    }
}

/// Path data for a polygonal line, closed if its ends agree; points that are not finite are left out.
fn path_data(points: &[(f64, f64)]) -> String {
    let finite: Vec<&(f64, f64)> = points.iter().filter(|(x, y)| x.is_finite() && y.is_finite()).collect();
    let closed = finite.len() > 3 && finite.first() == finite.last();
    let open_end = finite.len() - usize::from(closed);
    let mut data = String::new();
    for (index, (x, y)) in finite[..open_end].iter().enumerate() {
        let command = if index == 0 { 'M' } else { 'L' };
        let _ = write!(data, "{command}{} {}", number(*x), number(*y));
    }
    if closed {
        data.push('Z');
    }
    data
}
