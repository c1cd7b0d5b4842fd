//! ∇w in the place of diffuse gradients.

use crate::basis_scenes::{cube, generator, line};
use crate::kernel::largest_jump;
use crate::positive::points;
use mpm_mesh::{Gradient, KernelWidth, MeshBasis, SampleWeight, SimplexMesh};
use mpm_tensor::Matrix;
use rand::RngExt;

const WEIGHTS: [SampleWeight; 4] = [
    SampleWeight::Continuous,
    SampleWeight::Smooth,
    SampleWeight::DistanceAlone,
    SampleWeight::CellAlone,
];

/// The gradients are those of finite differences of the weights, and Σ g = 0, Σ g rᵀ = I.
fn is_gradient<const D: usize>(basis: &MeshBasis<D>, seed: u64, what: &str) {
    let (h, small) = (basis.kernel_width(), 1e-6 * basis.kernel_width());
    let mut checked = 0;
    for x in points(basis, 40, seed, |_| true) {
        let cell = basis.search().locate(&x, None).unwrap().cell;
        let entries = basis.weights_from(cell, &x);
        let (mut sum, mut unit) = ([0.0; D], Matrix::<D>::ZERO);
        for weight in &entries {
            unit += Matrix::outer(&weight.entry.gradient, &weight.entry.offset);
            (0..D).for_each(|a| sum[a] += h * weight.entry.gradient[a]);
        }
        assert!(sum.iter().all(|c| c.abs() < 1e-10), "{what}, {x:?}: Σ g = {sum:?}");
        let error = (unit - Matrix::IDENTITY).maximum_norm();
        assert!(error < 1e-10, "{what}, {x:?}: Σ g rᵀ is off by {error}");
        for a in 0..D {
            let side = |way: f64| {
                let mut moved = x;
                moved[a] += way;
                let located = basis.search().locate(&moved, None);
                located.filter(|located| located.cell == cell)?;
                Some(basis.weights_from(cell, &moved))
            };
            let (Some(low), Some(high)) = (side(-small), side(small)) else {
                continue;
            };
            for (n, weight) in entries.iter().enumerate() {
                // Second derivatives of weights that are kept positive jump, and are large where a particle is nearly on the hull of its ring.
                let [low, high] = [&low, &high].map(|side| side[n].entry.weight);
                let bend = (high - 2.0 * weight.entry.weight + low).abs() / small;
                let error = (weight.entry.gradient[a] - (high - low) / (2.0 * small)).abs();
                assert!(
                    h * error < 1e-6 + 0.1 * h * bend,
                    "{what}, {x:?}: axis {a} of node {n} is off by {error}"
                );
                checked += 1;
            }
        }
    }
    assert!(checked > 50, "{what}: {checked}");
}

#[test]
fn they_are_the_derivatives_of_the_weights() {
    fn check<const D: usize>(mesh: &SimplexMesh<D>) {
        for weight in WEIGHTS {
            for width in [KernelWidth::LongestEdge, KernelWidth::Local] {
                for positive in [false, true] {
                    let basis = MeshBasis::new(mesh).unwrap().with_gradient(Gradient::Exact);
                    let basis = basis.with_sample_weight(weight).with_kernel_width(width);
                    let basis = basis.with_positive_weights(positive);
                    is_gradient(
                        &basis,
                        7,
                        &format!("D = {D}, {weight:?}, {width:?}, positive: {positive}"),
                    );
                }
            }
        }
    }
    check(&line(&[0.0, 0.4, 1.3, 1.7, 2.6, 3.0]));
    check(&cube::<2>(5, 1.0, 0.25, 3));
    check(&cube::<3>(3, 1.0, 0.15, 4));
}

/// |∫ g_i dV| over ∫ |g_i| dV for a node all of whose cells and their neighbours are inside, by random points in every cell; the largest over such nodes.
fn largest_pull(basis: &MeshBasis<2>) -> f64 {
    let (mesh, mut random) = (basis.mesh(), generator(11));
    let on_boundary = mesh.on_boundary();
    let neighbours = mesh.vertex_neighbours();
    let mut sums = vec![([0.0; 2], 0.0); mesh.vertices().len()];
    for cell in 0..mesh.cell_count() {
        // An equal lattice of 18² points, moved at random, over the parallelogram of two copies of the cell, folded.
        let corners: Vec<[f64; 2]> = mesh.cell(cell).iter().map(|&v| mesh.vertices()[v as usize]).collect();
        let share = mesh.volume(cell) / 324.0;
        for k in 0..324 {
            let mut b = [(k % 18) as f64, (k / 18) as f64].map(|c| (c + random.random::<f64>()) / 18.0);
            if b[0] + b[1] > 1.0 {
                b = b.map(|c| 1.0 - c);
            }
            let x =
                [0, 1].map(|a| corners[0][a] + (1..3).map(|n| b[n - 1] * (corners[n][a] - corners[0][a])).sum::<f64>());
            for weight in basis.weights_from(cell as u32, &x) {
                let (sum, size) = &mut sums[weight.vertex as usize];
                let g = weight.entry.gradient;
                (0..2).for_each(|a| sum[a] += share * g[a]);
                *size += share * g[0].hypot(g[1]);
            }
        }
    }
    let mut largest = 0.0_f64;
    for (vertex, (sum, size)) in sums.iter().enumerate() {
        let ring = neighbours.get(vertex);
        let is_inside =
            |&v: &u32| !on_boundary[v as usize] && neighbours.get(v as usize).iter().all(|&w| !on_boundary[w as usize]);
        if ring.iter().all(is_inside) {
            largest = largest.max(sum[0].hypot(sum[1]) / size);
        }
    }
    largest
}

/// The forces of a constant stress on the nodes inside of a body sum to zero, whatever the mesh.
#[test]
fn a_constant_stress_pulls_at_no_node_inside() {
    let mesh = cube::<2>(8, 1.0, 0.25, 5);
    for weight in [SampleWeight::Continuous, SampleWeight::Smooth] {
        let basis = MeshBasis::new(&mesh).unwrap().with_sample_weight(weight);
        let diffuse = largest_pull(&basis);
        let exact = largest_pull(&basis.with_gradient(Gradient::Exact));
        assert!(diffuse > 0.04 && exact < 0.004, "{weight:?}: {diffuse}, {exact}");
    }
}

/// With η̃ weights and diffuse gradients are as continuous as with η.
#[test]
fn smooth_weights_are_continuous() {
    let mesh = cube::<2>(6, 0.3, 0.25, 3);
    let basis = MeshBasis::new(&mesh).unwrap().with_sample_weight(SampleWeight::Smooth);
    let jump = largest_jump(&basis, 2, &|_| true);
    assert!(jump < 1e-10, "{jump}");
    let jump = largest_jump(&basis.with_kernel_width(KernelWidth::Local), 2, &|_| true);
    assert!(jump < 1e-10, "{jump}");
}
