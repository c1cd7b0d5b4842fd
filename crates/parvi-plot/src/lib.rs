#![doc = include_str!("../README.md")]
//!
//! ## Where to begin
//!
//! With [`multiples`], lines over one pair of axes or several, and [`histogram`]. All figures share [`style`] and a small drawing layer: `svg` for the
//! document, `scale` and `panel` for axes, `legend`, `contour` for lines of equal density. [`page`] puts figures and tables into Markdown, [`results`] are the rows that they are made of, [`judgement`] is
//! what is asked of them. It is no general plotting
//! library, and knows nothing of samplers and files.

mod chart;
mod chart_panel;
mod cloud;
mod contour;
mod corner;
mod data;
mod density_panel;
mod dots;
mod heat_map;
mod histogram;
pub mod judgement;
mod legend;
mod line_series;
mod multiples;
pub mod page;
mod panel;
mod panel_grid;
pub mod results;
mod scale;
mod scaling;
mod series;
mod snapshots;
pub mod statistics;
mod strip;
pub mod style;
mod svg;
mod text;
mod time_error;
mod trace;

pub use cloud::cloud;
pub use corner::corner;
pub use data::{Curve, DensityPlot, PairDensity, PlotError, PointCloud, Reference};
pub use dots::{DotPlot, DotSeries, dots};
pub use heat_map::{CellAxis, HeatMapPlot, HeatPanel, cell_of, heat_map, logarithmic_edges};
pub use histogram::histogram;
pub use line_series::{GuideCurve, LineSeries};
pub use multiples::{Look, MultiplesPanel, MultiplesPlot, multiples};
pub use scale::{Axis, AxisKind};
pub use scaling::{ScalingPlot, exponent_text, scaling};
pub use series::ReferenceLevel;
pub use snapshots::{SnapshotPanel, SnapshotsPlot, snapshots};
pub use strip::{StripPanel, StripPlot, moments, strip};
pub use time_error::{TimeErrorCurve, TimeErrorPanel, time_error};
pub use trace::TraceQuantity;
