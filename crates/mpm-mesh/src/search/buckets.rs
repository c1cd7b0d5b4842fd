//! Cells by the boxes of a uniform grid that they reach into.

use crate::SimplexMesh;

/// Boxes of cells are made wider by this share of an edge of a bucket, against rounding.
const MARGIN: f64 = 1e-6;

/// A uniform grid over the mesh with about as many buckets as there are cells; a bucket lists the cells whose boxes touch it, in
/// ascending order.
#[derive(Clone, Debug)]
pub(super) struct Buckets<const D: usize> {
    low: [f64; D],
    /// Buckets per length.
    density: f64,
    counts: [usize; D],
    starts: Vec<u32>,
    cells: Vec<u32>,
}

impl<const D: usize> Buckets<D> {
    pub fn new(mesh: &SimplexMesh<D>) -> Self {
        let (mut low, mut high) = ([f64::INFINITY; D], [f64::NEG_INFINITY; D]);
        for x in mesh.vertices() {
            for a in 0..D {
                (low[a], high[a]) = (low[a].min(x[a]), high[a].max(x[a]));
            }
        }
        let extents: [f64; D] = std::array::from_fn(|a| high[a] - low[a]);
        let volume: f64 = extents.iter().product();
        let edge = (volume / mesh.cell_count() as f64).powf(1.0 / D as f64);
        let mut buckets = Self {
            low: std::array::from_fn(|a| low[a] - MARGIN * edge),
            density: 1.0 / edge,
            counts: extents.map(|extent| (extent / edge + 2.0 * MARGIN) as usize + 1),
            starts: Vec::new(),
            cells: Vec::new(),
        };
        let size: usize = buckets.counts.iter().product();
        let mut starts = vec![0u32; size + 1];
        for cell in 0..mesh.cell_count() {
            buckets.for_each_of(mesh, cell, |bucket| starts[bucket + 1] += 1);
        }
        for k in 0..size {
            starts[k + 1] += starts[k];
        }
        let mut cursors = starts.clone();
        let mut cells = vec![0; starts[size] as usize];
        for cell in 0..mesh.cell_count() {
            buckets.for_each_of(mesh, cell, |bucket| {
                cells[cursors[bucket] as usize] = cell as u32;
                cursors[bucket] += 1;
            });
        }
        (buckets.starts, buckets.cells) = (starts, cells);
        buckets
    }

    /// The cells that may hold `x`; `None` outside the grid.
    #[inline]
    pub fn at(&self, x: &[f64; D]) -> Option<&[u32]> {
        let mut bucket = 0;
        for a in 0..D {
            let u = (x[a] - self.low[a]) * self.density;
            if !(u >= 0.0 && u < self.counts[a] as f64) {
                return None;
            }
            bucket = bucket * self.counts[a] + u as usize;
        }
        Some(&self.cells[self.starts[bucket] as usize..self.starts[bucket + 1] as usize])
    }

    /// Visit the buckets that the box of a cell touches.
    fn for_each_of(&self, mesh: &SimplexMesh<D>, cell: usize, visit: impl FnMut(usize)) {
        let (mut low, mut high) = ([f64::INFINITY; D], [f64::NEG_INFINITY; D]);
        for &vertex in mesh.cell(cell) {
            let x = &mesh.vertices()[vertex as usize];
            for a in 0..D {
                (low[a], high[a]) = (low[a].min(x[a]), high[a].max(x[a]));
            }
        }
        self.for_each_in(&low, &high, visit);
    }

    /// Visit the buckets that a box touches.
    pub fn for_each_in(&self, low: &[f64; D], high: &[f64; D], mut visit: impl FnMut(usize)) {
        let last: [usize; D] = self.counts.map(|count| count - 1);
        let place = |c: f64, a: usize| (((c - self.low[a]) * self.density).max(0.0) as usize).min(last[a]);
        let margin = MARGIN / self.density;
        let first: [usize; D] = std::array::from_fn(|a| place(low[a] - margin, a));
        let end: [usize; D] = std::array::from_fn(|a| place(high[a] + margin, a));
        let mut at = first;
        loop {
            visit((0..D).fold(0, |bucket, a| bucket * self.counts[a] + at[a]));
            let Some(axis) = (0..D).rev().find(|&a| at[a] < end[a]) else {
                return;
            };
            at[axis] += 1;
            at[axis + 1..].copy_from_slice(&first[axis + 1..]);
        }
    }

    /// The cells of a bucket, ascending.
    pub fn cells(&self, bucket: usize) -> &[u32] {
        &self.cells[self.starts[bucket] as usize..self.starts[bucket + 1] as usize]
    }

    pub fn storage_bytes(&self) -> usize {
        (self.starts.capacity() + self.cells.capacity()) * 4
    }
}
