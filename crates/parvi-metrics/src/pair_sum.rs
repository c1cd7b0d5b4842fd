//! Σ_ij w_i u_j f(x_i, y_j) over all pairs: tiled, vectorised, parallel, and the same bits on any number of threads.
//!
//! Rows are summed four columns at a time in a fixed order, tiles of [`TILE`] × [`TILE`] pairs are added with
//! compensation, so the error of a mean of N² positive terms stays near 1e-15 of its value for any N.

use crate::Cloud;
use crate::lanes::{LANES, Lanes, reduce};
use crate::summation::{CompensatedSum, parallel_sum};

/// Rows and columns of a tile: small enough for the first-level cache in six dimensions.
const TILE: usize = 128;
/// Groups of lanes per tile.
const TILE_GROUPS: usize = TILE / LANES;

/// Vectors in groups of four, axis by axis: `groups[g][axis][lane]` is the coordinate of vector `g · 4 + lane`.
///
/// The last group is padded with a vector of its own, so that padding causes no overflow of its own.
#[derive(Clone, Debug)]
pub(crate) struct Packed<const D: usize> {
    groups: Vec<[Lanes; D]>,
}

impl<const D: usize> Packed<D> {
    /// Packs `vectors`.
    pub(crate) fn new(vectors: &[[f64; D]]) -> Self {
        let groups = vectors
            .chunks(LANES)
            .map(|chunk| {
                let vector = |lane: usize| &chunk[if lane < chunk.len() { lane } else { 0 }];
                std::array::from_fn(|axis| std::array::from_fn(|lane| vector(lane)[axis]))
            })
            .collect();
        Self { groups }
    }

    /// Group `group`.
    #[inline]
    pub(crate) fn group(&self, group: usize) -> &[Lanes; D] {
        &self.groups[group]
    }
}

/// |x − y_j|² for the four points of a group.
#[inline]
pub(crate) fn squared_distances<const D: usize>(x: &[f64; D], group: &[Lanes; D]) -> Lanes {
    let mut squares = [0.0; LANES];
    for axis in 0..D {
        for lane in 0..LANES {
            let difference = x[axis] - group[axis][lane];
            squares[lane] += difference * difference;
        }
    }
    squares
}

/// The function under the double sum; it holds the points itself.
pub(crate) trait PairFunction: Sync {
    /// What is kept at hand along a row, e.g. the point x_i.
    type Row;
    /// The row's data.
    fn row(&self, index: usize) -> Self::Row;
    /// f(x_i, y_j) for the four points j of a group; the values of padding must be finite, they are multiplied by 0.
    fn evaluate(&self, row: &Self::Row, group: usize) -> Lanes;
}

/// A function of the squared distance |x_i − y_j|².
pub(crate) struct OfDistance<'a, F, const D: usize> {
    pub rows: &'a [[f64; D]],
    pub columns: &'a Packed<D>,
    pub function: F,
}

impl<F: Fn(Lanes) -> Lanes + Sync, const D: usize> PairFunction for OfDistance<'_, F, D> {
    type Row = [f64; D];

    #[inline]
    fn row(&self, index: usize) -> [f64; D] {
        self.rows[index]
    }

    #[inline]
    fn evaluate(&self, x: &[f64; D], group: usize) -> Lanes {
        (self.function)(squared_distances(x, self.columns.group(group)))
    }
}

/// Normalised weights of rows or columns, padded with zeros to whole groups.
#[derive(Clone, Debug)]
pub(crate) struct PackedWeights {
    count: usize,
    lanes: Vec<Lanes>,
}

impl PackedWeights {
    /// The weights of a cloud.
    pub(crate) fn new<const D: usize>(cloud: &Cloud<'_, D>) -> Self {
        let count = cloud.len();
        let group = |g: usize| std::array::from_fn(|lane| cloud.weight(g * LANES + lane));
        Self {
            count,
            lanes: (0..count.div_ceil(LANES)).map(group).collect(),
        }
    }

    fn tiles(&self) -> usize {
        self.count.div_ceil(TILE)
    }
}

/// The weighted sum over one tile of rows and columns.
fn tile_sum(
    function: &impl PairFunction,
    (rows, row_tile): (&PackedWeights, usize),
    (columns, column_tile): (&PackedWeights, usize),
) -> f64 {
    let first = column_tile * TILE_GROUPS;
    let column_weights = &columns.lanes[first..columns.lanes.len().min(first + TILE_GROUPS)];
    let mut total = [0.0; LANES];
    for index in row_tile * TILE..rows.count.min((row_tile + 1) * TILE) {
        let row = function.row(index);
        let mut sums = [0.0; LANES];
        for (offset, weights) in column_weights.iter().enumerate() {
            let values = function.evaluate(&row, first + offset);
            for lane in 0..LANES {
                sums[lane] += weights[lane] * values[lane];
            }
        }
        let weight = rows.lanes[index / LANES][index % LANES];
        for lane in 0..LANES {
            total[lane] += weight * sums[lane];
        }
    }
    reduce(&total)
}

/// Σ_i Σ_j w_i u_j f(x_i, y_j).
pub(crate) fn cross_sum(function: &impl PairFunction, rows: &PackedWeights, columns: &PackedWeights) -> f64 {
    parallel_sum(rows.tiles(), |row_tile| {
        let mut total = CompensatedSum::default();
        for column_tile in 0..columns.tiles() {
            total.add(tile_sum(function, (rows, row_tile), (columns, column_tile)));
        }
        total.value()
    })
}

/// Σ_i Σ_j w_i w_j f(x_i, x_j), the diagonal included, for a symmetric f: tiles below the diagonal are not computed.
pub(crate) fn symmetric_sum(function: &impl PairFunction, weights: &PackedWeights) -> f64 {
    parallel_sum(weights.tiles(), |row_tile| {
        let mut total = CompensatedSum::default();
        total.add(tile_sum(function, (weights, row_tile), (weights, row_tile)));
        for column_tile in row_tile + 1..weights.tiles() {
            total.add(2.0 * tile_sum(function, (weights, row_tile), (weights, column_tile)));
        }
        total.value()
    })
}
