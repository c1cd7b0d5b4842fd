//! The look that all figures share: sizes in points at print size, colours, markers and their meaning.

/// Font families in order of preference.
pub const FONT_FAMILY: &str = "'DejaVu Sans', Helvetica, Arial, sans-serif";
/// Font size of tick labels and legends.
pub const TEXT_SIZE: f64 = 9.0;
/// Font size of axis labels and panel titles.
pub const LABEL_SIZE: f64 = 10.0;
/// Font size of a figure's title.
pub const TITLE_SIZE: f64 = 11.0;
/// The width of a figure: the text width of an A4 or letter page.
pub const FIGURE_WIDTH: f64 = 504.0;
/// The space between a figure's content and its edge.
pub const MARGIN: f64 = 6.0;
/// Line width of axes and ticks.
pub const AXIS_WIDTH: f64 = 0.8;
/// Line width of data.
pub const LINE_WIDTH: f64 = 1.4;
/// Length of a major tick.
pub const MAJOR_TICK: f64 = 4.0;
/// Length of a minor tick.
pub const MINOR_TICK: f64 = 2.2;
/// Half the size of a marker.
pub const MARKER_RADIUS: f64 = 2.7;

/// The colour of axes and text.
pub const INK: &str = "#1a1a1a";
/// The colour of grid lines.
pub const GRID: &str = "#e6e6e6";
/// The colour of the particles in histograms and scatter panels.
pub const PARTICLES: &str = "#0072b2";
/// The colour of the particles' kernel density estimate.
pub const ESTIMATE: &str = "#d55e00";
/// The colour of the exact or reference density.
pub const REFERENCE: &str = "#000000";
/// The colour of guides such as the level of independent draws.
pub const GUIDE: &str = "#6b6b6b";

/// The colours of Okabe & Ito (2008), distinguishable with any common colour-vision deficiency; its yellow, which is too
/// pale for lines on white, is left out and grey added.
pub const PALETTE: [&str; 8] = [
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#7a7a7a",
];

/// The shape of a data point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Marker {
    /// A filled disc.
    Circle,
    /// A filled square.
    Square,
    /// A filled triangle that points up.
    TriangleUp,
    /// A filled square on its corner.
    Diamond,
    /// A filled triangle that points down.
    TriangleDown,
    /// A plus sign.
    Plus,
    /// A diagonal cross.
    Cross,
    /// An empty circle.
    Ring,
}

/// All markers, in the order in which series take them.
pub const MARKERS: [Marker; 8] = [
    Marker::Circle,
    Marker::Square,
    Marker::TriangleUp,
    Marker::Diamond,
    Marker::TriangleDown,
    Marker::Plus,
    Marker::Cross,
    Marker::Ring,
];

/// The colour and the marker of a series.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SeriesStyle {
    /// The colour as `#rrggbb`.
    pub color: &'static str,
    /// The shape of the points.
    pub marker: Marker,
}

/// The style of the series number `index`, counted from 0: e.g. d = 1 … 6 in every figure that compares dimensions. Sixty-four
/// combinations before one repeats.
pub fn sequence_style(index: usize) -> SeriesStyle {
    let turn = index / PALETTE.len();
    SeriesStyle {
        color: PALETTE[index % PALETTE.len()],
        marker: MARKERS[(index + turn) % MARKERS.len()],
    }
}

/// The style of a method, the same in every figure; `None` for names without a fixed one.
pub fn method_style(method: &str) -> Option<SeriesStyle> {
    let (color, marker) = match method {
        "mpm" => (PALETTE[0], Marker::Circle),
        "paper-pic" => (PALETTE[1], Marker::Square),
        "paper-apic" => (PALETTE[4], Marker::Diamond),
        "svgd" => (PALETTE[2], Marker::TriangleUp),
        "sobol" => (PALETTE[5], Marker::TriangleDown),
        "iid" => (PALETTE[7], Marker::Cross),
        "nuts" => (PALETTE[3], Marker::Plus),
        "ais" => (PALETTE[1], Marker::Plus),
        "reference" => (PALETTE[6], Marker::Ring),
        _ => return None,
    };
    Some(SeriesStyle { color, marker })
}

/// Styles for settings of two numbers each: colours tell the first numbers apart, markers the second ones.
pub fn crossed_styles(settings: &[[f64; 2]]) -> Vec<SeriesStyle> {
    let mut known = [Vec::new(), Vec::new()];
    let mut place = |axis: usize, value: f64| {
        let known: &mut Vec<f64> = &mut known[axis];
        known.iter().position(|known| *known == value).unwrap_or_else(|| {
            known.push(value);
            known.len() - 1
        })
    };
    let style = |&[first, second]: &[f64; 2]| SeriesStyle {
        color: PALETTE[place(0, first) % PALETTE.len()],
        marker: MARKERS[place(1, second) % MARKERS.len()],
    };
    settings.iter().map(style).collect()
}

/// Styles for the names of one figure's series: methods keep their own, the others take unused combinations in order, so
/// that no two names share one.
pub fn styles(names: &[&str]) -> Vec<SeriesStyle> {
    let mut taken: Vec<SeriesStyle> = names.iter().filter_map(|n| method_style(n)).collect();
    let mut next = 0;
    names
        .iter()
        .map(|name| {
            method_style(name).unwrap_or_else(|| {
                // Prefer a fresh colour; with eight taken, a fresh combination of colour and marker.
                let free = |style: &SeriesStyle| {
                    !taken.contains(style)
                        && (taken.len() >= PALETTE.len() || taken.iter().all(|other| other.color != style.color))
                };
                let style = (next..next + 2 * PALETTE.len() * MARKERS.len())
                    .map(sequence_style)
                    .find(free)
                    .unwrap_or_else(|| sequence_style(next));
                next += 1;
                taken.push(style);
                style
            })
        })
        .collect()
}
