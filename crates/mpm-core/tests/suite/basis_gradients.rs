//! Conformance of a basis, part: gradients.

use mpm_core::conformance::AnyBasis;

use crate::scenes::{norm, stencil};

/// Bases whose gradient is no derivative by definition: the diffuse gradient of moving least squares.
const DIFFUSE: [&str; 0] = [];

/// What a point sees of a node.
#[derive(Clone, Copy)]
struct Seen<const D: usize> {
    weight: f64,
    gradient: [f64; D],
    /// Whether the node is in its stencil at all, with whatever weight.
    visited: bool,
}

impl<const D: usize> Seen<D> {
    const NOTHING: Self = Self {
        weight: 0.0,
        gradient: [0.0; D],
        visited: false,
    };
}

/// ∇w against central differences, where w has no kink within the step: hats have one at the points put on nodes.
pub fn gradients_are_derivatives<const D: usize>(
    name: &str,
    basis: &mut dyn AnyBasis<D>,
    positions: &[[f64; D]],
    what: &str,
) {
    if DIFFUSE.contains(&name) {
        return;
    }
    let h = basis.spacing();
    let step = 1e-5 * h;
    let sample: Vec<_> = positions.iter().filter(|x| norm(x) < 1e3 * h).take(20).collect();
    let (mut compared, mut kinks) = (0, 0);
    for x in sample {
        let moved = |a: usize, sign: f64| {
            let mut y = *x;
            y[a] += sign * step;
            y
        };
        let steps = (0..D).flat_map(|a| [moved(a, -1.0), moved(a, 1.0)]);
        let points: Vec<[f64; D]> = [*x].into_iter().chain(steps).collect();
        let seen = seen_by(basis, &points);
        // A basis may number nodes that none of these points touches.
        let nodes = seen
            .chunks(points.len())
            .filter(|of| of.iter().any(|seen| seen.visited));
        for of_node in nodes {
            for a in 0..D {
                let (before, here, after) = (of_node[1 + 2 * a], of_node[0], of_node[2 + 2 * a]);
                let bend = (after.weight - 2.0 * here.weight + before.weight).abs();
                // A line may also touch the support in the point alone, and see nothing on either side.
                let touches = here.weight.max(before.weight).max(after.weight) < 1e-12 && here.gradient[a] != 0.0;
                if bend > 1e-3 * step / h || touches {
                    kinks += 1;
                    continue;
                }
                compared += 1;
                let difference = (after.weight - before.weight) / (2.0 * step);
                assert!(
                    (here.gradient[a] - difference).abs() < 1e-6 / h,
                    "{what}: gradient {} for {difference}",
                    here.gradient[a]
                );
            }
        }
    }
    assert!(5 * kinks < compared, "{what}: {kinks} kinks, {compared} comparisons");
}

/// What each of the points sees of each node, all points of a node side by side.
fn seen_by<const D: usize>(basis: &mut dyn AnyBasis<D>, points: &[[f64; D]]) -> Vec<Seen<D>> {
    let sorted = basis.rebuild(points).unwrap();
    let schedule = basis.schedule();
    let mut seen = vec![Seen::NOTHING; points.len() * basis.node_count()];
    let mut scratch = Vec::new();
    for cell in 0..schedule.cell_count() {
        let nodes = basis.cell_nodes(cell, &mut scratch).to_vec();
        for place in schedule.cell(cell) {
            let point = schedule.order()[place] as usize;
            for (index, weight, gradient, _) in stencil(basis, place, &sorted[place]) {
                seen[nodes[index] as usize * points.len() + point] = Seen {
                    weight,
                    gradient,
                    visited: true,
                };
            }
        }
    }
    seen
}
