//! The simplex lattice as a basis: D + 1 nodes per particle.

mod dense_table;
mod node_box;
mod rebuild;

use mpm_kernels::{Deposit, Entry, SimplexGeometry, SimplexPoint};
use mpm_tensor::Matrix;

use self::dense_table::DenseTable;
use self::node_box::NodeBox;
use crate::basis::check_placement;
use crate::key_map::KeyMap;
use crate::{Basis, MpmError, Schedule, UniformBasis};

/// Rebuilds from one sort of the particles to the next. Sorting only keeps neighbours close in memory, and in a few steps no
/// particle goes far.
const SORT_INTERVAL: u32 = 8;

/// Hat functions on the simplices of a lattice ([`SimplexGeometry`]); only touched nodes are stored.
///
/// Nodes are found through a table over the bounding box of the cloud where the box holds few nodes per particle, else
/// through a hash map: the cost follows the particles, not the extent.
///
/// A node of which particles are far has next to no mass beside its gradient: bodies of solid want shorter steps than on splines.
#[derive(Debug)]
pub struct SimplexLattice<const D: usize> {
    geometry: SimplexGeometry<D>,
    /// The geometry as it was made, before any turn.
    upright: SimplexGeometry<D>,
    /// Integer coordinates of the touched nodes.
    node_box: NodeBox<D>,
    nodes: NodeTable<D>,
    node_count: usize,
    /// Where in its simplex every particle is, in schedule order.
    points: Vec<SimplexPoint<D>>,
    /// The D + 1 node numbers of every particle, from the base of its simplex on.
    stencils: Vec<u32>,
    schedule: Schedule,
    /// Rebuilds since particles were last sorted, that one included.
    age: u32,
    scratch: Scratch<D>,
}

/// How nodes get their numbers.
#[derive(Debug)]
enum NodeTable<const D: usize> {
    /// By place in the box.
    Dense(DenseTable),
    /// By place in a box that is too large to be stored.
    Packed(KeyMap<u64>),
    /// By coordinates, where even the places have no room in 53 bits.
    Whole(KeyMap<[i32; D]>),
}

/// Buffers of the rebuild, kept between steps.
#[derive(Clone, Debug, Default)]
struct Scratch<const D: usize> {
    keys: Vec<u32>,
    bin_starts: Vec<u32>,
    cursors: Vec<u32>,
    packed_cubes: KeyMap<u64>,
    whole_cubes: KeyMap<[i32; D]>,
}

impl<const D: usize> SimplexLattice<D> {
    /// A lattice of the given geometry.
    ///
    /// # Errors
    /// [`MpmError::InvalidParameter`] unless the spacing is positive and spacing and origin are finite.
    pub fn new(geometry: SimplexGeometry<D>) -> Result<Self, MpmError> {
        let mut lattice = Self {
            geometry,
            upright: geometry,
            node_box: NodeBox::default(),
            nodes: NodeTable::Dense(DenseTable::default()),
            node_count: 0,
            points: Vec::new(),
            stencils: Vec::new(),
            schedule: Schedule::default(),
            age: 0,
            scratch: Scratch::default(),
        };
        lattice.place(*geometry.origin(), geometry.spacing())?;
        Ok(lattice)
    }

    /// The lattice A_D* ([`SimplexGeometry::permutohedral`]).
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn permutohedral(origin: [f64; D], h: f64) -> Result<Self, MpmError> {
        Self::new(SimplexGeometry::permutohedral(origin, h))
    }

    /// Kuhn's triangulation of cubes ([`SimplexGeometry::kuhn`]).
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn kuhn(origin: [f64; D], h: f64) -> Result<Self, MpmError> {
        Self::new(SimplexGeometry::kuhn(origin, h))
    }
}

impl<const D: usize> Basis<D> for SimplexLattice<D> {
    const LONE_PARTICLES: bool = true;
    type Cell = ();

    fn sort(&mut self, positions: &[[f64; D]]) -> Result<(), MpmError> {
        let result = self.measure(positions);
        if result.is_err() {
            self.schedule.clear();
        } else if self.age < SORT_INTERVAL && self.schedule.order.len() == positions.len() {
            self.keep_order();
        } else {
            self.sort_particles(positions);
        }
        result
    }

    fn activate(&mut self, sorted: &[[f64; D]]) -> Result<(), MpmError> {
        self.activate_nodes(sorted)
    }

    fn schedule(&self) -> &Schedule {
        &self.schedule
    }

    fn node_count(&self) -> usize {
        self.node_count
    }

    fn node_positions(&self, out: &mut Vec<[f64; D]>) {
        out.clear();
        let at = |node: &[f64; D]| self.geometry.node_position(node);
        match &self.nodes {
            NodeTable::Dense(table) => out.extend(table.active().map(|place| at(&self.node_box.node(place)))),
            NodeTable::Packed(map) => out.extend(map.keys().iter().map(|&place| at(&self.node_box.node(place)))),
            NodeTable::Whole(map) => out.extend(map.keys().iter().map(|node| at(&node.map(f64::from)))),
        }
    }

    fn spacing(&self) -> f64 {
        self.geometry.spacing()
    }

    fn stencil_size(&self) -> usize {
        D + 1
    }

    #[inline(always)]
    fn cell_nodes<'a>(&'a self, cell: usize, _: &'a mut Vec<u32>) -> &'a [u32] {
        &self.stencils[cell * (D + 1)..][..D + 1]
    }

    #[inline(always)]
    fn for_each_node(&self, particle: usize, _: &[f64; D], visit: impl FnMut(usize, &Entry<D>)) {
        self.geometry.for_each(&self.points[particle], visit);
    }

    #[inline(always)]
    fn for_each_deposit(
        &self,
        particle: usize,
        _: &[f64; D],
        value: &Deposit<D>,
        scale: f64,
        visit: impl FnMut(usize, f64, &Deposit<D>),
    ) {
        self.geometry
            .for_each_deposit(&self.points[particle], value, scale, visit);
    }

    /// Hats are piecewise linear: ∇w_ip, also where D_p is singular (docs/theory.md, Eq. 23).
    #[inline(always)]
    fn affine_direction(&self, _: usize, _: &[f64; D], entry: &Entry<D>) -> [f64; D] {
        entry.gradient
    }

    fn storage_bytes(&self) -> usize {
        let s = &self.scratch;
        let words = [&self.stencils, &s.keys, &s.bin_starts, &s.cursors];
        let nodes = match &self.nodes {
            NodeTable::Dense(table) => table.storage_bytes(),
            NodeTable::Packed(map) => map.storage_bytes(),
            NodeTable::Whole(map) => map.storage_bytes(),
        };
        nodes
            + self.points.capacity() * size_of::<SimplexPoint<D>>()
            + s.packed_cubes.storage_bytes()
            + s.whole_cubes.storage_bytes()
            + words.iter().map(|v| v.capacity() * 4).sum::<usize>()
            + self.schedule.storage_bytes()
    }
}

impl<const D: usize> UniformBasis<D> for SimplexLattice<D> {
    fn place(&mut self, origin: [f64; D], h: f64) -> Result<(), MpmError> {
        check_placement(&origin, h)?;
        self.geometry.place(origin, h);
        Ok(())
    }

    fn turn(&mut self, rotation: &Matrix<D>) {
        let (origin, h) = (*self.geometry.origin(), self.geometry.spacing());
        self.geometry = self.upright.turned(rotation);
        self.geometry.place(origin, h);
    }

    fn cell_point(&self, fraction: &[f64; D], h: f64) -> [f64; D] {
        self.geometry.cell_point(fraction, h)
    }
}
