//! The rebuild, phase 5: the fit of every particle; and weights at any point, to look at them.

use mpm_core::{Basis, Member, MpmError};
use mpm_kernels::{Entry, LANES, Lanes};
use mpm_tensor::vector::subtract;
use rayon::prelude::*;

use super::cell_ring::{CellRing, side_by_side};
use super::exact::gradient_at;
use super::{MeshBasis, ParticleFit};
use crate::kernel::{Fit, Floor, RingLanes};
use crate::{Located, NO_CELL};

/// Weight and gradient of a node at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WeightAt<const D: usize> {
    /// The node: a vertex in the numbering of the basis.
    pub vertex: u32,
    /// Its weight, gradient and offset.
    pub entry: Entry<D>,
}

impl<const D: usize> MeshBasis<D> {
    /// Phase 5 (activate): where d′ of every particle are stored, and all fits.
    pub(super) fn fit_particles(&mut self, sorted: &[[f64; D]]) -> Result<(), MpmError> {
        let mut particles = std::mem::take(&mut self.particles);
        let mut samples = std::mem::take(&mut self.samples);
        let mut floors = std::mem::take(&mut self.floors);
        let mut gradients = std::mem::take(&mut self.gradients);
        let nothing = ParticleFit {
            fit: Fit::NOTHING,
            cell: NO_CELL,
            samples: 0,
        };
        particles.resize(sorted.len(), nothing);
        floors.resize(if self.positive { sorted.len() } else { 0 }, Floor::none(&Fit::NOTHING));
        let mut groups = 0;
        let schedule = &self.schedule;
        let mut shares = Vec::with_capacity(schedule.parts().len());
        let (mut rest, mut rest_of_floors) = (particles.as_mut_slice(), floors.as_mut_slice());
        for part in schedule.parts() {
            let first = groups;
            for cell in part.cells.clone() {
                groups += self.groups_of(cell) * schedule.cell(cell).len();
            }
            let count = schedule.particles(&part.cells).len();
            let (own, others) = rest.split_at_mut(count);
            let (own_floors, other_floors) = rest_of_floors.split_at_mut(count.min(rest_of_floors.len()));
            (rest, rest_of_floors) = (others, other_floors);
            shares.push((part, own, own_floors, first..groups));
        }
        if groups > u32::MAX as usize {
            let nodes = groups as u64;
            return Err(MpmError::TooManyNodes { nodes });
        }
        samples.resize(groups, Lanes::ZERO);
        gradients.resize(if self.is_exact() { groups } else { 0 }, [Lanes::ZERO; D]);
        let (mut rest, mut rest_of_gradients) = (samples.as_mut_slice(), gradients.as_mut_slice());
        let mut work = Vec::with_capacity(shares.len());
        for (part, particles, floors, groups) in shares {
            let (own, others) = rest.split_at_mut(groups.len());
            let (own_gradients, other_gradients) =
                rest_of_gradients.split_at_mut(groups.len().min(rest_of_gradients.len()));
            (rest, rest_of_gradients) = (others, other_gradients);
            work.push((part, (particles, floors), (own, own_gradients), groups.start));
        }
        work.into_par_iter()
            .for_each(|(part, (particles, floors), (samples, gradients), first)| {
                let points = &sorted[schedule.particles(&part.cells)];
                let (mut lanes, mut scratch) = (RingLanes::new(self.weight), Vec::new());
                let (mut solved, mut next, mut sample) = (0, 0, 0);
                for cell in part.cells.clone() {
                    let (range, length) = (schedule.cell(cell), self.groups_of(cell));
                    let mesh_cell = self.particle_cells[range.start];
                    let nodes = self.cell_nodes(cell, &mut scratch);
                    // The positions of active nodes, and their numbers, have just been written down: those of the mesh are farther away.
                    self.collect(mesh_cell, &mut lanes, nodes, &self.active_positions);
                    for x in &sorted[range] {
                        particles[next].cell = mesh_cell;
                        particles[next].samples = (first + sample) as u32;
                        let pending = self.push(mesh_cell, x, &mut lanes, sample);
                        next += 1;
                        sample += length;
                        if pending == LANES || next == particles.len() {
                            let fits = particles[solved..next].iter_mut().map(|particle| &mut particle.fit);
                            lanes.solve(self.spreads, samples, fits);
                            if !floors.is_empty() {
                                let own = particles[solved..next].iter_mut().zip(&mut floors[solved..next]);
                                for (k, (particle, floor)) in own.enumerate() {
                                    *floor = lanes.make_positive(k, self.spreads, samples, &mut particle.fit);
                                }
                            }
                            if !gradients.is_empty() {
                                let own = solved..next;
                                let fits = (&particles[own.clone()], floors.get(own.clone()).unwrap_or_default());
                                self.differentiate(&lanes, &points[own], fits, samples, gradients);
                            }
                            solved = next;
                        }
                    }
                }
            });
        (self.particles, self.samples) = (particles, samples);
        (self.floors, self.gradients) = (floors, gradients);
        Ok(())
    }

    /// Groups of lanes that d′ of a particle fill, by cell of the schedule.
    #[inline(always)]
    fn groups_of(&self, cell: usize) -> usize {
        (self.cell_node_starts[cell + 1] - self.cell_node_starts[cell]) / LANES
    }

    /// The ring of a cell, whose nodes have these numbers among `positions`.
    #[inline(always)]
    fn collect(&self, cell: u32, lanes: &mut RingLanes<D>, nodes: &[u32], positions: &[Lanes]) {
        let (ring, joined) = (self.stencils.groups(cell), self.stencils.joined(cell));
        let vertices = self.mesh().cell(cell as usize);
        let fours = nodes.as_chunks().0.iter();
        lanes.collect(vertices, ring, joined, fours.map(|&four| side_by_side(four, positions)));
    }

    /// Let a particle at `x` with the ring of a cell be solved next; where `x` is outside of it, with b of the nearest point.
    #[inline(always)]
    fn push(&self, cell: u32, x: &[f64; D], lanes: &mut RingLanes<D>, sample: usize) -> usize {
        let mut barycentric = self.search.barycentric(cell, x);
        if !self.search.is_inside(&barycentric) {
            barycentric = self.search.nearest_in_cell(cell, x).located.barycentric;
        }
        let width = self.width_at(cell, &barycentric);
        lanes.push(x, &barycentric, 1.0 / width, sample)
    }

    /// Visit place in the ring, d′ and position of the nodes of a particle.
    #[inline(always)]
    pub(super) fn for_each_sample(&self, particle: usize, mut visit: impl FnMut(usize, f64, &[f64; D])) {
        let ParticleFit { cell, samples, .. } = self.particles[particle];
        let (ring, vertices) = (self.stencils.ring(cell), self.mesh().vertices());
        let groups = &self.samples[samples as usize..][..ring.len().div_ceil(LANES)];
        for (index, &vertex) in ring.iter().enumerate() {
            let sample = groups[index / LANES].as_array()[index % LANES];
            visit(index, sample, &vertices[vertex as usize]);
        }
    }

    /// Four nodes of a particle at a time: d′ and offsets by component.
    #[inline(always)]
    pub(super) fn groups(&self, member: Member<CellRing<D>, D>) -> impl Iterator<Item = (Lanes, [Lanes; D])> {
        let ring = member.cell.groups();
        let samples = &self.samples[self.particles[member.particle].samples as usize..][..ring.len()];
        let mut point = [Lanes::ZERO; D];
        for a in 0..D {
            point[a] = Lanes::splat(member.x[a]);
        }
        ring.iter().zip(samples).map(move |(positions, &sample)| {
            let mut r = [Lanes::ZERO; D];
            for a in 0..D {
                r[a] = positions[a] - point[a];
            }
            (sample, r)
        })
    }

    /// All weights at a point, which need not be that of a particle; `None` outside the mesh.
    pub fn weights_at(&self, x: &[f64; D]) -> Option<Vec<WeightAt<D>>> {
        let Located { cell, .. } = self.search.locate(x, None)?;
        Some(self.weights_from(cell, x))
    }

    /// All weights that a particle at `x` has if it is taken to be in `cell`, in the numbering of the basis: on a face, the limits from either
    /// side.
    ///
    /// # Panics
    ///
    /// Where there is no such cell, as an index of a slice does.
    pub fn weights_from(&self, cell: u32, x: &[f64; D]) -> Vec<WeightAt<D>> {
        let (ring, mut lanes) = (self.stencils.ring(cell), RingLanes::new(self.weight));
        self.collect(cell, &mut lanes, self.stencils.groups(cell), self.stencils.vertices());
        let mut samples = vec![Lanes::ZERO; ring.len().div_ceil(LANES)];
        self.push(cell, x, &mut lanes, 0);
        let mut fit = Fit::NOTHING;
        lanes.solve(false, &mut samples, [&mut fit]);
        let mut floor = Floor::none(&fit);
        if self.positive {
            floor = lanes.make_positive(0, false, &mut samples, &mut fit);
        }
        let gradients = self.is_exact().then(|| {
            let mut gradients = vec![[Lanes::ZERO; D]; samples.len()];
            let particle = ParticleFit { fit, cell, samples: 0 };
            self.differentiate(&lanes, &[*x], (&[particle], &[floor]), &samples, &mut gradients);
            gradients
        });
        let entry = |(index, (&vertex, sample))| {
            let node = &self.mesh().vertices()[vertex as usize];
            let mut entry = fit.entry(&floor, sample, subtract(node, x));
            if let Some(gradients) = &gradients {
                entry.gradient = gradient_at(gradients, index);
            }
            WeightAt { vertex, entry }
        };
        let samples = samples.into_iter().flat_map(Lanes::to_array);
        ring.iter().zip(samples).enumerate().map(entry).collect()
    }

    /// Smallest weight in a cell, in the numbering of the basis, over the points with barycentric coordinates k / `divisions`, k whole; negative weights are
    /// small inside a mesh of usual shape and larger at its boundary.
    ///
    /// # Panics
    ///
    /// Where there is no such cell, as an index of a slice does.
    pub fn minimum_weight(&self, cell: u32, divisions: usize) -> f64 {
        let vertices = self.mesh().cell(cell as usize);
        let mut least = f64::INFINITY;
        let mut shares = vec![0; D + 1];
        shares[0] = divisions;
        loop {
            let x: [f64; D] = std::array::from_fn(|a| {
                let corner = |n: usize| self.mesh().vertices()[vertices[n] as usize][a];
                let sum: f64 = (0..=D).map(|n| shares[n] as f64 * corner(n)).sum();
                sum / divisions.max(1) as f64
            });
            let weights = self.weights_from(cell, &x);
            least = weights.iter().map(|weight| weight.entry.weight).fold(least, f64::min);
            // The next composition of `divisions`: what the first share with something left gives away moves on by one.
            let Some(n) = (0..D).find(|&n| shares[n] > 0) else {
                return least;
            };
            shares[n + 1] += 1;
            shares[0] = shares[n] - 1;
            if n > 0 {
                shares[n] = 0;
            }
        }
    }
}
