//! Hat functions on meshes: what every basis must do, and that they are the barycentric coordinates.

use mpm_core::Basis;
use mpm_core::conformance::{layout_is_sound, transfers_are_sums};
use mpm_mesh::{HatBasis, SimplexMesh};

use crate::basis_scenes::{cloud, cube, line};

fn conforms<const D: usize>(mesh: SimplexMesh<D>, size: f64) {
    let mut basis = HatBasis::new(&mesh);
    for round in 0..3 {
        let positions = cloud::<D>(300 + 100 * round, 0.0, size, round as u64);
        let sorted = basis.rebuild(&positions).unwrap();
        let what = format!("hats, D = {D}, round {round}");
        layout_is_sound(&basis, &positions, &what);
        for cell in 0..basis.schedule().cell_count() {
            let nodes = basis.cell_nodes(cell, &mut Vec::new()).to_vec();
            assert_eq!(nodes.len(), basis.cell_stencil_size(cell));
            for place in basis.schedule().cell(cell) {
                let x = &sorted[place];
                let mut at_nodes = [0.0; D];
                basis.for_each_node(place, x, |index, entry| {
                    let node = &basis.mesh().vertices()[nodes[index] as usize];
                    assert!(entry.weight > -1e-9, "{what}");
                    (0..D).for_each(|a| at_nodes[a] += entry.weight * node[a]);
                });
                assert!((0..D).all(|a| (at_nodes[a] - x[a]).abs() < 1e-12), "{what}: {x:?}");
                transfers_are_sums(&basis, place, x, nodes.len(), &what);
            }
        }
    }
}

#[test]
fn hats_conform() {
    conforms(line(&[0.0, 0.4, 1.3, 1.7, 2.6, 3.0]), 3.0);
    conforms(cube::<2>(7, 0.3, 0.25, 5), 2.1);
    conforms(cube::<3>(4, 2.0, 0.15, 6), 8.0);
}
