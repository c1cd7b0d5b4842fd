//! The wall around a mesh.

use mpm_core::{Basis, Boundary, GridMotion, GridNode};
use mpm_mesh::SimplexMesh;
use mpm_tensor::{Matrix, SymmetricEigen};

/// Facets that meet at less than about 37° are one smooth wall, sharper ones a corner: sin² of half the angle.
const CORNER: f64 = 0.1;

/// A wall without friction, through which nothing passes: the velocity of a vertex on it is v ← Q v with Q = I − Σ e eᵀ over the directions e that the wall
/// takes away.
///
/// With the facets around a vertex, of areas A_f and normals n_f, these are the eigenvectors of Σ A_f n_f n_fᵀ / Σ A_f with eigenvalues above 0.1: on a
/// smooth wall one, the mean normal; at a corner all.
#[derive(Clone, Debug)]
pub(super) struct SmoothWall<const D: usize> {
    /// Vertices on the wall, each with its Q.
    projections: Vec<(u32, Matrix<D>)>,
}

impl<const D: usize> SmoothWall<D> {
    /// Around that mesh.
    pub fn around(mesh: &SimplexMesh<D>) -> Self {
        let mut sums = vec![(0.0, Matrix::<D>::ZERO); mesh.vertices().len()];
        for facet in mesh.boundary() {
            for vertex in facet.vertices {
                let (area, sum) = &mut sums[vertex as usize];
                *area += facet.area;
                *sum += Matrix::outer(&facet.normal, &facet.normal) * facet.area;
            }
        }
        let on_the_wall = sums.into_iter().zip(0..).filter(|&((area, _), _)| area > 0.0);
        let projections = on_the_wall.map(|((area, sum), vertex)| (vertex, projection(&(sum * (1.0 / area)))));
        Self {
            projections: projections.collect(),
        }
    }

    /// For each vertex of the mesh whether it lies on the wall.
    pub fn marks(&self, vertex_count: usize) -> Vec<bool> {
        let mut marks = vec![false; vertex_count];
        for &(vertex, _) in &self.projections {
            marks[vertex as usize] = true;
        }
        marks
    }
}

fn projection<const D: usize>(normals: &Matrix<D>) -> Matrix<D> {
    let mut left = Matrix::IDENTITY;
    if let Some(eigen) = SymmetricEigen::new(normals) {
        for k in (0..D).filter(|&k| eigen.values[k] > CORNER) {
            let direction: [f64; D] = std::array::from_fn(|a| eigen.vectors.0[a][k]);
            left -= Matrix::outer(&direction, &direction);
        }
    }
    left
}

impl<const D: usize> Boundary<D> for SmoothWall<D> {
    fn constrain<B: Basis<D>, N: GridNode<D>>(&mut self, _: &B, _: &GridMotion<D>, nodes: &mut [N]) {
        for (vertex, projection) in &self.projections {
            let velocity = nodes[*vertex as usize].velocity_mut();
            *velocity = projection.apply(velocity);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::projection;
    use mpm_tensor::Matrix;

    #[test]
    fn a_smooth_wall_lets_slide_and_a_corner_holds() {
        let facet = |angle: f64| {
            let normal = [angle.cos(), angle.sin()];
            Matrix::outer(&normal, &normal) * 0.5
        };
        let smooth = projection(&(facet(0.2) + facet(-0.2)));
        let [along, across] = smooth.apply(&[3.0, 2.0]);
        assert!(along.abs() < 1e-12 && (across - 2.0).abs() < 1e-12);
        let corner = projection(&(facet(0.0) + facet(std::f64::consts::FRAC_PI_2)));
        assert!(corner.apply(&[3.0, 2.0]).iter().all(|c| c.abs() < 1e-12));
    }
}
