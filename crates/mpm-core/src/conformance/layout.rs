//! Who works when.

use super::AnyBasis;
use crate::NO_NODE;

/// The schedule of a basis rebuilt for `positions` is a permutation in cells and parts, and a part's cells touch no node outside its range.
///
/// # Panics
///
/// Where that is not so, with `what` in the message.
pub fn layout_is_sound<const D: usize>(basis: &dyn AnyBasis<D>, positions: &[[f64; D]], what: &str) {
    let schedule = basis.schedule();
    let mut order = schedule.order().to_vec();
    if schedule.keeps_order() {
        assert!(
            order.iter().copied().eq(0..positions.len() as u32),
            "{what}: order not kept"
        );
    }
    order.sort_unstable();
    assert!(
        order.iter().copied().eq(0..positions.len() as u32),
        "{what}: no permutation"
    );

    let mut next_particle = 0;
    for cell in 0..schedule.cell_count() {
        let particles = schedule.cell(cell);
        assert_eq!(
            particles.start, next_particle,
            "{what}: cells do not partition the particles"
        );
        assert!(!particles.is_empty(), "{what}: empty cell");
        next_particle = particles.end;
    }
    assert_eq!(next_particle, positions.len(), "{what}");

    let mut next_cell = 0;
    let mut scratch = Vec::new();
    for part in schedule.parts() {
        assert_eq!(part.cells.start, next_cell, "{what}: parts do not partition the cells");
        assert!(!part.cells.is_empty(), "{what}: empty part");
        next_cell = part.cells.end;
        assert!(part.nodes.end <= basis.node_count(), "{what}: a part beyond the nodes");
        for cell in part.cells.clone() {
            let touched = basis.cell_nodes(cell, &mut scratch).iter();
            for &node in touched.filter(|&&node| node != NO_NODE) {
                assert!(
                    part.nodes.contains(&(node as usize)),
                    "{what}: node {node} outside its part"
                );
            }
        }
    }
    assert_eq!(next_cell, schedule.cell_count(), "{what}");
}
