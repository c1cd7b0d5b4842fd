//! The mesh that a density is kept to.

use std::path::Path;

use mpm_mesh::{CellSearch, read_msh};

/// What is within the mesh of a file.
pub struct Within<const D: usize>(CellSearch<D>);

impl<const D: usize> Within<D> {
    /// For d = 2 and 3; `None` where there is no mesh.
    pub fn of_file(path: &Path) -> Option<Self> {
        if const { D == 2 || D == 3 } {
            let mesh = read_msh::<D>(&std::fs::read(path).ok()?).ok()?;
            return Some(Self(CellSearch::new(mesh)));
        }
        None
    }

    /// Whether a point is.
    pub fn holds(&self, x: &[f64; D]) -> bool {
        self.0.locate(x, None).is_some()
    }

    /// The least and the largest coordinate along an axis.
    pub fn range(&self, axis: usize) -> (f64, f64) {
        let along = self.0.mesh().vertices().iter().map(|x| x[axis]);
        along.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), c| {
            (low.min(c), high.max(c))
        })
    }
}
