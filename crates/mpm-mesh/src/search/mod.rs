//! Which cell a point is in.

mod buckets;
mod nearest;

use mpm_tensor::vector::{maximum_norm, norm};

use self::buckets::Buckets;
pub use self::nearest::NearestPoint;
use crate::{Frame, NO_CELL, SimplexMesh};

/// Facets that a walk crosses before it is given up for the buckets.
const LONGEST_WALK: usize = 16;

/// Finds the cell of a point: a walk through facet neighbours from a cell near it (ours), or a look into a bucket of cells (Cao et al. 2024, Appendix A, has that
/// alone). Built once per mesh.
///
/// The answer depends on the point alone: the cell that the point lies inside of, by more than a tolerance of rounding; on facets, edges
/// and vertices the lowest of the cells there.
#[derive(Clone, Debug)]
pub struct CellSearch<const D: usize> {
    mesh: SimplexMesh<D>,
    frames: Vec<Frame<D>>,
    buckets: Buckets<D>,
    least_height: f64,
    /// Barycentric coordinates this close to zero are zero.
    tolerance: f64,
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

impl<const D: usize> CellSearch<D> {
    /// The search structure of a mesh, which it keeps.
    pub fn new(mesh: SimplexMesh<D>) -> Self {
        let frames: Vec<_> = (0..mesh.cell_count()).map(|cell| mesh.frame(cell)).collect();
        let gradients = frames.iter().flat_map(|frame| (0..=D).map(|k| frame.gradient(k)));
        let steepest = gradients.map(|gradient| norm(&gradient)).fold(0.0, f64::max);
        let farthest = mesh.vertices().iter().map(maximum_norm).fold(0.0, f64::max);
        Self {
            least_height: 1.0 / steepest,
            buckets: Buckets::new(&mesh),
            // What the rounding of coordinates does to a barycentric coordinate, with a margin.
            tolerance: 16.0 * D as f64 * f64::EPSILON * (1.0 + farthest * steepest),
            frames,
            mesh,
        }
    }

    /// The mesh.
    pub fn mesh(&self) -> &SimplexMesh<D> {
        &self.mesh
    }

    /// The least height of a cell above one of its facets.
    pub fn least_height(&self) -> f64 {
        self.least_height
    }

    /// The barycentric coordinates of a cell as functions of x.
    #[inline(always)]
    pub(crate) fn frame(&self, cell: u32) -> &Frame<D> {
        &self.frames[cell as usize]
    }

    /// Barycentric coordinates b_1, …, b_D of `x` in a cell, wherever `x` is.
    ///
    /// # Panics
    ///
    /// Where there is no such cell, as an index of a slice does.
    #[inline(always)]
    pub fn barycentric(&self, cell: u32, x: &[f64; D]) -> [f64; D] {
        self.frames[cell as usize].coordinates(x)
    }

    /// The cell that `x` is in, `near` being a cell to look from. `None` outside the mesh, and for what is not a number.
    #[inline]
    pub fn locate(&self, x: &[f64; D], near: Option<u32>) -> Option<Located<D>> {
        let mut cell = near.unwrap_or(NO_CELL);
        for _ in 0..LONGEST_WALK {
            let Some(frame) = self.frames.get(cell as usize) else {
                break;
            };
            let barycentric = frame.coordinates(x);
            let (least, vertex) = smallest(&barycentric);
            if least > self.tolerance {
                return Some(Located { cell, barycentric });
            }
            if least >= -self.tolerance {
                break; // on the boundary of a cell, where the lowest number decides
            }
            cell = self.mesh.neighbours(cell as usize)[vertex];
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
        let mut all = 0..self.frames.len() as u32;
        let inside = all.clone().find(|&cell| least(cell) > self.tolerance);
        inside.or_else(|| all.find(|&cell| least(cell) >= -self.tolerance))
    }

    /// Whether barycentric coordinates are those of a point of the cell, up to rounding.
    pub fn is_inside(&self, barycentric: &[f64; D]) -> bool {
        smallest(barycentric).0 >= -self.tolerance
    }

    /// Bytes held beside the mesh.
    pub fn storage_bytes(&self) -> usize {
        self.frames.capacity() * size_of::<Frame<D>>() + self.buckets.storage_bytes()
    }
}
