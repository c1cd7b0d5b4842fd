//! Weights that are kept positive.

#![allow(clippy::print_stdout, reason = "bounds that were found are reported")]

use mpm_core::{Apic, Basis, Mpm, NoBodyForce, Particles};
use mpm_materials::{ElasticModuli, Material, NeoHookean};
use mpm_mesh::generate::{EdgeTarget, ball, disk, rectangle, with_outer_layer};
use mpm_mesh::{KernelWidth, MeshBasis, SimplexMesh};
use mpm_tensor::Matrix;
use mpm_tensor::vector::dot;
use proptest::prelude::*;
use rand::RngExt;

use crate::basis_scenes::{cube, generator, line};
use crate::kernel::largest_jump;
use crate::step::{control, solid};

/// Random points of random cells of those that `wanted` tells.
pub fn points<const D: usize>(
    basis: &MeshBasis<D>,
    count: usize,
    seed: u64,
    wanted: impl Fn(&[u32]) -> bool,
) -> Vec<[f64; D]> {
    let (mesh, mut random) = (basis.mesh(), generator(seed));
    let cells: Vec<usize> = (0..mesh.cell_count()).filter(|&cell| wanted(mesh.cell(cell))).collect();
    let mut point = || {
        let cell = cells[random.random_range(0..cells.len())];
        let shares: Vec<f64> = (0..=D).map(|_| -random.random::<f64>().ln()).collect();
        let total: f64 = shares.iter().sum();
        let corners = mesh.cell(cell).iter().map(|&vertex| mesh.vertices()[vertex as usize]);
        let corners: Vec<[f64; D]> = corners.collect();
        std::array::from_fn(|a| (0..=D).map(|n| shares[n] * corners[n][a]).sum::<f64>() / total)
    };
    (0..count).map(|_| point()).collect()
}

/// Weights are not negative, zero only with their gradients, and Σ w = 1, Σ w r = 0, Σ g = 0, Σ g rᵀ = I.
fn is_sound<const D: usize>(mesh: &SimplexMesh<D>, seed: u64) {
    let basis = MeshBasis::new(mesh).unwrap().with_positive_weights(true);
    let h = basis.kernel_width();
    for x in points(&basis, 30, seed, |_| true) {
        let (mut sum, mut mean, mut slope, mut unit) = (0.0, [0.0; D], [0.0; D], Matrix::<D>::ZERO);
        for weight in basis.weights_at(&x).unwrap() {
            let entry = weight.entry;
            assert!(entry.weight >= 0.0, "D = {D}, {x:?}: weight {}", entry.weight);
            assert!(entry.weight > 0.0 || entry.gradient == [0.0; D]);
            sum += entry.weight;
            unit += Matrix::outer(&entry.gradient, &entry.offset);
            for a in 0..D {
                mean[a] += entry.weight * entry.offset[a] / h;
                slope[a] += entry.gradient[a] * h;
            }
        }
        assert!((sum - 1.0).abs() < 1e-12, "D = {D}, {x:?}: {}", sum - 1.0);
        for a in 0..D {
            assert!(
                mean[a].abs() < 1e-12 && slope[a].abs() < 1e-11,
                "D = {D}, {x:?}: {mean:?} {slope:?}"
            );
        }
        let error = (unit - Matrix::IDENTITY).maximum_norm();
        assert!(error < 1e-11, "D = {D}, {x:?}: Σ g rᵀ is off by {error}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn they_reproduce_linear_fields(seed in 0u64..1_000_000, jitter in 0.0..0.25f64) {
        is_sound(&cube::<1>(9, 1.0, jitter, seed), seed);
        is_sound(&cube::<2>(5, 1.0, jitter, seed), seed);
        is_sound(&cube::<3>(3, 1.0, 0.7 * jitter, seed), seed);
    }
}

/// Cells that grow from flat ones to large ones: most nodes of a ring can be far to one side.
#[test]
fn they_are_positive_where_cells_are_flat() {
    let lengths = EdgeTarget {
        length: 0.15,
        angle: 0.0,
    };
    let even = rectangle([0.0; 2], [1.0; 2], &lengths).unwrap();
    let vertices = even.vertices().iter().map(|[x, y]| [x.powi(6), *y]).collect();
    let mesh = SimplexMesh::new(vertices, even.cells().flatten().copied().collect()).unwrap();
    for width in [KernelWidth::LongestEdge, KernelWidth::Local] {
        let basis = MeshBasis::new(&mesh)
            .unwrap()
            .with_positive_weights(true)
            .with_kernel_width(width);
        for x in points(&basis, 4000, 1, |_| true) {
            for weight in basis.weights_at(&x).unwrap() {
                assert!(weight.entry.weight >= 0.0, "{width:?}, {x:?}: {}", weight.entry.weight);
            }
        }
    }
}

#[test]
fn they_and_their_gradients_are_continuous() {
    fn check<const D: usize>(mesh: &SimplexMesh<D>) {
        let basis = MeshBasis::new(mesh).unwrap().with_positive_weights(true);
        let jump = largest_jump(&basis, 2, &|_| true);
        assert!(jump < 1e-10, "D = {D}: {jump}");
    }
    check(&line(&[0.0, 0.4, 1.3, 1.7, 2.6, 3.0]));
    check(&cube::<2>(6, 0.3, 0.25, 3));
    check(&cube::<3>(4, 2.0, 0.15, 4));
}

/// A ball and a layer around it.
fn ball_and_layer() -> SimplexMesh<3> {
    with_outer_layer(&ball([0.0; 3], 1.0, 0.35).unwrap()).unwrap().0
}

/// Whether no vertex of a cell is at the boundary.
fn is_inside<const D: usize>(basis: &MeshBasis<D>) -> impl Fn(&[u32]) -> bool {
    let on_boundary = basis.mesh().on_boundary();
    move |cell| cell.iter().all(|&vertex| !on_boundary[vertex as usize])
}

/// h² |g|² / |w|, largest over the nodes of a point: the stiffness of a particle that is alone there.
fn stiffness<const D: usize>(basis: &MeshBasis<D>, x: &[f64; D]) -> f64 {
    let weights = basis.weights_at(x).unwrap().into_iter().map(|weight| weight.entry);
    let weights = weights.filter(|entry| entry.weight != 0.0);
    let each = weights.map(|entry| dot(&entry.gradient, &entry.gradient) / entry.weight.abs());
    basis.kernel_width().powi(2) * each.fold(0.0, f64::max)
}

/// Points inside at which a weight of least squares is nearly zero and its gradient is not: between one where it is negative and the middle of the cell.
fn nearly_weightless(basis: &MeshBasis<3>) -> Vec<[f64; 3]> {
    let mut found = Vec::new();
    for x in points(basis, 1_000, 5, is_inside(basis)) {
        let located = basis.search().locate(&x, None).unwrap();
        let corners = basis.mesh().cell(located.cell as usize).iter();
        let corners: Vec<[f64; 3]> = corners
            .map(|&vertex| basis.mesh().vertices()[vertex as usize])
            .collect();
        let centre: [f64; 3] = std::array::from_fn(|a| corners.iter().map(|corner| corner[a]).sum::<f64>() / 4.0);
        let weights_at = |x: &[f64; 3]| basis.weights_from(located.cell, x);
        let there = weights_at(&centre);
        let node = weights_at(&x).iter().position(|weight| weight.entry.weight < 0.0);
        let Some(node) = node.filter(|&node| there[node].entry.weight > 0.0) else {
            continue;
        };
        let at = |way: f64| std::array::from_fn(|a| x[a] + way * (centre[a] - x[a]));
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            if weights_at(&at(middle))[node].entry.weight < 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        found.push(at(high));
    }
    found
}

/// Least squares weights pass through zero where their gradients do not; positive ones are never small beside them.
#[test]
fn no_node_is_too_light_for_the_stress_that_acts_on_it() {
    fn largest<const D: usize>(mesh: &SimplexMesh<D>) -> f64 {
        let basis = MeshBasis::new(mesh).unwrap().with_positive_weights(true);
        let each = points(&basis, 1_000, 5, is_inside(&basis)).into_iter();
        each.map(|x| stiffness(&basis, &x)).fold(0.0, f64::max)
    }
    let target = EdgeTarget {
        length: 0.2,
        angle: 0.4,
    };
    let disk = disk([0.0; 2], 1.0, &target).unwrap();
    let everywhere = [
        ("disk", largest(&with_outer_layer(&disk).unwrap().0)),
        ("triangles", largest(&cube::<2>(6, 0.3, 0.2, 3))),
        ("ball", largest(&ball_and_layer())),
        ("tetrahedra", largest(&cube::<3>(4, 2.0, 0.15, 4))),
    ];
    println!("{everywhere:?}");
    assert!(everywhere.iter().all(|(_, most)| *most < 10.0), "{everywhere:?}");
    let by_least_squares = MeshBasis::new(&ball_and_layer()).unwrap();
    let kept_positive = by_least_squares.clone().with_positive_weights(true);
    let weightless = nearly_weightless(&by_least_squares);
    assert!(!weightless.is_empty());
    for x in weightless {
        let (before, after) = (stiffness(&by_least_squares, &x), stiffness(&kept_positive, &x));
        println!("{before:.1e}, {after:.1}");
        assert!(before > 1e5 && after < 10.0, "{x:?}: {before:e}, {after}");
    }
}

/// A particle alone, stretched by a thousandth, and one step of a Courant number of a half: by least squares the nodes that it hardly touches are thrown out by its stress and turn it inside out.
#[test]
fn a_particle_alone_is_not_torn_by_nodes_without_mass() {
    let law = NeoHookean::new(ElasticModuli::new(1.0, 0.3).unwrap());
    let volume_ratio = |basis: &MeshBasis<3>, x: [f64; 3]| {
        let mut particles = Particles::at_rest(vec![x], 1.0).with_elastic_state(vec![1.0]);
        particles.deformation_gradients[0] = Matrix::IDENTITY * 1.001;
        let mut body = Mpm::new(particles, basis.clone(), Apic, solid(law), NoBodyForce);
        let wave_speed = Material::<3>::wave_speed(&law, &Matrix::IDENTITY, 1.0);
        body.step(&control(0.5 * basis.spacing() / wave_speed)).unwrap();
        body.particles.deformation_gradients[0].determinant()
    };
    let by_least_squares = MeshBasis::new(&ball_and_layer()).unwrap();
    let kept_positive = by_least_squares.clone().with_positive_weights(true);
    for x in nearly_weightless(&by_least_squares) {
        let [torn, whole] = [&by_least_squares, &kept_positive].map(|basis| volume_ratio(basis, x));
        println!("{torn:.1e}, {whole:.6}");
        assert!((torn - 1.0).abs() > 0.5, "{torn}");
        assert!((1.0..1.004).contains(&whole), "{whole}");
    }
}
