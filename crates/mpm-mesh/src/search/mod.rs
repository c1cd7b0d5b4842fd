//! Which cell a point is in.

mod buckets;
mod facets;
mod nearest;

use mpm_tensor::Matrix;
use mpm_tensor::vector::{accumulate, subtract};

use self::buckets::Buckets;
use self::facets::{NO_CELL, facet_neighbours};
pub use self::nearest::NearestPoint;
use crate::{MeshError, SimplexMesh};

/// Facets that a walk crosses before it is given up for the buckets.
const LONGEST_WALK: usize = 16;

/// Finds the cell of a point: a walk through facet neighbours from a cell near it, or a look into a bucket of cells. Built once
/// per mesh.
///
/// The answer depends on the point alone: the cell that the point lies inside of, by more than a tolerance of rounding; on facets, edges
/// and vertices the lowest of the cells there.
#[derive(Clone, Debug)]
pub struct CellSearch<const D: usize> {
    cells: Vec<Frame<D>>,
    /// Neighbour across the facet opposite to vertex n of cell c at c (D + 1) + n.
    neighbours: Vec<u32>,
    buckets: Buckets<D>,
    /// Barycentric coordinates this close to zero are zero.
    tolerance: f64,
}

/// x ↦ barycentric coordinates b_1, …, b_D of a cell; b_0 is what they leave of one.
#[derive(Clone, Copy, Debug)]
struct Frame<const D: usize> {
    origin: [f64; D],
    inverse: Matrix<D>,
}

/// A point in its cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Located<const D: usize> {
    /// The cell.
    pub cell: u32,
    /// Barycentric coordinates b_1, …, b_D; b_0 is what they leave of one.
    pub barycentric: [f64; D],
}

/// Smallest of all barycentric coordinates, b_0 included, and the vertex it belongs to; NaN for NaN.
#[inline(always)]
fn smallest<const D: usize>(barycentric: &[f64; D]) -> (f64, usize) {
    let mut first = 1.0;
    for &b in barycentric {
        first -= b;
    }
    let (mut least, mut vertex) = (first, 0);
    for a in 0..D {
        if barycentric[a] < least {
            (least, vertex) = (barycentric[a], a + 1);
        }
    }
    (least, vertex)
}

impl<const D: usize> Frame<D> {
    #[inline(always)]
    fn barycentric(&self, x: &[f64; D]) -> [f64; D] {
        self.inverse.apply(&subtract(x, &self.origin))
    }
}

impl<const D: usize> CellSearch<D> {
    /// The search structure of a mesh.
    ///
    /// # Errors
    /// [`MeshError::Degenerate`] for a cell without volume.
    pub fn new(mesh: &SimplexMesh<D>) -> Result<Self, MeshError> {
        let mut cells = Vec::with_capacity(mesh.cell_count());
        let (mut steepest, mut farthest) = (0.0, 0.0);
        for (number, cell) in mesh.cells().enumerate() {
            let origin = mesh.vertices()[cell[0] as usize];
            let edge = |n: usize| subtract(&mesh.vertices()[cell[n + 1] as usize], &origin);
            let edges: [[f64; D]; D] = std::array::from_fn(edge);
            let inverse = Matrix(edges).transpose().inverse();
            let Some(inverse) = inverse else {
                return Err(MeshError::Degenerate { cell: number });
            };
            steepest = f64::max(steepest, inverse.maximum_norm());
            farthest = origin.iter().fold(farthest, |most: f64, c| most.max(c.abs()));
            cells.push(Frame { origin, inverse });
        }
        Ok(Self {
            cells,
            neighbours: facet_neighbours(mesh),
            buckets: Buckets::new(mesh),
            // What the rounding of coordinates does to a barycentric coordinate, with a margin.
            tolerance: 16.0 * D as f64 * f64::EPSILON * (1.0 + farthest * steepest),
        })
    }

    /// Barycentric coordinates b_1, …, b_D of `x` in a cell, wherever `x` is.
    #[inline(always)]
    pub fn barycentric(&self, cell: u32, x: &[f64; D]) -> [f64; D] {
        self.cells[cell as usize].barycentric(x)
    }

    /// The cell that `x` is in, `near` being a cell to look from. `None` outside the mesh, and for what is not a number.
    #[inline]
    pub fn locate(&self, x: &[f64; D], near: Option<u32>) -> Option<Located<D>> {
        let mut cell = near.unwrap_or(NO_CELL);
        for _ in 0..LONGEST_WALK {
            let Some(frame) = self.cells.get(cell as usize) else {
                break;
            };
            let barycentric = frame.barycentric(x);
            let (least, vertex) = smallest(&barycentric);
            if least > self.tolerance {
                return Some(Located { cell, barycentric });
            }
            if least >= -self.tolerance {
                break; // on the boundary of a cell, where the lowest number decides
            }
            cell = self.neighbours[cell as usize * (D + 1) + vertex];
        }
        self.look_up(x)
    }

    /// As [`locate`](Self::locate), without a cell to look from.
    #[inline(never)]
    fn look_up(&self, x: &[f64; D]) -> Option<Located<D>> {
        let mut lowest = None;
        for &cell in self.buckets.at(x)? {
            let barycentric = self.barycentric(cell, x);
            let (least, _) = smallest(&barycentric);
            let located = Located { cell, barycentric };
            if least > self.tolerance {
                return Some(located);
            }
            if least >= -self.tolerance && lowest.is_none() {
                lowest = Some(located);
            }
        }
        lowest
    }

    /// The cell that `x` is in by looking at all of them: what [`locate`](Self::locate) is tested against.
    pub fn locate_by_brute_force(&self, x: &[f64; D]) -> Option<u32> {
        let least = |cell: u32| smallest(&self.barycentric(cell, x)).0;
        let mut all = 0..self.cells.len() as u32;
        let inside = all.clone().find(|&cell| least(cell) > self.tolerance);
        inside.or_else(|| all.find(|&cell| least(cell) >= -self.tolerance))
    }

    /// Whether barycentric coordinates are those of a point of the cell, up to rounding.
    pub fn is_inside(&self, barycentric: &[f64; D]) -> bool {
        smallest(barycentric).0 >= -self.tolerance
    }

    /// The neighbours of a cell, across the facet opposite to each of its vertices; `None` at the boundary of the mesh.
    pub fn neighbours(&self, cell: u32) -> impl Iterator<Item = Option<u32>> {
        let row = &self.neighbours[cell as usize * (D + 1)..][..D + 1];
        row.iter().map(|&cell| (cell != NO_CELL).then_some(cell))
    }

    /// Bytes held.
    pub fn storage_bytes(&self) -> usize {
        self.cells.capacity() * size_of::<Frame<D>>()
            + self.neighbours.capacity() * 4
            + self.buckets.storage_bytes()
    }
}

/// Σ_n b_n x_n over the vertices of a cell.
pub(crate) fn point_at<const D: usize>(mesh: &SimplexMesh<D>, cell: u32, barycentric: &[f64; D]) -> [f64; D] {
    let vertices = mesh.cell(cell as usize);
    let origin = mesh.vertices()[vertices[0] as usize];
    let mut x = origin;
    for n in 0..D {
        let edge = subtract(&mesh.vertices()[vertices[n + 1] as usize], &origin);
        accumulate(&mut x, barycentric[n], &edge);
    }
    x
}
