//! Figures: each a function from plain data to an SVG document, in one style.
//!
//! All figures share [`style`] (sizes in points at print size, a colour-blind-safe palette, a fixed colour and marker per
//! method) and a small drawing layer: [`svg`] for the document, [`scale`] and [`panel`] for axes, [`legend`], [`contour`] for
//! lines of equal density. Labels may hold `^{…}` and `_{…}` for superscripts and subscripts. The same data gives the same
//! bytes; no figure contains NaN; input that cannot be drawn is a [`PlotError`].

mod chart;
mod chart_panel;
pub mod cloud;
pub mod contour;
pub mod corner;
pub mod data;
mod density_panel;
pub mod dots;
pub mod heat_map;
pub mod histogram;
pub mod legend;
pub mod line;
pub mod multiples;
pub mod panel;
pub mod scale;
pub mod scaling;
pub mod snapshots;
pub mod strip;
pub mod style;
pub mod svg;
pub mod text;
pub mod time_error;
pub mod trace;

#[cfg(test)]
mod tests;

pub use cloud::{CloudPlot, cloud};
pub use corner::{CornerPlot, corner};
pub use data::{Curve, PairDensity, PlotError, PointCloud, Reference};
pub use dots::{DotPlot, DotRow, DotSeries, dots};
pub use heat_map::{HeatMapPlot, HeatPanel, heat_map};
pub use histogram::{HistogramPlot, histogram};
pub use line::{LinePlot, LineSeries, ReferenceLevel, line};
pub use multiples::{GuideCurve, MultiplesPanel, MultiplesPlot, multiples};
pub use scale::AxisKind;
pub use scaling::{ScalingGuide, ScalingPlot, ScalingSeries, exponent_text, scaling, scaling_fit};
pub use snapshots::{SnapshotPanel, SnapshotsPlot, snapshots};
pub use strip::{StripPanel, StripPlot, strip};
pub use time_error::{Spread, TimeErrorCurve, TimeErrorPanel, TimeErrorPlot, TimeErrorPoint, time_error};
pub use trace::{TracePanel, TracePlot, TraceSeries, trace};
