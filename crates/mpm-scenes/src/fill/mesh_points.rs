//! Particles on a mesh of the body.

use mpm_mesh::SimplexMesh;

use super::Filling;
use crate::shape::Shape;

/// One particle in the centre of every cell, with the cell's volume.
pub(crate) fn centroids<const D: usize>(mesh: &SimplexMesh<D>) -> Filling<D> {
    let centre = |cell: &[u32]| {
        std::array::from_fn(|a| {
            let sum: f64 = cell.iter().map(|&vertex| mesh.vertices()[vertex as usize][a]).sum();
            sum / (D + 1) as f64
        })
    };
    Filling {
        positions: mesh.cells().map(centre).collect(),
        volumes: (0..mesh.cell_count()).map(|cell| mesh.volume(cell)).collect(),
    }
}

/// One particle on every vertex, with its share of the cells around: Σ_c V_c / (D + 1).
pub(crate) fn vertices<const D: usize>(mesh: &SimplexMesh<D>) -> Filling<D> {
    let mut volumes = vec![0.0; mesh.vertices().len()];
    for (number, cell) in mesh.cells().enumerate() {
        let share = mesh.volume(number) / (D + 1) as f64;
        cell.iter().for_each(|&vertex| volumes[vertex as usize] += share);
    }
    Filling {
        positions: mesh.vertices().to_vec(),
        volumes,
    }
}

/// The points of [`rule`] in every cell with its centre in the shape, each with its share of the cell: sums over the particles are then integrals of what is smooth in cells, as weights are.
/// A triangle is divided into `parts`² like it first, a segment into `parts`; a tetrahedron is not.
pub(crate) fn in_cells<const D: usize>(mesh: &SimplexMesh<D>, shape: &dyn Shape<D>, parts: u32) -> Filling<D> {
    let places = places::<D>(parts);
    let mut filling = Filling::default();
    for (number, cell) in mesh.cells().enumerate() {
        let at = |shares: &[f64]| -> [f64; D] {
            let corners = || shares.iter().zip(cell);
            std::array::from_fn(|a| {
                corners()
                    .map(|(share, &vertex)| share * mesh.vertices()[vertex as usize][a])
                    .sum()
            })
        };
        if shape.distance(&at(&vec![1.0 / (D + 1) as f64; D + 1])) < 0.0 {
            filling.positions.extend(places.iter().map(|shares| at(shares)));
            let share = mesh.volume(number) / places.len() as f64;
            filling.volumes.resize(filling.positions.len(), share);
        }
    }
    filling
}

/// Barycentric coordinates of the D + 1 points of equal weight that integrate polynomials of degree two over a simplex (Hammer & Stroud 1956).
fn rule<const D: usize>() -> Vec<Vec<f64>> {
    let lean = 1.0 / ((D + 2) as f64).sqrt();
    let far = (1.0 - lean) / (D + 1) as f64;
    let point = |near: usize| (0..=D).map(|n| if n == near { far + lean } else { far }).collect();
    (0..=D).map(point).collect()
}

/// Those of the rule in all parts of a cell.
fn places<const D: usize>(parts: u32) -> Vec<Vec<f64>> {
    let (parts, step) = if D == 3 {
        (1, 1.0)
    } else {
        (parts, 1.0 / f64::from(parts))
    };
    // The lowest corner of a part in steps, and its way round: half of the triangles are turned.
    let mut corners = Vec::new();
    for first in 0..parts {
        match D {
            1 => corners.push(([first, 0], 1.0)),
            2 => {
                corners.extend((0..parts - first).map(|second| ([first, second], 1.0)));
                corners.extend((0..parts - first - 1).map(|second| ([first + 1, second + 1], -1.0)));
            }
            _ => corners.push(([0, 0], 1.0)),
        }
    }
    let mut all = Vec::new();
    for (corner, way) in corners {
        for point in rule::<D>() {
            let mut shares: Vec<f64> = point.iter().skip(1).map(|share| step * way * share).collect();
            shares
                .iter_mut()
                .zip(corner)
                .for_each(|(share, start)| *share += step * f64::from(start));
            shares.insert(0, 1.0 - shares.iter().sum::<f64>());
            all.push(shares);
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use mpm_mesh::generate::{EdgeTarget, disk};

    use super::*;
    use crate::shape::Ball;

    /// The disk of the two-disks problem: 462 points in Cao et al. (2024), §3.2, from a triangle mesh of the disk of which nothing else is said.
    #[test]
    fn particles_have_the_volume_of_the_mesh() {
        let target = EdgeTarget {
            length: 0.025,
            angle: 0.0,
        };
        let mesh = disk([0.2, 0.2], 0.2, &target).expect("a disk");
        for filling in [centroids(&mesh), vertices(&mesh)] {
            assert!((filling.volume() - mesh.total_volume()).abs() < 1e-12);
            let centre: [f64; 2] = std::array::from_fn(|a| {
                let each = filling.positions.iter().zip(&filling.volumes);
                each.map(|(x, volume)| x[a] * volume).sum::<f64>() / filling.volume()
            });
            assert!(centre.iter().all(|c| (c - 0.2).abs() < 1e-3), "{centre:?}");
        }
    }

    /// Volumes, and integrals of polynomials of degree two over a simplex, whatever its parts.
    fn integrates_squares<const D: usize>(corners: Vec<[f64; D]>, parts: u32, count: usize) {
        let mesh = SimplexMesh::new(corners, (0..=D as u32).collect()).expect("a simplex");
        let ball = Ball {
            centre: [0.0; D],
            radius: 9.0,
        };
        let filling = in_cells(&mesh, &ball, parts);
        assert_eq!(filling.positions.len(), count);
        assert!((filling.volume() - mesh.total_volume()).abs() < 1e-14);
        let vertices = mesh.vertices();
        let (number, mean) = ((D + 1) as f64, |a: usize| {
            vertices.iter().map(|x| x[a]).sum::<f64>() / (D + 1) as f64
        });
        for a in 0..D {
            for b in 0..D {
                // ∫ x_a x_b / V = (Σ x_a x_b + (Σ x_a) (Σ x_b)) / ((D + 1) (D + 2)).
                let products: f64 = vertices.iter().map(|x| x[a] * x[b]).sum();
                let exact = (products + number * number * mean(a) * mean(b)) / (number * (number + 1.0));
                let each = filling.positions.iter().zip(&filling.volumes);
                let sum: f64 = each.map(|(x, volume)| volume * x[a] * x[b]).sum();
                assert!(
                    (sum / mesh.total_volume() - exact).abs() < 1e-13,
                    "D = {D}, {parts} parts"
                );
            }
        }
    }

    #[test]
    fn points_in_cells_integrate_squares() {
        for parts in 1..4 {
            integrates_squares(vec![[0.2], [0.9]], parts, 2 * parts as usize);
            let triangle = vec![[0.0, 0.1], [1.0, 0.0], [0.3, 0.8]];
            integrates_squares(triangle, parts, 3 * (parts * parts) as usize);
            let tetrahedron = vec![[0.0; 3], [1.0, 0.1, 0.0], [0.2, 0.9, 0.1], [0.1, 0.2, 0.7]];
            integrates_squares(tetrahedron, parts, 4);
        }
    }
}
