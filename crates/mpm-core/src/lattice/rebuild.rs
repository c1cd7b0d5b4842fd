//! The rebuild: from positions to simplices, node numbers and parts. Every particle is a cell of its own.

use std::ops::Range;
use std::sync::atomic::{AtomicU8, Ordering::Relaxed};

use mpm_kernels::{LANES, LARGEST_LATTICE_DIMENSION, Lanes, SimplexGeometry, SimplexPoint, groups};
use mpm_parallel::each;

use super::dense_table::DenseTable;
use super::node_box::NodeBox;
use super::{NodeTable, SimplexLattice};
use crate::counting_sort::counting_sort;
use crate::key_map::{Key, KeyMap};
use crate::{MpmError, Part, Schedule};

/// Particles of one piece of work.
const CHUNK: usize = 1 << 12;

/// A box of up to this many places, and so many more per particle, is stored: five bytes a place.
const FREE_PLACES: f64 = 65_536.0;
const PLACES_PER_PARTICLE: f64 = 16.0;

/// 2⁵²: added to a place below 2³², it leaves the place in the low bits; cheaper than a conversion that saturates.
const TO_BITS: f64 = 4_503_599_627_370_496.0;

/// Largest number of places that an `f64` counts exactly.
const EXACT: f64 = (1u64 << 53) as f64;

impl<const D: usize> SimplexLattice<D> {
    /// Phase 1 of the rebuild (sort): the box of the nodes, and the table that suits it.
    pub(super) fn measure(&mut self, positions: &[[f64; D]]) -> Result<(), MpmError> {
        self.node_box =
            NodeBox::around(positions, &self.geometry).map_err(|particle| MpmError::PositionOutOfRange {
                particle,
                position: positions[particle].to_vec(),
                spacing: self.geometry.spacing(),
            })?;
        let size = self.node_box.size();
        let storable = FREE_PLACES + PLACES_PER_PARTICLE * positions.len() as f64;
        if size <= storable.min(f64::from(i32::MAX)) {
            self.nodes.make_dense().clear(size as usize);
        } else if size <= EXACT {
            self.nodes.make_packed();
        } else {
            self.nodes.make_whole();
        }
        Ok(())
    }

    /// Phase 2 (sort), most of the time: all particles stay where they are.
    pub(super) fn keep_order(&mut self) {
        self.age += 1;
        let schedule = &mut self.schedule;
        if !schedule.keeps_order {
            schedule
                .order
                .iter_mut()
                .enumerate()
                .for_each(|(k, entry)| *entry = k as u32);
            schedule.keeps_order = true;
        }
    }

    /// Phase 2 (sort), every so often: sort the particles by the cube they are in, or by a row of cubes where these
    /// outnumber the particles. Cubes that are hashed come in the order in which they are met.
    pub(super) fn sort_particles(&mut self, positions: &[[f64; D]]) {
        let (geometry, node_box, s) = (&self.geometry, &self.node_box, &mut self.scratch);
        let base = |x: &[f64; D]| geometry.bases(&geometry.coordinates(&[*x; LANES]));
        let place = |x: &[f64; D]| node_box.places(&base(x)).to_array()[0];
        let bins = match &self.nodes {
            NodeTable::Dense(_) => {
                let (size, bins) = (node_box.size(), FREE_PLACES + positions.len() as f64);
                let shift = (size / bins).log2().ceil().max(0.0) as u32;
                let key = |x: &[f64; D]| (place(x) as i64 as u32) >> shift;
                s.keys.resize(positions.len(), 0);
                each(s.keys.chunks_mut(CHUNK).zip(positions.chunks(CHUNK)), &|(keys, xs)| {
                    keys.iter_mut().zip(xs).for_each(|(to, x)| *to = key(x));
                });
                (size as usize >> shift) + 1
            }
            NodeTable::Packed(_) => {
                let key = |x: &[f64; D]| place(x) as u64;
                number_all(&mut s.packed_cubes, positions.iter().map(key), &mut s.keys)
            }
            NodeTable::Whole(_) => {
                let key = |x: &[f64; D]| base(x).map(|c| c.to_array()[0] as i32);
                number_all(&mut s.whole_cubes, positions.iter().map(key), &mut s.keys)
            }
        };
        let Schedule { order, cell_starts, .. } = &mut self.schedule;
        counting_sort(&s.keys, bins, &mut s.bin_starts, order, &mut s.cursors);
        cell_starts.clear();
        cell_starts.extend(0..=order.len() as u32);
        self.schedule.lone_particles = true;
        self.schedule.keeps_order = false;
        self.age = 1;
    }

    /// Phase 3 (activate): where in its simplex every particle is, and the numbers of its nodes.
    pub(super) fn activate_nodes(&mut self, sorted: &[[f64; D]]) -> Result<(), MpmError> {
        self.stencils.resize(sorted.len() * (D + 1), 0);
        self.points.resize(sorted.len(), SimplexPoint::default());
        self.schedule.cut(D + 1);
        let (geometry, node_box) = (&self.geometry, &self.node_box);
        let (points, stencils, parts) = (&mut self.points, &mut self.stencils, &mut self.schedule.parts);
        self.node_count = match &mut self.nodes {
            NodeTable::Dense(table) => {
                mark(table.marks(), geometry, node_box, sorted, points, stencils);
                let count = table.number();
                let numbers = table.numbers();
                for_each_part(parts, stencils, D + 1, |stencils| {
                    number_stencils::<D>(stencils, numbers)
                });
                count
            }
            NodeTable::Packed(map) => {
                let strides = node_box.strides.map(|s| s as u64);
                let first = |bases: &[Lanes; D]| node_box.places(bases).to_array().map(|place| place as u64);
                let next = |key: u64, axis: usize| key + strides[axis];
                let count = number_nodes(map, geometry, sorted, points, stencils, first, next)?;
                for_each_part(parts, stencils, D + 1, |stencils| range_of(stencils));
                count
            }
            NodeTable::Whole(map) => {
                let first = |bases: &[Lanes; D]| {
                    let bases = bases.map(Lanes::to_array);
                    std::array::from_fn(|l| bases.map(|row| row[l] as i32))
                };
                let next = |mut key: [i32; D], axis: usize| {
                    key[axis] += 1;
                    key
                };
                let count = number_nodes(map, geometry, sorted, points, stencils, first, next)?;
                for_each_part(parts, stencils, D + 1, |stencils| range_of(stencils));
                count
            }
        };
        self.schedule.join(self.node_count);
        Ok(())
    }
}

/// Find every particle's simplex, write the places of its nodes to its stencil, and mark them in the table.
fn mark<const D: usize>(
    marks: &[AtomicU8],
    geometry: &SimplexGeometry<D>,
    node_box: &NodeBox<D>,
    sorted: &[[f64; D]],
    points: &mut [SimplexPoint<D>],
    stencils: &mut [u32],
) {
    let strides: [u32; LARGEST_LATTICE_DIMENSION] =
        std::array::from_fn(|a| node_box.strides.get(a).map_or(0, |&stride| stride as i64 as u32));
    let chunks = points.chunks_mut(CHUNK).zip(stencils.chunks_mut(CHUNK * (D + 1)));
    each(chunks.zip(sorted.chunks(CHUNK)), &move |((points, stencils), xs)| {
        let outputs = points.chunks_mut(LANES).zip(stencils.chunks_mut(LANES * (D + 1)));
        for ((points, stencils), xs) in outputs.zip(groups(xs)) {
            let (bases, inside) = geometry.simplices(&xs);
            let places = (node_box.places(&bases) + TO_BITS).to_array();
            let each = points.iter_mut().zip(stencils.chunks_exact_mut(D + 1));
            for (l, (point, stencil)) in each.enumerate() {
                *point = inside[l];
                let mut node = places[l].to_bits() as u32;
                for k in 0..D {
                    stencil[k] = node;
                    marks[node as usize].store(1, Relaxed);
                    node += strides[point.axis(k)];
                }
                stencil[D] = node;
                marks[node as usize].store(1, Relaxed);
            }
        }
    });
}

/// Let `work` finish the stencils of every part and say which nodes are in them.
fn for_each_part(
    parts: &mut [Part],
    mut stencils: &mut [u32],
    size: usize,
    work: impl Fn(&mut [u32]) -> Range<usize> + Sync,
) {
    let mut shares = Vec::with_capacity(parts.len());
    for part in parts {
        let (own, others) = stencils.split_at_mut(part.cells.len() * size);
        shares.push((part, own));
        stencils = others;
    }
    each(shares.into_iter(), &|(part, stencils): (&mut Part, &mut [u32])| {
        part.nodes = work(stencils);
    });
}

/// Replace places by node numbers. Both grow together, and along a stencil: its ends tell the range.
fn number_stencils<const D: usize>(stencils: &mut [u32], numbers: &[u32]) -> Range<usize> {
    let (mut low, mut high) = (u32::MAX, 0);
    for stencil in stencils.chunks_exact_mut(D + 1) {
        for node in stencil.iter_mut() {
            *node = numbers[*node as usize];
        }
        (low, high) = (low.min(stencil[0]), high.max(stencil[D]));
    }
    low as usize..high as usize + 1
}

/// From the lowest to the highest number.
fn range_of(stencils: &[u32]) -> Range<usize> {
    let (low, high) = stencils
        .iter()
        .fold((u32::MAX, 0), |(low, high), &node| (low.min(node), high.max(node)));
    low as usize..high as usize + 1
}

/// Find every particle's simplex, and number the nodes in the order in which they are met; returns how many there are.
fn number_nodes<K: Key, const D: usize>(
    map: &mut KeyMap<K>,
    geometry: &SimplexGeometry<D>,
    sorted: &[[f64; D]],
    points: &mut [SimplexPoint<D>],
    stencils: &mut [u32],
    first: impl Fn(&[Lanes; D]) -> [K; LANES],
    next: impl Fn(K, usize) -> K,
) -> Result<usize, MpmError> {
    map.clear();
    let outputs = points.chunks_mut(LANES).zip(stencils.chunks_mut(LANES * (D + 1)));
    for ((points, stencils), xs) in outputs.zip(groups(sorted)) {
        let (bases, inside) = geometry.simplices(&xs);
        let keys = first(&bases);
        let each = points.iter_mut().zip(stencils.chunks_exact_mut(D + 1));
        for (l, (point, stencil)) in each.enumerate() {
            *point = inside[l];
            let mut key = keys[l];
            stencil[0] = map.number(key);
            for k in 0..D {
                key = next(key, point.axis(k) % D);
                stencil[k + 1] = map.number(key);
            }
        }
        if map.keys().len() > (u32::MAX as usize) - LANES * (D + 1) {
            let nodes = map.keys().len() as u64;
            return Err(MpmError::TooManyNodes { nodes });
        }
    }
    Ok(map.keys().len())
}

/// Number keys in the order in which they are met; returns how many there are.
fn number_all<K: Key>(map: &mut KeyMap<K>, keys: impl Iterator<Item = K>, numbers: &mut Vec<u32>) -> usize {
    map.clear();
    numbers.clear();
    numbers.extend(keys.map(|key| map.number(key)));
    map.keys().len()
}

impl<const D: usize> NodeTable<D> {
    fn make_dense(&mut self) -> &mut DenseTable {
        if !matches!(self, Self::Dense(_)) {
            *self = Self::Dense(DenseTable::default());
        }
        match self {
            Self::Dense(table) => table,
            _ => unreachable!("it was made dense"),
        }
    }

    fn make_packed(&mut self) {
        if !matches!(self, Self::Packed(_)) {
            *self = Self::Packed(KeyMap::default());
        }
    }

    fn make_whole(&mut self) {
        if !matches!(self, Self::Whole(_)) {
            *self = Self::Whole(KeyMap::default());
        }
    }
}
