//! Where the nodes of a cell are, for all particles that work on it.

use mpm_kernels::{LANES, Lanes};

/// The positions of the nodes of a cell by component, four nodes side by side, in the groups of its ring.
#[derive(Clone, Debug, Default)]
pub struct CellRing<const D: usize> {
    positions: Vec<[Lanes; D]>,
}

impl<const D: usize> CellRing<D> {
    /// Those of the nodes with these numbers, of whole groups, in the place of what is there; `positions` has those of all nodes.
    #[inline(always)]
    pub(super) fn collect(&mut self, nodes: &[u32], positions: &[Lanes], mut visit: impl FnMut([u32; LANES])) {
        let fours = nodes.as_chunks().0;
        self.positions.resize(fours.len(), [Lanes::ZERO; D]);
        for (own, &four) in self.positions.iter_mut().zip(fours) {
            own.copy_from_slice(&side_by_side(four, positions)[..D]);
            visit(four);
        }
    }

    /// The groups.
    #[inline(always)]
    pub(super) fn groups(&self) -> &[[Lanes; D]] {
        &self.positions
    }
}

/// Four of the `positions` by component; only the first D have a meaning.
#[inline(always)]
pub(super) fn side_by_side([a, b, c, d]: [u32; LANES], positions: &[Lanes]) -> [Lanes; LANES] {
    let at = |node: u32| positions[node as usize];
    Lanes::transpose([at(a), at(b), at(c), at(d)])
}
