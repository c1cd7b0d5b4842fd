//! The first ring of a cell, four nodes side by side, for all particles of the cell.

use mpm_kernels::{LANES, Lanes};

use super::SampleWeight;

/// Four nodes of a ring. Where a ring ends within a group, the last node fills it up with η = 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct Group<const D: usize> {
    pub positions: [Lanes; D],
    /// η = `base` + Σ_n `slopes`\[n\] b_{n+1}, by b_0 = 1 − Σ_{n ≥ 1} b_n: A_i0, and A_i,n+1 − A_i0.
    pub base: Lanes,
    pub slopes: [Lanes; D],
}

/// Memory for the groups of one ring.
#[derive(Clone, Debug, Default)]
pub(crate) struct RingLanes<const D: usize> {
    pub(super) groups: Vec<Group<D>>,
}

impl<const D: usize> RingLanes<D> {
    /// Collect the ring of a cell: its vertices, and for each of them the set of the cell's vertices that it is joined to or is, vertex n being
    /// bit n.
    #[inline(always)]
    pub fn collect(&mut self, vertices: &[[f64; D]], cell: &[u32], ring: &[u32], joined: &[u8], weight: SampleWeight) {
        self.groups.clear();
        for (ring, joined) in ring.chunks(LANES).zip(joined.chunks(LANES)) {
            let mut positions = [[0.0; LANES]; D];
            let (mut base, mut slopes) = ([0.0; LANES], [[0.0; LANES]; D]);
            for lane in 0..LANES {
                let node = vertices[ring[lane.min(ring.len() - 1)] as usize];
                let set = match weight {
                    _ if lane >= ring.len() => 0,
                    SampleWeight::Continuous => joined[lane],
                    SampleWeight::CellAlone if !cell.contains(&ring[lane]) => 0,
                    SampleWeight::DistanceAlone | SampleWeight::CellAlone => u8::MAX,
                };
                let is_joined = |n: usize| f64::from(set >> n & 1);
                base[lane] = is_joined(0);
                for a in 0..D {
                    positions[a][lane] = node[a];
                    slopes[a][lane] = is_joined(a + 1) - base[lane];
                }
            }
            self.groups.push(Group {
                positions: positions.map(Lanes::new),
                base: Lanes::new(base),
                slopes: slopes.map(Lanes::new),
            });
        }
    }
}
