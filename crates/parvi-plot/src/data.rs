//! What the figures are drawn from, and what can be wrong with it.

use crate::statistics::{DensityGrid, StatisticsError, weighted_quantile};

use super::scale::{AxisKind, Scale, plottable};

/// Why a figure could not be drawn.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PlotError {
    /// There is nothing to draw.
    #[error("{what}: nothing to draw")]
    Empty {
        /// The input that is empty or holds no value that can be drawn.
        what: String,
    },
    /// Two inputs that belong together differ in size.
    #[error("{what}: expected length {expected}, found {found}")]
    Size {
        /// The input of the wrong size.
        what: String,
        /// The size that fits.
        expected: usize,
        /// The size found.
        found: usize,
    },
    /// The figure does not exist in this dimension.
    #[error("dimension {dimension} is not between {smallest} and {largest}")]
    Dimension {
        /// The dimension of the points.
        dimension: usize,
        /// The smallest dimension that the figure supports.
        smallest: usize,
        /// The largest one.
        largest: usize,
    },
    /// A coordinate is NaN, infinite or beyond 1e300.
    #[error("point {row}: x{} = {value} cannot be drawn", .axis + 1)]
    NotFinite {
        /// The point, counted from 0.
        row: usize,
        /// The coordinate, counted from 0; in messages from 1, as in files.
        axis: usize,
        /// The offending value.
        value: f64,
    },
    /// A statistic of the data does not exist, e.g. because all weights are zero.
    #[error(transparent)]
    Statistics(#[from] StatisticsError),
}

impl PlotError {
    /// Nothing of this kind can be drawn.
    pub(super) fn empty(what: &str) -> Self {
        Self::Empty { what: what.to_owned() }
    }
}

/// Weighted points in d dimensions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointCloud<'a> {
    /// The points, each of the same dimension.
    pub points: &'a [Vec<f64>],
    /// A non-negative weight per point; equal weights if `None`.
    pub weights: Option<&'a [f64]>,
}

impl<'a> PointCloud<'a> {
    /// Points with equal weights.
    pub fn equal(points: &'a [Vec<f64>]) -> PointCloud<'a> {
        PointCloud { points, weights: None }
    }

    /// Points with weights, where they differ.
    pub fn weighted(points: &'a [Vec<f64>], weights: Option<&'a [f64]>) -> PointCloud<'a> {
        PointCloud { points, weights }
    }

    /// The columns of the cloud after all checks: at least one point, one dimension between the bounds, coordinates that
    /// can be drawn, weights that fit.
    pub(super) fn columns(&self, smallest: usize, largest: usize) -> Result<Vec<Vec<f64>>, PlotError> {
        let Some(first) = self.points.first() else {
            return Err(PlotError::empty("points"));
        };
        let dimension = first.len();
        if !(smallest..=largest).contains(&dimension) {
            return Err(PlotError::Dimension {
                dimension,
                smallest,
                largest,
            });
        }
        let mut columns = vec![Vec::with_capacity(self.points.len()); dimension];
        for (row, point) in self.points.iter().enumerate() {
            check_size(|| format!("point {row}"), dimension, point.len())?;
            for (axis, &value) in point.iter().enumerate() {
                if !plottable(value) {
                    return Err(PlotError::NotFinite { row, axis, value });
                }
                columns[axis].push(value);
            }
        }
        crate::statistics::check_weighted("points", &columns[0], self.weights)?;
        Ok(columns)
    }
}

/// A curve y(x), e.g. a marginal density.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Curve {
    /// The ascending abscissas.
    pub x: Vec<f64>,
    /// The values.
    pub y: Vec<f64>,
}

/// The joint density of two coordinates.
#[derive(Debug, Clone, PartialEq)]
pub struct PairDensity {
    /// The coordinate along the horizontal axis.
    pub horizontal: usize,
    /// The coordinate along the vertical axis; larger than `horizontal`.
    pub vertical: usize,
    /// The density up to a factor.
    pub grid: DensityGrid,
}

/// What the particles are compared with.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Reference<'a> {
    /// Nothing.
    #[default]
    None,
    /// Reference draws, turned into densities by kernel estimates.
    Draws(PointCloud<'a>),
    /// Densities that the caller evaluated.
    Exact {
        /// The marginal density of each coordinate, normalised; empty if none is known.
        marginals: &'a [Option<Curve>],
        /// Joint densities of pairs of coordinates, in any order.
        pairs: &'a [PairDensity],
    },
}

/// Particles beside the density that they are compared with: what a histogram, a corner plot and a cloud are drawn from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DensityPlot<'a> {
    /// The title; empty for none.
    pub title: &'a str,
    /// The particles with their weights.
    pub particles: PointCloud<'a>,
    /// The label of each coordinate, with its unit; empty for x₁ … x_d.
    pub labels: &'a [String],
    /// The density to compare with; its joint densities become contours, its marginals curves.
    pub reference: Reference<'a>,
    /// The text in the legend for the reference; empty for "target".
    pub reference_label: &'a str,
}

/// The same after its checks.
pub(super) struct CheckedPlot<'a> {
    pub columns: Vec<Vec<f64>>,
    pub labels: Vec<String>,
    pub reference: CheckedReference<'a>,
    /// One scale per coordinate.
    pub scales: Vec<Scale>,
}

impl<'a> DensityPlot<'a> {
    /// Labelled coordinates of particles beside a density, without words of its own.
    pub fn new(particles: PointCloud<'a>, labels: &'a [String], reference: Reference<'a>) -> Self {
        Self {
            title: "",
            particles,
            labels,
            reference,
            reference_label: "",
        }
    }

    /// Checks everything, the dimension between bounds.
    pub(super) fn check(&self, smallest: usize, largest: usize) -> Result<CheckedPlot<'a>, PlotError> {
        let columns = self.particles.columns(smallest, largest)?;
        let labels = coordinate_labels(self.labels, columns.len())?;
        let reference = self.reference.check(columns.len())?;
        let scale = |(axis, column): (usize, &Vec<f64>)| reference.scale(axis, column, self.particles.weights);
        let scales = columns.iter().enumerate().map(scale).collect::<Result<_, _>>()?;
        Ok(CheckedPlot {
            columns,
            labels,
            reference,
            scales,
        })
    }
}

/// The reference after its checks.
pub(super) struct CheckedReference<'a> {
    pub given: Reference<'a>,
    /// The columns of its draws; empty without any.
    pub draws: Vec<Vec<f64>>,
}

impl<'a> Reference<'a> {
    /// Checks the reference against the dimension of the particles.
    pub(super) fn check(&self, dimension: usize) -> Result<CheckedReference<'a>, PlotError> {
        let mut draws = Vec::new();
        match *self {
            Reference::None => {}
            Reference::Draws(cloud) => draws = cloud.columns(dimension, dimension)?,
            Reference::Exact { marginals, pairs } => {
                if !marginals.is_empty() {
                    check_size(|| "marginals".to_string(), dimension, marginals.len())?;
                }
                for (axis, curve) in marginals.iter().enumerate() {
                    if let Some(curve) = curve {
                        check_size(|| format!("marginal {axis}"), curve.x.len(), curve.y.len())?;
                    }
                }
                for pair in pairs {
                    let grid = &pair.grid;
                    check_size(
                        || format!("density of ({}, {})", pair.horizontal, pair.vertical),
                        grid.x.len() * grid.y.len(),
                        grid.values.len(),
                    )?;
                }
            }
        }
        Ok(CheckedReference { given: *self, draws })
    }
}

impl CheckedReference<'_> {
    /// The interval of coordinate `axis` that the figure should show for the reference's sake.
    fn interval(&self, axis: usize) -> Result<Option<(f64, f64)>, PlotError> {
        match self.given {
            Reference::None => Ok(None),
            Reference::Draws(cloud) => {
                // The extremes of many draws say little about where the density is.
                let levels = weighted_quantile(&self.draws[axis], cloud.weights, &[0.001, 0.999])?;
                Ok(Some((levels[0], levels[1])))
            }
            Reference::Exact { marginals, pairs } => {
                if let Some(Some(curve)) = marginals.get(axis) {
                    return Ok(support(&curve.x, |index| curve.y[index]));
                }
                let pair = pairs
                    .iter()
                    .find(|pair| pair.horizontal == axis || pair.vertical == axis);
                Ok(pair.and_then(|pair| {
                    let (grid, columns) = (&pair.grid, pair.grid.x.len());
                    let largest = |nodes: &mut dyn Iterator<Item = usize>| {
                        nodes.map(|node| grid.values[node]).fold(0.0, f64::max)
                    };
                    if pair.horizontal == axis {
                        support(&grid.x, |column| {
                            largest(&mut (0..grid.y.len()).map(|row| row * columns + column))
                        })
                    } else {
                        support(&grid.y, |row| {
                            largest(&mut (0..columns).map(|column| row * columns + column))
                        })
                    }
                }))
            }
        }
    }

    /// The scale of coordinate `axis` for particles and reference together.
    pub(super) fn scale(&self, axis: usize, column: &[f64], weights: Option<&[f64]>) -> Result<Scale, PlotError> {
        let (mut low, mut high) = core_interval(column, weights)?;
        if let Some(interval) = self.interval(axis)? {
            low = low.min(interval.0);
            high = high.max(interval.1);
        }
        Ok(Scale::around([low, high], AxisKind::Linear, 0.05))
    }
}

/// The interval between the extremes, or, where far points would stretch that beyond 1.6 times the interval between the
/// quantiles at 0.2 and 99.8 %, the latter with a tenth on both sides.
fn core_interval(values: &[f64], weights: Option<&[f64]>) -> Result<(f64, f64), PlotError> {
    let levels = weighted_quantile(values, weights, &[0.0, 0.002, 0.998, 1.0])?;
    let core = levels[2] - levels[1];
    if levels[3] - levels[0] <= 1.6 * core {
        return Ok((levels[0], levels[3]));
    }
    Ok((
        (levels[1] - 0.1 * core).max(levels[0]),
        (levels[2] + 0.1 * core).min(levels[3]),
    ))
}

/// The interval of `nodes` on which `density` exceeds a five-hundredth of its largest value.
fn support(nodes: &[f64], density: impl Fn(usize) -> f64) -> Option<(f64, f64)> {
    let values: Vec<f64> = (0..nodes.len()).map(density).collect();
    let threshold = values
        .iter()
        .copied()
        .filter(|value| plottable(*value))
        .fold(0.0, f64::max)
        / 500.0;
    let above = |index: &usize| values[*index] > threshold && plottable(nodes[*index]);
    let first = (0..nodes.len()).find(above)?;
    let last = (0..nodes.len()).rev().find(above)?;
    Some((nodes[first], nodes[last]))
}

/// The labels of d coordinates, x₁ … x_d if none are given.
pub(super) fn coordinate_labels(labels: &[String], dimension: usize) -> Result<Vec<String>, PlotError> {
    if labels.is_empty() {
        return Ok((1..=dimension).map(|axis| format!("x_{{{axis}}}")).collect());
    }
    check_size(|| "labels".to_string(), dimension, labels.len())?;
    Ok(labels.to_vec())
}

/// Checks a size; `what` names the input in the error.
pub(super) fn check_size(what: impl FnOnce() -> String, expected: usize, found: usize) -> Result<(), PlotError> {
    if expected == found {
        return Ok(());
    }
    Err(PlotError::Size {
        what: what(),
        expected,
        found,
    })
}
