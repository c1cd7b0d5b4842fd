//! Particles on a mesh of the body.

use mpm_mesh::SimplexMesh;

use super::Filling;

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

#[cfg(test)]
mod tests {
    use mpm_mesh::generate::{EdgeTarget, disk};

    use super::*;

    /// The disk of the two-disks problem: 462 points in Cao et al. (2024), of which the paper does not say how they are found.
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
}
