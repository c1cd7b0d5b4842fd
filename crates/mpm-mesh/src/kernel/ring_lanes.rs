//! First rings of cells, four nodes side by side, and the particles whose fits are still to be solved.

use std::ops::Range;

use mpm_kernels::{LANES, Lanes};

use super::SampleWeight;
use super::{LARGEST_COUNT, Sums};

/// Four nodes of a ring, and the sets of vertices of the cell that each is joined to, vertex n being bit n.
#[derive(Clone, Copy, Debug)]
pub(super) struct Group<const D: usize> {
    pub positions: [Lanes; D],
    pub joined: [u8; LANES],
}

impl<const D: usize> Group<D> {
    const NOTHING: Self = Self {
        positions: [Lanes::ZERO; D],
        joined: [0; LANES],
    };
}

/// A particle whose ring is collected.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pending<const D: usize> {
    pub point: [f64; D],
    /// max(η, 0), or η̃, by set of vertices.
    pub shares: [f64; SETS],
    pub inverse_h: f64,
    /// Where the groups of its ring and its d′ begin, and how many there are.
    group: usize,
    sample: usize,
    length: usize,
}

/// The last rings, and up to four particles. Four are solved side by side: what follows the sums over a ring is a chain of quotients.
#[derive(Clone, Debug)]
pub(crate) struct RingLanes<const D: usize> {
    pub(super) groups: Vec<Group<D>>,
    /// Those in use.
    used: usize,
    /// Sums over the ring of each particle.
    pub(super) sums: [Sums; LANES],
    pub(super) pending: [Pending<D>; LANES],
    pub(super) count: usize,
    weight: SampleWeight,
    /// Where the ring of the cell begins.
    start: usize,
}

/// Sets of up to four vertices.
pub(crate) const SETS: usize = 16;

/// Groups that are kept before those of no use are dropped.
const MANY: usize = 256;

/// All vertices of a cell.
const ALL: u8 = SETS as u8 - 1;

impl<const D: usize> Pending<D> {
    #[inline(always)]
    pub fn groups(&self) -> Range<usize> {
        self.group..self.group + self.length
    }

    #[inline(always)]
    pub fn samples(&self) -> Range<usize> {
        self.sample..self.sample + self.length
    }
}

impl<const D: usize> RingLanes<D> {
    /// No rings and no particles.
    pub fn new(weight: SampleWeight) -> Self {
        let nothing = Pending {
            point: [0.0; D],
            shares: [0.0; SETS],
            inverse_h: 0.0,
            group: 0,
            sample: 0,
            length: 0,
        };
        Self {
            groups: Vec::new(),
            used: 0,
            sums: [[Lanes::ZERO; LARGEST_COUNT]; LANES],
            pending: [nothing; LANES],
            count: 0,
            weight,
            start: 0,
        }
    }

    /// Collect the ring of the next cell: groups of its nodes, the sets of the cell's vertices that they are joined to or are (nothing where a node is
    /// repeated), and where they are, four by four.
    #[inline(always)]
    pub fn collect(
        &mut self,
        cell: &[u32],
        ring: &[u32],
        joined: &[u8],
        positions: impl Iterator<Item = [Lanes; LANES]>,
    ) {
        if self.used >= MANY {
            self.forget();
        }
        let sets = joined.as_chunks().0;
        (self.start, self.used) = (self.used, self.used + sets.len());
        if self.used > self.groups.len() {
            self.groups.resize(self.used, Group::NOTHING);
        }
        let groups = &mut self.groups[self.start..self.used];
        for ((group, positions), joined) in groups.iter_mut().zip(positions).zip(sets) {
            group.positions.copy_from_slice(&positions[..D]);
            group.joined = *joined;
        }
        if !self.weight.diminishes() {
            let groups = self.groups[self.start..self.used].iter_mut();
            for (group, ring) in groups.zip(ring.as_chunks::<LANES>().0) {
                for (set, vertex) in group.joined.iter_mut().zip(ring) {
                    let counts = self.weight == SampleWeight::DistanceAlone || cell.contains(vertex);
                    *set = if *set != 0 && counts { ALL } else { 0 };
                }
            }
        }
    }

    /// Drop the rings that no pending particle has.
    #[cold]
    fn forget(&mut self) {
        let pending = &mut self.pending[..self.count];
        let first = pending.first().map_or(self.used, |particle| particle.group);
        for particle in pending {
            particle.group -= first;
        }
        self.groups.copy_within(first..self.used, 0);
        self.used -= first;
    }

    /// A particle at `x` in the cell, by its barycentric coordinates from vertex 1 on; its d′ go to `sample` and behind. Returns how many are pending, at most
    /// four: then they have to be solved.
    #[inline(always)]
    pub fn push(&mut self, x: &[f64; D], barycentric: &[f64; D], inverse_h: f64, sample: usize) -> usize {
        self.pending[self.count] = Pending {
            point: *x,
            shares: self.shares(barycentric),
            inverse_h,
            group: self.start,
            sample,
            length: self.used - self.start,
        };
        self.count += 1;
        self.count
    }

    /// max(η, 0), or η̃, by set of vertices, η = Σ_{n in the set} b_n with b_0 = 1 − Σ_{n ≥ 1} b_n; `barycentric` has b_1 to b_D.
    #[inline(always)]
    fn shares(&self, barycentric: &[f64; D]) -> [f64; SETS] {
        if !self.weight.diminishes() {
            let mut all = [0.0; SETS];
            all[ALL as usize] = 1.0;
            return all;
        }
        let b = |n: usize| barycentric.get(n - 1).copied().unwrap_or(0.0);
        let first = 1.0 - barycentric.iter().sum::<f64>();
        let low = Lanes::new([0.0, first, b(1), first + b(1)]);
        let mut sets = [0.0; SETS];
        for (quarter, higher) in [0.0, b(2), b(3), b(2) + b(3)].into_iter().enumerate() {
            let shares = (low + Lanes::splat(higher)).fast_max(Lanes::ZERO).to_array();
            sets[quarter * LANES..][..LANES].copy_from_slice(&shares);
        }
        if self.weight == SampleWeight::Smooth {
            sets = sets.map(|eta| self.weight.share(eta).0);
        }
        sets
    }
}
