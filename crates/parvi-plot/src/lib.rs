//! Figures: each a function from plain data to an SVG document, in one style; and the [`statistics`] that they show.
//!
//! For figures of particles, of errors and costs, and of runs. It is no general plotting library, and knows nothing of samplers, files or
//! reports. Begin with [`multiples()`](multiples::multiples), lines over one pair of axes or several, and with [`histogram()`](histogram::histogram).
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
pub mod multiples;
pub mod panel;
pub mod scale;
pub mod scaling;
mod series;
pub mod snapshots;
pub mod statistics;
pub mod strip;
pub mod style;
pub mod svg;
pub mod text;
pub mod time_error;
pub mod trace;

#[cfg(test)]
mod tests;

pub use cloud::cloud;
pub use corner::corner;
pub use data::{Curve, DensityPlot, PairDensity, PlotError, PointCloud, Reference};
pub use dots::{DotPlot, DotRow, DotSeries, dots};
pub use heat_map::{HeatMapPlot, HeatPanel, heat_map};
pub use histogram::histogram;
pub use multiples::{GuideCurve, LineSeries, MultiplesPanel, MultiplesPlot, multiples};
pub use scale::AxisKind;
pub use scaling::{ScalingPlot, exponent_text, scaling, scaling_fit};
pub use series::ReferenceLevel;
pub use snapshots::{SnapshotPanel, SnapshotsPlot, snapshots};
pub use strip::{StripPanel, StripPlot, strip};
pub use time_error::{TimeErrorCurve, TimeErrorPanel, TimeErrorPlot, TimeErrorPoint, time_error};
pub use trace::{TracePanel, TracePlot, TraceSeries, trace};
