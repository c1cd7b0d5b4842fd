//! A vector field known at the nodes of a grid, interpolated between them by cubics; cells can be halved.

use std::collections::HashMap;

/// Nodes per axis that a cell is interpolated from.
const WIDTH: usize = 4;
/// Halvings of a cell, at most.
const LEVELS: u8 = 8;
/// Cells are numbered up to here along an axis, so that nodes of all levels fit.
const LARGEST_CELL: f64 = (1 << 22) as f64;

/// Cubes of edge h and, where they were halved, of h/2, h/4, …; within one, every component is the product interpolant of degree three from the 4ᴰ nodes of its
/// level about it (exact for cubics of each coordinate, continuous between cells of one level).
#[derive(Debug)]
pub(crate) struct ScoreGrid<const D: usize> {
    spacing: f64,
    /// Values by node, whose places are counted in edges of the smallest cells.
    nodes: HashMap<[i32; D], [f64; D]>,
    cells: HashMap<Cell<D>, Content<D>>,
}

/// A cell: its level, and the corner with the smallest coordinates in edges of that level.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct Cell<const D: usize> {
    level: u8,
    corner: [i32; D],
}

/// What is known of a cell.
#[derive(Debug)]
enum Content<const D: usize> {
    /// Its halves are looked at instead.
    Halved,
    /// Values at the nodes it is interpolated from, the first axis fastest.
    Values(Box<[[f64; D]]>),
}

impl<const D: usize> ScoreGrid<D> {
    /// A grid without known nodes; `spacing` > 0.
    pub fn new(spacing: f64) -> Self {
        Self {
            spacing,
            nodes: HashMap::new(),
            cells: HashMap::new(),
        }
    }

    /// The smallest cell about a point; `None` for one too far out to be numbered.
    pub fn cell(&self, z: &[f64; D]) -> Option<Cell<D>> {
        let mut cell = Cell {
            level: 0,
            corner: corner(z, self.spacing)?,
        };
        while matches!(self.cells.get(&cell), Some(Content::Halved)) {
            let level = cell.level + 1;
            cell = Cell {
                level,
                corner: corner(z, self.edge(level))?,
            };
        }
        Some(cell)
    }

    /// Halve a cell, unless it is of the last level.
    pub fn halve(&mut self, cell: Cell<D>) -> bool {
        let halves = cell.level < LEVELS;
        if halves {
            self.cells.insert(cell, Content::Halved);
        }
        halves
    }

    /// Nodes about the cells of points that are not known yet, each once.
    pub fn unknown(&self, points: &[[f64; D]]) -> Vec<[i32; D]> {
        let mut fresh: Vec<[i32; D]> = Vec::new();
        let mut seen: Vec<Cell<D>> = points.iter().filter_map(|z| self.cell(z)).collect();
        seen.sort_unstable();
        seen.dedup();
        for cell in seen.iter().filter(|cell| !self.cells.contains_key(cell)) {
            fresh.extend(nodes_of(cell).filter(|node| !self.nodes.contains_key(node)));
        }
        fresh.sort_unstable();
        fresh.dedup();
        fresh
    }

    /// Where a node is.
    pub fn place(&self, node: &[i32; D]) -> [f64; D] {
        node.map(|c| f64::from(c) * self.edge(LEVELS))
    }

    /// The value at a node is known now.
    pub fn learn(&mut self, node: [i32; D], value: [f64; D]) {
        self.nodes.insert(node, value);
    }

    /// The value at a point, not a number where a node about it is unknown or has none.
    pub fn interpolate(&mut self, z: &[f64; D]) -> [f64; D] {
        let Some(cell) = self.cell(z) else {
            return [f64::NAN; D];
        };
        let edge = self.edge(cell.level);
        let weights: [[f64; WIDTH]; D] =
            std::array::from_fn(|axis| cubic_weights(z[axis] / edge - f64::from(cell.corner[axis])));
        let nodes = &self.nodes;
        let content = self.cells.entry(cell).or_insert_with(|| {
            let value = |node| nodes.get(&node).copied().unwrap_or([f64::NAN; D]);
            Content::Values(nodes_of(&cell).map(value).collect())
        });
        match content {
            Content::Values(values) => product_sum(&weights, values),
            Content::Halved => [f64::NAN; D],
        }
    }

    fn edge(&self, level: u8) -> f64 {
        self.spacing / f64::from(1_u32 << level)
    }
}

/// The corner of the cell about a point on a grid of some edge.
fn corner<const D: usize>(z: &[f64; D], edge: f64) -> Option<[i32; D]> {
    let numbered = z.iter().all(|c| (c / edge).abs() < LARGEST_CELL);
    numbered.then(|| z.map(|c| (c / edge).floor() as i32))
}

/// The 4ᴰ nodes that a cell is interpolated from, the first axis fastest.
fn nodes_of<const D: usize>(cell: &Cell<D>) -> impl Iterator<Item = [i32; D]> {
    let Cell { level, corner } = *cell;
    let scale = 1 << (LEVELS - level);
    (0..WIDTH.pow(D as u32)).map(move |number| {
        let mut rest = number;
        corner.map(|c| {
            let offset = (rest % WIDTH) as i32 - 1;
            rest /= WIDTH;
            (c + offset) * scale
        })
    })
}

/// Lagrange's weights of the nodes −1, 0, 1, 2 at t ∈ [0, 1].
fn cubic_weights(t: f64) -> [f64; WIDTH] {
    let (a, b, c) = (t + 1.0, t - 1.0, t - 2.0);
    [-t * b * c / 6.0, a * b * c / 2.0, -a * t * c / 2.0, a * t * b / 6.0]
}

/// Σ Π w_axis value over the nodes of a cell.
fn product_sum<const D: usize>(weights: &[[f64; WIDTH]; D], values: &[[f64; D]]) -> [f64; D] {
    let mut sum = [0.0; D];
    for (row, values) in values.chunks_exact(WIDTH).enumerate() {
        let mut rest = row;
        let mut weight = 1.0;
        for along in &weights[1..] {
            weight *= along[rest % WIDTH];
            rest /= WIDTH;
        }
        for (along, value) in weights[0].iter().zip(values) {
            for axis in 0..D {
                sum[axis] += weight * along * value[axis];
            }
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    fn field(z: &[f64; 2]) -> [f64; 2] {
        let [x, y] = *z;
        [x.powi(3) - 2.0 * x * y * y + 1.0, y.powi(3) * x + x - 0.5]
    }

    fn know(grid: &mut ScoreGrid<2>, points: &[[f64; 2]]) {
        for node in grid.unknown(points) {
            let value = field(&grid.place(&node));
            grid.learn(node, value);
        }
    }

    #[test]
    fn cubics_are_exact_in_cells_of_all_levels() {
        let mut grid = ScoreGrid::new(0.7);
        let points: Vec<[f64; 2]> = (0..200)
            .map(|k| [(f64::from(k) * 0.37).sin() * 3.0, f64::from(k) * 0.02 - 2.0])
            .collect();
        for _ in 0..3 {
            know(&mut grid, &points);
            for z in &points {
                let (value, expected) = (grid.interpolate(z), field(z));
                for axis in 0..2 {
                    assert!((value[axis] - expected[axis]).abs() < 1e-12 * (1.0 + expected[axis].abs()));
                }
            }
            assert!(grid.unknown(&points).is_empty());
            let halved: Vec<_> = points.iter().step_by(7).filter_map(|z| grid.cell(z)).collect();
            assert!(halved.into_iter().all(|cell| grid.halve(cell)));
        }
    }

    #[test]
    fn what_cannot_be_numbered_or_is_not_known_has_no_value() {
        let mut grid = ScoreGrid::<2>::new(1.0);
        for z in [[1e12, 0.0], [f64::NAN, 0.0], [f64::INFINITY, 0.0], [0.5, 0.5]] {
            assert!(grid.interpolate(&z).iter().all(|c| c.is_nan()), "{z:?}");
        }
    }
}
