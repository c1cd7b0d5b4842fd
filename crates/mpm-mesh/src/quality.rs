//! How near cells are to regular simplices.

use mpm_tensor::vector::{accumulate, dot, norm, norm_squared, subtract};

use crate::SimplexMesh;

/// Shape of a cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quality {
    /// D r / R, inscribed over circumscribed radius: one for a regular simplex, near zero for a flat one, one in one dimension.
    pub radius_ratio: f64,
    /// The smallest angle between two facets, in radians; arccos(1 / D) in a regular simplex, zero in one dimension.
    pub smallest_angle: f64,
    /// The largest such angle.
    pub largest_angle: f64,
}

/// Shape of the cells of a mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct QualitySummary {
    /// The worst value of each measure over the cells.
    pub worst: Quality,
    /// The mean of the radius ratios.
    pub mean_radius_ratio: f64,
    /// The cell with the smallest radius ratio.
    pub worst_cell: usize,
}

impl<const D: usize> SimplexMesh<D> {
    /// Shape of a cell, from its gradients g_k = ∇λ_k:
    ///
    /// * inscribed radius r = 1 / Σ_k |g_k|, since 1 / |g_k| are the heights;
    /// * circumcentre x₀ + ½ Σ_{k > 0} |x_k − x₀|² g_k;
    /// * angle between the facets opposite i and j: arccos(−g_i · g_j / (|g_i| |g_j|)).
    ///
    /// # Panics
    ///
    /// Where there is no such cell, as an index of a slice does.
    pub fn quality(&self, cell: usize) -> Quality {
        let frame = self.frame(cell);
        let gradient = |k: usize| frame.gradient(k);
        let mut centre = [0.0; D];
        for (k, &vertex) in self.cell(cell).iter().enumerate().skip(1) {
            let edge = subtract(&self.vertices()[vertex as usize], frame.origin());
            accumulate(&mut centre, 0.5 * norm_squared(&edge), &gradient(k));
        }
        let inscribed = 1.0 / (0..=D).map(|k| norm(&gradient(k))).sum::<f64>();
        let mut quality = Quality {
            radius_ratio: D as f64 * inscribed / norm(&centre),
            smallest_angle: f64::INFINITY,
            largest_angle: 0.0,
        };
        for i in 0..=D {
            for j in 0..i {
                let cosine = -dot(&gradient(i), &gradient(j)) / (norm(&gradient(i)) * norm(&gradient(j)));
                let angle = cosine.clamp(-1.0, 1.0).acos();
                quality.smallest_angle = quality.smallest_angle.min(angle);
                quality.largest_angle = quality.largest_angle.max(angle);
            }
        }
        quality
    }

    /// The worst and the mean shape of the cells.
    pub fn quality_summary(&self) -> QualitySummary {
        let mut summary = QualitySummary {
            worst: self.quality(0),
            mean_radius_ratio: 0.0,
            worst_cell: 0,
        };
        let worst = &mut summary.worst;
        for cell in 0..self.cell_count() {
            let quality = self.quality(cell);
            summary.mean_radius_ratio += quality.radius_ratio / self.cell_count() as f64;
            if quality.radius_ratio < worst.radius_ratio {
                worst.radius_ratio = quality.radius_ratio;
                summary.worst_cell = cell;
            }
            worst.smallest_angle = worst.smallest_angle.min(quality.smallest_angle);
            worst.largest_angle = worst.largest_angle.max(quality.largest_angle);
        }
        summary
    }
}
