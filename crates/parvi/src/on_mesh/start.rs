//! Points spread evenly over a mesh.

use mpm_mesh::SimplexMesh;
use rand::{Rng, RngExt};

/// `count` points, uniform in the mesh: the k-th in the cell where the share of volume passed, cell by cell, reaches (k + u) / `count`, uniform in that cell. Every
/// cell has its share of points to within one.
pub(super) fn uniform_in<const D: usize>(
    mesh: &SimplexMesh<D>,
    count: usize,
    generator: &mut impl Rng,
) -> Vec<[f64; D]> {
    let total = mesh.total_volume();
    let (mut cell, mut passed) = (0, mesh.volume(0));
    let mut points = Vec::with_capacity(count);
    for k in 0..count {
        let goal = (k as f64 + generator.random::<f64>()) / count as f64 * total;
        while passed < goal && cell + 1 < mesh.cell_count() {
            cell += 1;
            passed += mesh.volume(cell);
        }
        points.push(uniform_in_cell(mesh, cell, generator));
    }
    points
}

/// Σ λ_k x_k with λ uniform on the simplex: exponential numbers over their sum (Devroye 1986, ch. V).
fn uniform_in_cell<const D: usize>(mesh: &SimplexMesh<D>, cell: usize, generator: &mut impl Rng) -> [f64; D] {
    let (mut point, mut total) = ([0.0; D], 0.0);
    for &vertex in mesh.cell(cell) {
        let weight = -(1.0 - generator.random::<f64>()).ln();
        total += weight;
        for (c, x) in point.iter_mut().zip(&mesh.vertices()[vertex as usize]) {
            *c += weight * x;
        }
    }
    point.map(|c| c / total)
}

#[cfg(test)]
mod tests {
    use super::uniform_in;
    use mpm_mesh::SimplexMesh;
    use rand::SeedableRng;
    use rand::rngs::ChaCha8Rng;

    #[test]
    fn the_points_have_the_moments_of_a_triangle() {
        let mesh = SimplexMesh::<2>::new(vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], vec![0, 1, 2]).expect("a triangle");
        let points = uniform_in(&mesh, 100_000, &mut ChaCha8Rng::seed_from_u64(1));
        let mean = |of: fn(&[f64; 2]) -> f64| points.iter().map(of).sum::<f64>() / 1e5;
        assert!((mean(|x| x[0]) - 1.0 / 3.0).abs() < 0.004);
        assert!((mean(|x| x[0] * x[1]) - 1.0 / 12.0).abs() < 0.002);
        assert!(points.iter().all(|x| x[0] >= 0.0 && x[1] >= 0.0 && x[0] + x[1] <= 1.0));
    }
}
