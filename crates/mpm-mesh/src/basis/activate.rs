//! The rebuild, phases 3 and 4: active nodes and parts.

use mpm_kernels::LANES;
use rayon::prelude::*;

use super::MeshBasis;

/// Vertices that are looked at together when numbers are given.
const STRETCH: usize = 32;

/// Cells whose nodes are written down together.
const PIECE: usize = 1 << 10;

/// Of vertices: that of an occupied cell; that of its ring, which is what the former are joined to, and they themselves.
const OF_CELL: u8 = 1;
pub(super) const ACTIVE: u8 = 2;

impl<const D: usize> MeshBasis<D> {
    /// Phase 3 (activate): number the vertices that particles touch, in the order of the vertices, and write down those of every cell.
    pub(super) fn number_nodes(&mut self) {
        let vertex_count = self.mesh().vertices().len();
        self.marks.clear();
        self.marks.resize(vertex_count.next_multiple_of(STRETCH), 0);
        self.numbers.resize(vertex_count, 0);
        let (schedule, particle_cells) = (&self.schedule, &self.particle_cells);
        let cell_of = |cell: usize| particle_cells[schedule.cell(cell).start];
        let occupied = (0..schedule.cell_count()).map(cell_of);
        let (mesh, stencils) = (self.search.mesh(), &self.stencils);
        let (mut places, marks) = (0, self.marks.as_mut_slice());
        self.cell_node_starts.clear();
        self.cell_node_starts.push(0);
        for cell in occupied {
            places += stencils.groups(cell).len();
            self.cell_node_starts.push(places);
            for &vertex in mesh.cell(cell as usize) {
                marks[vertex as usize] = OF_CELL;
            }
        }
        for vertex in 0..vertex_count {
            if marks[vertex] & OF_CELL != 0 {
                marks[vertex] |= ACTIVE;
                for &joined in stencils.joined_to(vertex) {
                    marks[joined as usize] |= ACTIVE;
                }
            }
        }
        self.active.clear();
        for (stretch, marks) in self.marks.chunks_exact(STRETCH).enumerate() {
            if marks.iter().fold(0, |any, mark| any | mark) == 0 {
                continue;
            }
            for place in (0..STRETCH).filter(|&place| marks[place] & ACTIVE != 0) {
                let vertex = stretch * STRETCH + place;
                self.numbers[vertex] = self.active.len() as u32;
                self.active.push(vertex as u32);
            }
        }
        let active = self.active.iter();
        self.active_positions.clear();
        self.active_positions
            .extend(active.map(|&vertex| self.stencils.position(vertex)));
        self.cell_nodes.resize(places, 0);
        let (mut rest, numbers) = (self.cell_nodes.as_mut_slice(), self.numbers.as_slice());
        let mut pieces = Vec::with_capacity(schedule.cell_count().div_ceil(PIECE));
        for (piece, ends) in self.cell_node_starts[1..].chunks(PIECE).enumerate() {
            let filled = places - rest.len();
            let (own, others) = rest.split_at_mut(ends[ends.len() - 1] - filled);
            pieces.push((piece * PIECE, ends.len(), own));
            rest = others;
        }
        pieces.into_par_iter().for_each(|(first, count, mut nodes)| {
            for cell in first..first + count {
                let ring = stencils.groups(cell_of(cell));
                let (own, others) = nodes.split_at_mut(ring.len());
                for (nodes, vertices) in own.as_chunks_mut::<LANES>().0.iter_mut().zip(ring.as_chunks().0) {
                    *nodes = vertices.map(|vertex| numbers[vertex as usize]);
                }
                nodes = others;
            }
        });
    }

    /// Phase 4 (activate): cut the cells into parts. The nodes of a cell are in ascending order.
    pub(super) fn divide_cells(&mut self) {
        let (size, count) = (self.stencils.largest(), self.active.len());
        self.schedule.cut(size);
        let (nodes, starts) = (&self.cell_nodes, &self.cell_node_starts);
        for part in self.schedule.parts_mut() {
            let (mut low, mut high) = (u32::MAX, 0);
            for cell in part.cells.clone() {
                let (first, last) = (nodes[starts[cell]], nodes[starts[cell + 1] - 1]);
                (low, high) = (low.min(first), high.max(last));
            }
            part.nodes = low as usize..high as usize + 1;
        }
        self.schedule.join(count);
    }
}
