//! What every basis must do, whatever its nodes are.

use std::collections::HashSet;

use mpm_core::conformance::{AnyBasis, layout_is_sound, transfers_are_sums};
use mpm_core::{NO_NODE, ProductGrid, SimplexLattice, SplineDegree, SplineGrid, UniformBasis};
use mpm_kernels::{Deposit, Quadratic};
use mpm_tensor::Matrix;
use rand::RngExt;

use crate::basis_gradients::gradients_are_derivatives;
use crate::scenes::{Make, dot, generator, norm, normal, reflection, stencil};

/// Random clouds on a randomly placed basis, each on a basis that was in use before.
fn conforms<const D: usize>(name: &str, make: Make<D>) {
    for case in 0..3 {
        let mut random = generator(100 * D as u64 + case);
        let h = 10f64.powf(random.random_range(-1.5..1.5));
        let origin = normal::<D>(&mut random).map(|c| 5.0 * h * c);
        let mut basis = make(origin, h);
        let count = (40_000 / basis.stencil_size()).clamp(12, 400);
        for round in 0..2 {
            let positions = cloud(count, origin, h, &mut random);
            let sorted = basis.rebuild(&positions).unwrap();
            let what = format!("{name}, D = {D}, case {case}, round {round}");
            layout_is_sound(&*basis, &positions, &what);
            stencils_are_right(&*basis, &sorted, &what);
            gradients_are_derivatives(name, &mut *basis, &sorted, &what);
        }
    }
}

/// A clump, a wider cloud, points on nodes of a grid at `origin`, and stragglers far away on all sides.
fn cloud<const D: usize>(count: usize, origin: [f64; D], h: f64, random: &mut rand::rngs::ChaCha8Rng) -> Vec<[f64; D]> {
    let point = |k: usize| {
        let spread = [0.3 * h, 3.0 * h, 3.0 * h, 200.0 * h][k % 4];
        let z = normal::<D>(random).map(|c| spread * c);
        if k % 12 == 1 {
            return std::array::from_fn(|a| origin[a] + h * (z[a] / h).round());
        }
        std::array::from_fn(|a| origin[a] + z[a])
    };
    (0..count).map(point).collect()
}

/// Weights, offsets, fluxes and node numbers, and that the active nodes are the touched ones.
fn stencils_are_right<const D: usize>(basis: &dyn AnyBasis<D>, sorted: &[[f64; D]], what: &str) {
    let (schedule, h) = (basis.schedule(), basis.spacing());
    let mut node_positions = Vec::new();
    basis.node_positions(&mut node_positions);
    assert_eq!(node_positions.len(), basis.node_count());
    let mut touched = vec![false; basis.node_count()];
    let mut scratch = Vec::new();
    for cell in 0..schedule.cell_count() {
        let cell_nodes = basis.cell_nodes(cell, &mut scratch);
        assert_eq!(cell_nodes.len(), basis.cell_stencil_size(cell), "{what}");
        let present: Vec<u32> = cell_nodes.iter().copied().filter(|&node| node != NO_NODE).collect();
        let distinct: HashSet<_> = present.iter().collect();
        assert_eq!(distinct.len(), present.len(), "{what}: a node occurs twice in a cell");
        for &node in &present {
            touched[node as usize] = true;
        }
        let mut by_particles = HashSet::new();
        for place in schedule.cell(cell) {
            stencil_is_right(basis, place, &sorted[place], cell_nodes, &node_positions, what);
            by_particles.extend(stencil(basis, place, &sorted[place]).iter().map(|s| cell_nodes[s.0]));
            if place % 16 == 0 {
                transfers_are_sums(basis, place, &sorted[place], cell_nodes.len(), what);
            }
        }
        assert_eq!(
            by_particles.len(),
            present.len(),
            "{what}: a node that no particle of the cell touches"
        );
    }
    assert!(
        touched.iter().all(|&t| t),
        "{what}: an active node that no cell touches"
    );
    let distinct: HashSet<_> = node_positions
        .iter()
        .map(|x| x.map(|c| (c / (1e-6 * h)).round() as i64))
        .collect();
    assert_eq!(distinct.len(), node_positions.len(), "{what}: one node has two numbers");
}

fn stencil_is_right<const D: usize>(
    basis: &dyn AnyBasis<D>,
    particle: usize,
    x: &[f64; D],
    cell_nodes: &[u32],
    node_positions: &[[f64; D]],
    what: &str,
) {
    let h = basis.spacing();
    let rounding = 1e-12 * (norm(x) + h);
    let seen = stencil(basis, particle, x);
    assert!(
        seen.iter().is_sorted_by(|before, after| before.0 < after.0),
        "{what}: places out of order"
    );
    assert!(seen.len() <= basis.stencil_size());

    let (mut sum, mut slope, mut mean) = (0.0, [0.0; D], [0.0; D]);
    let mut second_moment = Matrix::<D>::ZERO;
    for &(place, weight, gradient, offset) in &seen {
        let node = node_positions[cell_nodes[place] as usize];
        assert!(weight >= -1e-15, "{what}: weight {weight}");
        sum += weight;
        for a in 0..D {
            let expected = node[a] - x[a];
            assert!(
                (offset[a] - expected).abs() < rounding,
                "{what}: offset {} for {expected}",
                offset[a]
            );
            slope[a] += gradient[a];
            mean[a] += weight * node[a];
        }
        second_moment += Matrix::outer(&offset, &offset) * weight;
    }
    assert!((sum - 1.0).abs() < 1e-13, "{what}: weights sum to {sum}");
    for a in 0..D {
        assert!(
            (mean[a] - x[a]).abs() < rounding,
            "{what}: linear reproduction, {} for {}",
            mean[a],
            x[a]
        );
        assert!(slope[a].abs() < 1e-12 / h, "{what}: gradients sum to {slope:?}");
    }

    // w D⁻¹ (x_i − x) times D, so that no inverse is taken where D is singular.
    basis.for_each_node(particle, x, &mut |_, entry| {
        let direction = second_moment.apply(&basis.affine_direction(particle, x, entry));
        for a in 0..D {
            let expected = entry.weight * entry.offset[a];
            assert!((direction[a] - expected).abs() < 1e-12 * h, "{what}: affine direction");
        }
    });

    let value = Deposit {
        scalar: 1.3,
        vector: std::array::from_fn(|a| 0.7 - 0.4 * a as f64),
    };
    let scale = 0.3 * h;
    let mut visits = seen.iter();
    basis.for_each_deposit(particle, x, &value, scale, &mut |place, weight, deposit| {
        let &(expected_place, expected_weight, gradient, _) = visits.next().unwrap();
        assert_eq!(place, expected_place, "{what}");
        assert!((weight - expected_weight).abs() < 1e-15, "{what}");
        assert!(
            (deposit.scalar - expected_weight * value.scalar).abs() < 1e-14,
            "{what}"
        );
        for a in 0..D {
            let (found, expected) = (
                deposit.vector[a],
                expected_weight * value.vector[a] + scale * gradient[a],
            );
            assert!((found - expected).abs() < 1e-14, "{what}: {found} for {expected}");
        }
    });
    assert!(visits.next().is_none(), "{what}: deposits at fewer nodes");
}

/// A displaced point reads the same shape functions: w_i is a function of space, not of the cell that evaluates it.
fn fields_are_continuous<const D: usize>(name: &str, make: Make<D>) {
    let mut random = generator(7);
    let mut basis = make([0.0; D], 1.0);
    let direction = normal::<D>(&mut random);
    let length = norm(&direction);
    let line: Vec<[f64; D]> = (0..200)
        .map(|k| direction.map(|c| c / length * 0.02 * f64::from(k)))
        .collect();
    let sorted = basis.rebuild(&line).unwrap();
    // A quadratic field of the nodes: its interpolant is continuous along any line.
    let field = |particle: usize| {
        let x = &sorted[particle];
        let mut sum = 0.0;
        for (_, weight, _, offset) in stencil(&*basis, particle, x) {
            let node: [f64; D] = std::array::from_fn(|a| x[a] + offset[a]);
            sum += weight * dot(&node, &node);
        }
        sum
    };
    let mut place = vec![0; line.len()];
    for (k, &particle) in basis.schedule().order().iter().enumerate() {
        place[particle as usize] = k;
    }
    for pair in place.windows(2) {
        let jump = (field(pair[1]) - field(pair[0])).abs();
        assert!(
            jump < 0.02 * 3.0 * (D as f64 + 8.0),
            "{name}, D = {D}: jump {jump} from {:?}",
            sorted[pair[0]]
        );
    }
}

#[test]
fn every_basis_conforms_in_one_dimension() {
    any_basis!(conforms, 1);
}

#[test]
fn every_basis_conforms_in_two_dimensions() {
    any_basis!(conforms, 2);
}

#[test]
fn every_basis_conforms_in_three_dimensions() {
    any_basis!(conforms, 3);
}

#[test]
fn every_basis_conforms_in_four_dimensions() {
    any_basis!(conforms, 4);
}

/// What is new with a dimension is the shape of a block of nodes, which hangs on no kernel: of the splines one; linear, cubic and GIMP are met in four dimensions.
fn one_of_each_kind<const D: usize>() {
    conforms::<D>("quadratic", &|o, h| {
        Box::new(SplineGrid::<Quadratic, 3, D>::new(o, h).unwrap())
    });
    conforms::<D>("turned lattice", &|o, h| {
        let mut lattice = SimplexLattice::<D>::permutohedral(o, h).unwrap();
        lattice.turn(&reflection());
        Box::new(lattice)
    });
    conforms::<D>("Kuhn lattice", &|o, h| {
        Box::new(SimplexLattice::<D>::kuhn(o, h).unwrap())
    });
    conforms::<D>("quadratic by a loop", &|o, h| {
        Box::new(ProductGrid::<D>::new(SplineDegree::Quadratic, o, h).unwrap())
    });
}

#[test]
fn bases_conform_in_five_dimensions() {
    one_of_each_kind::<5>();
}

#[test]
fn bases_conform_in_six_dimensions() {
    one_of_each_kind::<6>();
}

#[test]
fn splines_of_any_degree_conform() {
    fn all<const D: usize>() {
        for degree in [SplineDegree::Linear, SplineDegree::Quadratic, SplineDegree::Cubic] {
            conforms::<D>(&format!("{degree:?} by a loop"), &|o, h| {
                Box::new(ProductGrid::<D>::new(degree, o, h).unwrap())
            });
        }
    }
    all::<1>();
    all::<2>();
    all::<3>();
}

#[test]
fn fields_are_continuous_along_lines() {
    any_basis!(fields_are_continuous, 1);
    any_basis!(fields_are_continuous, 2);
    any_basis!(fields_are_continuous, 3);
}

#[test]
fn lattices_conform_in_seven_and_eight_dimensions() {
    conforms::<7>("lattice", &|o, h| {
        Box::new(SimplexLattice::<7>::permutohedral(o, h).unwrap())
    });
    conforms::<8>("lattice", &|o, h| {
        Box::new(SimplexLattice::<8>::permutohedral(o, h).unwrap())
    });
    conforms::<8>("Kuhn lattice", &|o, h| {
        Box::new(SimplexLattice::<8>::kuhn(o, h).unwrap())
    });
}
