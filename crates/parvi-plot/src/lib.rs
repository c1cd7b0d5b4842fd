#![doc = include_str!("../README.md")]
//!
//! ## Where to begin
//!
//! With [`multiples()`](multiples::multiples), lines over one pair of axes or several, and [`histogram()`](histogram::histogram). All figures share [`style`]
//! and a small drawing layer: [`svg`] for the document, [`scale`] and [`panel`] for axes, [`legend`], [`contour`] for lines of equal density. It is no general
//! plotting library, and knows nothing of samplers, files or reports.

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
