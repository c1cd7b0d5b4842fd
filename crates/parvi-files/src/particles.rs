//! Particles whose dimension is known at run time, as files hold them.

use parvi::Samples;

/// The name of the column of weights.
pub const WEIGHT: &str = "weight";
/// The name of the column of log p.
pub const LOG_DENSITY: &str = "log_density";

/// M points in d dimensions, row by row, with weights where they differ, and log p where it is noted.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Particles {
    dimension: usize,
    coordinates: Vec<f64>,
    weights: Option<Vec<f64>>,
    log_densities: Option<Vec<f64>>,
}

impl Particles {
    /// From points of compile-time dimension.
    pub fn new<const D: usize>(positions: &[[f64; D]], weights: Option<&[f64]>) -> Self {
        Self {
            dimension: D,
            coordinates: positions.as_flattened().to_vec(),
            weights: weights.map(<[f64]>::to_vec),
            log_densities: None,
        }
    }

    /// From the coordinates of all points, one point after the other; an incomplete last point is dropped.
    pub fn from_coordinates(dimension: usize, mut coordinates: Vec<f64>, weights: Option<Vec<f64>>) -> Self {
        let dimension = dimension.max(1);
        coordinates.truncate(coordinates.len() / dimension * dimension);
        Self {
            dimension,
            coordinates,
            weights,
            log_densities: None,
        }
    }

    /// The same with log p at every point.
    pub fn with_log_densities(self, log_densities: Vec<f64>) -> Self {
        Self {
            log_densities: Some(log_densities),
            ..self
        }
    }

    /// d.
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// M.
    pub fn len(&self) -> usize {
        self.coordinates.len() / self.dimension.max(1)
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.coordinates.is_empty()
    }

    /// The points, as slices of length d.
    pub fn rows(&self) -> impl Iterator<Item = &[f64]> {
        self.coordinates.chunks_exact(self.dimension.max(1))
    }

    /// The points, as figures take them.
    pub fn to_rows(&self) -> Vec<Vec<f64>> {
        self.rows().map(<[f64]>::to_vec).collect()
    }

    /// All coordinates, one point after the other.
    pub fn coordinates(&self) -> &[f64] {
        &self.coordinates
    }

    /// Weights that sum to one; `None` when all are equal.
    pub fn weights(&self) -> Option<&[f64]> {
        self.weights.as_deref()
    }

    /// log p at the points, where it is noted; −∞ where it is not a number to count with.
    pub fn log_densities(&self) -> Option<&[f64]> {
        self.log_densities.as_deref()
    }

    /// What stands beside the coordinates, as names with one value per point: the weights where they differ, then log p where it is noted.
    pub fn further_columns(&self) -> Vec<(&'static str, &[f64])> {
        let weights = self.weights().map(|values| (WEIGHT, values));
        let log_densities = self.log_densities().map(|values| (LOG_DENSITY, values));
        weights.into_iter().chain(log_densities).collect()
    }

    /// The points as arrays; `None` if the dimension is another.
    pub fn points<const D: usize>(&self) -> Option<Vec<[f64; D]>> {
        (D == self.dimension).then(|| self.coordinates.as_chunks::<D>().0.to_vec())
    }

    /// The first value that is not finite.
    pub fn first_not_finite(&self) -> Option<f64> {
        let weights = self.weights.iter().flatten();
        let mut all = self.coordinates.iter().chain(weights).copied();
        all.find(|value| !value.is_finite())
    }
}

impl<const D: usize> From<&Samples<D>> for Particles {
    fn from(samples: &Samples<D>) -> Self {
        Self::new(&samples.positions, samples.weights.as_deref())
    }
}
