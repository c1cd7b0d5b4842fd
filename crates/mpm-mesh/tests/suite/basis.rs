//! What every basis must do, on meshes.

use crate::basis_scenes::{cloud, cube, line, naive_weights};
use mpm_core::conformance::{layout_is_sound, transfers_are_sums};
use mpm_core::{Basis, MpmError, NodeSums};
use mpm_kernels::LANES;
use mpm_mesh::{Gradient, MeshBasis, Outside, SampleWeight, SimplexMesh};
use mpm_tensor::Matrix;

/// Random clouds, each on a basis that was in use before, by least squares and with positive weights in turn, with diffuse gradients and exact ones.
fn conforms<const D: usize>(mesh: &SimplexMesh<D>, low: f64, high: f64) {
    let mut basis = MeshBasis::new(mesh).unwrap();
    for (round, gradient) in [Gradient::Diffuse, Gradient::Diffuse, Gradient::Exact, Gradient::Exact]
        .into_iter()
        .enumerate()
    {
        basis = basis.with_positive_weights(round % 2 == 1).with_gradient(gradient);
        let mut positions = cloud::<D>(300 + 100 * round, low, high, round as u64);
        positions.extend(
            mesh.vertices()
                .iter()
                .filter(|x| x.iter().all(|&c| c >= low && c <= high)),
        );
        let sorted = basis.rebuild(&positions).unwrap();
        let what = format!("D = {D}, round {round}");
        layout_is_sound(&basis, &positions, &what);
        stencils_are_right(&basis, &sorted, &what);
    }
}

fn stencils_are_right<const D: usize>(basis: &MeshBasis<D>, sorted: &[[f64; D]], what: &str) {
    let h = basis.kernel_width();
    let mut node_positions = Vec::new();
    basis.node_positions(&mut node_positions);
    assert_eq!(node_positions.len(), basis.node_count());
    let mut touched = vec![false; basis.node_count()];
    let mut scratch = Vec::new();
    for cell in 0..basis.schedule().cell_count() {
        let nodes = basis.cell_nodes(cell, &mut scratch).to_vec();
        assert_eq!(nodes.len(), basis.cell_stencil_size(cell));
        assert!(nodes.len() <= basis.stencil_size());
        let mut distinct = nodes.clone();
        distinct.dedup();
        assert!(nodes.is_sorted() && nodes.len() == distinct.len().next_multiple_of(LANES));
        assert!(
            nodes[distinct.len()..].iter().all(|node| Some(node) == distinct.last()),
            "{what}: only the last node of a ring fills up its group"
        );
        nodes.iter().for_each(|&node| touched[node as usize] = true);
        for place in basis.schedule().cell(cell) {
            let x = &sorted[place];
            let mesh_cell = basis.particle_cells()[place];
            assert_eq!(Some(mesh_cell), basis.search().locate_by_brute_force(x), "{what}");
            let mut expected = basis.weights_from(mesh_cell, x).into_iter();
            let mut spread = Matrix::<D>::ZERO;
            basis.for_each_node(place, x, |index, entry| {
                let expected = expected.next().unwrap();
                let node = node_positions[nodes[index] as usize];
                assert_eq!(node, basis.mesh().vertices()[expected.vertex as usize], "{what}");
                assert_eq!(*entry, expected.entry, "{what}");
                spread += Matrix::outer(&entry.offset, &entry.offset) * entry.weight;
            });
            assert!(expected.next().is_none());
            affine_directions_conserve(basis, place, x, &spread, what);
            if place % 8 == 0 {
                transfers_are_sums(basis, place, x, nodes.len(), what);
            }
        }
    }
    assert!(
        touched.iter().all(|&touched| touched),
        "{what}: an active node that no cell touches"
    );
    for (number, x) in node_positions.iter().enumerate() {
        assert_eq!(basis.node_number(x), Some(number as u32), "{what}");
        assert_eq!(basis.node_number(&x.map(|c| c + 1e-3 * h)), None);
    }
    let idle = |vertex: &u32| !basis.active_vertices().contains(vertex);
    for vertex in (0..basis.mesh().vertices().len() as u32).filter(idle) {
        assert_eq!(basis.node_number(&basis.mesh().vertices()[vertex as usize]), None);
    }
}

/// Σ direction = 0 and Σ direction rᵀ = I; direction = w D⁻¹ r in inner cells, and that or the gradient in cells at the boundary.
fn affine_directions_conserve<const D: usize>(
    basis: &MeshBasis<D>,
    place: usize,
    x: &[f64; D],
    spread: &Matrix<D>,
    what: &str,
) {
    let h = basis.kernel_width();
    let (mut sum, mut unit) = ([0.0; D], Matrix::<D>::ZERO);
    let (mut off_spread, mut off_gradient) = (0.0, 0.0);
    basis.for_each_node(place, x, |_, entry| {
        let direction = basis.affine_direction(place, x, entry);
        unit += Matrix::outer(&direction, &entry.offset);
        let back = spread.apply(&direction);
        for a in 0..D {
            sum[a] += h * direction[a];
            off_spread = f64::max(off_spread, (back[a] - entry.weight * entry.offset[a]).abs() / h);
            off_gradient = f64::max(off_gradient, h * (direction[a] - entry.gradient[a]).abs());
        }
    });
    assert!(
        sum.iter().all(|c| c.abs() < 1e-11),
        "{what}, {x:?}: directions sum to {sum:?}"
    );
    let error = (unit - Matrix::IDENTITY).maximum_norm();
    assert!(error < 1e-11, "{what}, {x:?}: Σ direction rᵀ is off by {error}");
    let on_boundary = basis.mesh().on_boundary();
    let cell = basis.mesh().cell(basis.particle_cells()[place] as usize);
    let inner = !cell.iter().any(|&vertex| on_boundary[vertex as usize]);
    assert!(
        off_spread < 1e-12 || (off_gradient == 0.0 && !inner),
        "{what}, {x:?}: {off_spread}, {off_gradient}"
    );
}

#[test]
fn meshes_conform() {
    conforms(&line(&[0.0, 0.4, 1.3, 1.7, 2.6, 3.0]), 0.0, 3.0);
    conforms(&cube::<2>(7, 0.3, 0.25, 5), 0.0, 2.1);
    conforms(&cube::<3>(4, 2.0, 0.15, 6), 0.0, 8.0);
}

#[test]
fn stencils_of_a_used_basis_are_those_of_the_definitions() {
    let mut basis = MeshBasis::new(&cube::<2>(5, 0.2, 0.25, 5)).unwrap();
    let sorted = basis.rebuild(&cloud::<2>(40, 0.0, 1.0, 3)).unwrap();
    for (place, x) in sorted.iter().enumerate() {
        let cell = basis.particle_cells()[place] as usize;
        let expected = naive_weights(basis.mesh(), cell, x, SampleWeight::Continuous);
        let schedule = basis.schedule();
        let run = (0..schedule.cell_count())
            .find(|&run| schedule.cell(run).contains(&place))
            .unwrap();
        let nodes = basis.cell_nodes(run, &mut Vec::new()).to_vec();
        basis.for_each_node(place, x, |index, entry| {
            let (weight, gradient) = expected[basis.active_vertices()[nodes[index] as usize] as usize];
            assert!((entry.weight - weight).abs() < 1e-12);
            assert!((0..2).all(|a| (entry.gradient[a] - gradient[a]).abs() < 1e-11));
        });
    }
}

/// Without D_p⁻¹ weights and gradients are the same, and the direction is the gradient.
#[test]
fn what_is_not_read_is_left_out() {
    let positions = cloud::<3>(200, 0.0, 8.0, 3);
    let mut basis = MeshBasis::new(&cube::<3>(4, 2.0, 0.15, 6)).unwrap();
    let sorted = basis.rebuild(&positions).unwrap();
    let whole = basis.clone();
    basis.expect_affine_directions(false);
    basis.activate(&sorted).unwrap();
    for (place, x) in sorted.iter().enumerate() {
        let mut expected = Vec::new();
        whole.for_each_node(place, x, |_, entry| expected.push(*entry));
        basis.for_each_node(place, x, |_, entry| {
            assert_eq!(*entry, expected.remove(0));
            assert_eq!(basis.affine_direction(place, x, entry), entry.gradient);
        });
        assert!(expected.is_empty());
    }
}

/// Σ_i m_i = Σ_p m_p and Σ_i m_i x_i = Σ_p m_p x_p.
#[test]
fn mass_and_its_centre_arrive_at_the_nodes() {
    let positions = cloud::<3>(500, 0.0, 8.0, 3);
    let mut basis = MeshBasis::new(&cube::<3>(4, 2.0, 0.15, 6)).unwrap();
    let sorted = basis.rebuild(&positions).unwrap();
    let mut sums = NodeSums::default();
    let stencils = &basis;
    sums.scatter(&basis, &sorted, |p, x, stencil| {
        stencils.for_each_node(p, x, |index, entry| *stencil.node(index) += entry.weight);
    });
    let mut nodes = Vec::new();
    basis.node_positions(&mut nodes);
    assert!((sums.as_slice().iter().sum::<f64>() - 500.0).abs() < 1e-11);
    for a in 0..3 {
        let of_nodes: f64 = sums.as_slice().iter().zip(&nodes).map(|(m, x)| m * x[a]).sum();
        let of_particles: f64 = positions.iter().map(|x| x[a]).sum();
        assert!((of_nodes - of_particles).abs() < 1e-10);
    }
}

/// The cells follow the particles when these are sorted, and a particle that stays has the same cell.
#[test]
fn remembered_cells_follow_the_order_of_the_particles() {
    let mut basis = MeshBasis::new(&cube::<2>(20, 0.1, 0.2, 5)).unwrap();
    let mut sorted = basis.rebuild(&cloud::<2>(3000, 0.3, 1.7, 4)).unwrap();
    assert!(!basis.schedule().keeps_order());
    for round in 0..6 {
        for (place, x) in sorted.iter().enumerate() {
            assert_eq!(
                Some(basis.particle_cells()[place]),
                basis.search().locate_by_brute_force(x)
            );
        }
        let moved: Vec<[f64; 2]> = sorted
            .iter()
            .map(|x| [x[0] + 0.03 * (x[1] - 1.0), x[1] - 0.03 * (x[0] - 1.0)])
            .collect();
        sorted = basis.rebuild(&moved).unwrap();
        assert!(basis.schedule().cell_count() >= 200, "round {round}");
    }
}

#[test]
fn a_particle_outside_is_refused_or_extrapolated() {
    let mesh = cube::<2>(6, 1.0, 0.1, 5);
    let positions = [[3.0, 3.0], [2.5, 6.2], [3.1, 3.0]];
    let mut basis = MeshBasis::new(&mesh).unwrap();
    let refusal = MpmError::OutsideMesh {
        particle: 1,
        position: vec![2.5, 6.2],
    };
    assert_eq!(basis.rebuild(&positions), Err(refusal.clone()));
    assert_eq!(basis.schedule().order().len(), 0);

    let mut near = basis.clone().with_outside(Outside::Extrapolate { reach: 0.1 });
    assert_eq!(near.rebuild(&positions), Err(refusal));

    let mut far = basis.with_outside(Outside::Extrapolate { reach: 0.3 });
    let sorted = far.rebuild(&positions).unwrap();
    layout_is_sound(&far, &positions, "outside");
    for (place, x) in sorted.iter().enumerate() {
        let (mut sum, mut mean) = (0.0, [0.0; 2]);
        far.for_each_node(place, x, |_, entry| {
            sum += entry.weight;
            (0..2).for_each(|a| mean[a] += entry.weight * entry.offset[a]);
        });
        assert!(
            (sum - 1.0).abs() < 1e-13 && mean.iter().all(|c| c.abs() < 1e-12),
            "{x:?}"
        );
    }
}

#[test]
fn without_particles_there_is_nothing() {
    let mut basis = MeshBasis::new(&cube::<2>(3, 1.0, 0.1, 5)).unwrap();
    basis.rebuild(&[]).unwrap();
    assert_eq!(basis.node_count(), 0);
    assert_eq!(basis.schedule().cell_count(), 0);
}
