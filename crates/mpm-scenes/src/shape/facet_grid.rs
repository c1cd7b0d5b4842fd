//! Facets of a mesh's boundary by the boxes of a grid.

use mpm_mesh::{CellSearch, NO_CELL};

use super::Bounds;

/// A uniform grid over all that is within reach of a mesh, with about as many boxes as the mesh has cells. A box lists the facets that are within
/// reach of one of its points, and maybe others near; no facet goes through a box without any, so it is wholly inside the mesh or outside.
#[derive(Debug)]
pub(super) struct FacetGrid<const D: usize> {
    low: [f64; D],
    /// Boxes per length.
    density: f64,
    counts: [usize; D],
    /// Where the facets of a box begin in the list.
    starts: Vec<u32>,
    facets: Vec<u32>,
    /// The cell of the mesh that the middle of a box is in.
    cells: Vec<u32>,
}

/// What the grid knows of a point.
pub(super) enum Near<'a> {
    /// No facet is within reach.
    None { inside: bool },
    /// These may be; and a cell not far away, or none.
    Facets(&'a [u32], u32),
}

impl<const D: usize> FacetGrid<D> {
    /// Of facets with these corners, which bound the mesh of the search.
    pub fn new(search: &CellSearch<D>, facets: &[[[f64; D]; D]], reach: f64) -> Self {
        let (low, high) = bounds(search.mesh().vertices(), reach);
        let extents: [f64; D] = std::array::from_fn(|a| high[a] - low[a]);
        let volume: f64 = extents.iter().product();
        let edge = (volume / search.mesh().cell_count() as f64).powf(1.0 / D as f64);
        let mut grid = Self {
            low,
            density: 1.0 / edge,
            counts: extents.map(|extent| (extent / edge) as usize + 1),
            starts: Vec::new(),
            facets: Vec::new(),
            cells: Vec::new(),
        };
        let mut lists: Vec<Vec<u32>> = vec![Vec::new(); grid.counts.iter().product()];
        for (number, corners) in facets.iter().enumerate() {
            let (low, high) = bounds(corners, reach);
            grid.for_each_in(&low, &high, |place, _| lists[place].push(number as u32));
        }
        let mut cells = vec![NO_CELL; lists.len()];
        grid.for_each_in(&low, &high, |number, place| {
            let middle = std::array::from_fn(|a| low[a] + (place[a] as f64 + 0.5) * edge);
            cells[number] = search.locate(&middle, None).map_or(NO_CELL, |located| located.cell);
        });
        grid.cells = cells;
        grid.starts.push(0);
        for list in lists {
            grid.facets.extend(list);
            grid.starts.push(grid.facets.len() as u32);
        }
        grid
    }

    /// The facets that may be within reach of a point.
    pub fn near(&self, x: &[f64; D]) -> Near<'_> {
        let mut number = 0;
        for a in 0..D {
            let place = (x[a] - self.low[a]) * self.density;
            if !(place >= 0.0 && place < self.counts[a] as f64) {
                return Near::None { inside: false };
            }
            number = number * self.counts[a] + place as usize;
        }
        match &self.facets[self.starts[number] as usize..self.starts[number + 1] as usize] {
            [] => Near::None {
                inside: self.cells[number] != NO_CELL,
            },
            facets => Near::Facets(facets, self.cells[number]),
        }
    }

    /// Visits the boxes that a larger box touches: their numbers and places.
    fn for_each_in(&self, low: &[f64; D], high: &[f64; D], mut visit: impl FnMut(usize, &[usize; D])) {
        let place = |c: f64, a: usize| {
            let place = ((c - self.low[a]) * self.density).max(0.0) as usize;
            place.min(self.counts[a] - 1)
        };
        let first: [usize; D] = std::array::from_fn(|a| place(low[a], a));
        let last: [usize; D] = std::array::from_fn(|a| place(high[a], a));
        let mut at = first;
        loop {
            visit((0..D).fold(0, |number, a| number * self.counts[a] + at[a]), &at);
            let Some(axis) = (0..D).rev().find(|&a| at[a] < last[a]) else {
                return;
            };
            at[axis] += 1;
            at[axis + 1..].copy_from_slice(&first[axis + 1..]);
        }
    }
}

/// The box of some points, made wider by `reach` on all sides.
fn bounds<const D: usize>(points: &[[f64; D]], reach: f64) -> ([f64; D], [f64; D]) {
    // Against rounding, a little more.
    let (bounds, wider) = (Bounds::around(points), reach * (1.0 + 1e-9));
    (bounds.lower.map(|c| c - wider), bounds.upper.map(|c| c + wider))
}
