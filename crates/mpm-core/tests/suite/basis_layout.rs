//! Conformance of a basis, part: who works when.

use std::collections::{HashMap, HashSet};

use mpm_core::Basis;

/// The schedule is a permutation in cells, groups and colours, and groups of one colour share no node.
pub fn layout_is_sound<const D: usize, B: Basis<D>>(basis: &B, positions: &[[f64; D]], what: &str) {
    let schedule = basis.schedule();
    let mut order = schedule.order().to_vec();
    order.sort_unstable();
    assert!(
        order.iter().copied().eq(0..positions.len() as u32),
        "{what}: no permutation"
    );

    let (mut next_particle, mut next_cell) = (0, 0);
    for group in 0..schedule.group_count() {
        let cells = schedule.group(group);
        assert_eq!(cells.start, next_cell, "{what}: groups do not partition the cells");
        assert!(!cells.is_empty(), "{what}: empty group");
        assert_eq!(schedule.group_particles(group).start, next_particle);
        next_cell = cells.end;
        for cell in cells {
            let particles = schedule.cell(cell);
            assert_eq!(
                particles.start, next_particle,
                "{what}: cells do not partition the particles"
            );
            assert!(!particles.is_empty(), "{what}: empty cell");
            next_particle = particles.end;
        }
        assert_eq!(schedule.group_particles(group).end, next_particle);
    }
    assert_eq!(
        (next_cell, next_particle),
        (schedule.cell_count(), positions.len()),
        "{what}"
    );

    let mut coloured = HashSet::new();
    let mut cell_nodes = Vec::new();
    for groups in schedule.colours() {
        let mut owner = HashMap::new();
        for &group in groups {
            assert!(coloured.insert(group), "{what}: group {group} has two colours");
            for cell in schedule.group(group as usize) {
                basis.cell_nodes(cell, &mut cell_nodes);
                for &node in &cell_nodes {
                    let first = *owner.entry(node).or_insert(group);
                    assert_eq!(first, group, "{what}: two groups of one colour share node {node}");
                }
            }
        }
    }
    assert_eq!(coloured.len(), schedule.group_count(), "{what}: a group has no colour");
}
