//! Uniform B-spline grid, stored as a hashed set of blocks of 64 nodes: memory follows the active nodes, time does not
//! depend on the number of nodes per axis.

mod activate;
mod block;
mod locate;
mod lookup;
mod sort;
mod template;
mod tile;

use mpm_kernels::{
    Columns, Deposit, Entry, Interpolated, Layout, NodeField, NodeSink, QuadraticCube, Spline, Stencil, UniformGrid,
    Wanted,
};

use self::block::{locate, node_at, slot_count};
use self::locate::ChunkRuns;
use self::lookup::NodeBlock;
use self::template::Template;
use self::tile::has_tiles;
use crate::basis::placed_grid;
use crate::key_map::KeyMap;
use crate::{Basis, Member, MpmError, Schedule, UniformBasis};

/// The nodes {origin + h i : i ∈ ℤᴰ} with tensor-product B-splines of kernel `S`; only touched nodes are stored.
#[derive(Clone, Debug)]
pub struct SplineGrid<S, const W: usize, const D: usize> {
    kernel: S,
    nodes: UniformGrid<D>,
    /// Where particles may be.
    limits: Option<([f64; D], [f64; D])>,
    template: Template<D>,
    /// Blocks that hold particles (the base of their stencil).
    particle_blocks: KeyMap<[i32; D]>,
    /// Blocks that hold active nodes.
    node_blocks: KeyMap<[i32; D]>,
    /// Active nodes of every one of them.
    blocks: Vec<NodeBlock>,
    node_count: usize,
    /// For every particle block, in lexicographic order, and slot of the template: number of the node block.
    neighbours: Vec<u32>,
    /// For every particle block, in lexicographic order: its number, and which of its 64 places hold particles, or which places of its tile
    /// they touch.
    sorted_blocks: Vec<u32>,
    occupied: Vec<u64>,
    /// For every cell of the schedule: the rank of its block if that is a tile, else (rank << 6) | place.
    cell_keys: Vec<u32>,
    /// For every tile of the schedule: which of its places its particles touch.
    touched: Vec<u64>,
    /// For every particle: place in the tile of the first node of its stencil.
    places: Vec<u16>,
    schedule: Schedule,
    scratch: Scratch<D>,
}

/// Buffers of the rebuild, kept between steps.
#[derive(Clone, Debug)]
struct Scratch<const D: usize> {
    chunks: Vec<ChunkRuns<D>>,
    /// Each block's rank.
    ranks: Vec<u32>,
    /// The key of its cell, for every particle; empty where particles stay in their order.
    keys: Vec<u32>,
    /// First particle per key.
    bin_starts: Vec<u32>,
    cursors: Vec<u32>,
}

impl<S: Spline<W>, const W: usize, const D: usize> SplineGrid<S, W, D> {
    /// A grid of spacing `h` with a node at `origin`.
    ///
    /// # Errors
    /// [`MpmError::InvalidParameter`] unless `h` is positive and `h` and `origin` are finite.
    pub fn new(origin: [f64; D], h: f64) -> Result<Self, MpmError> {
        const {
            assert!(
                slot_count::<D>(W) <= 1 << 16,
                "the stencil reaches more blocks than 16 bits can number"
            )
        }
        let mut grid = Self {
            kernel: S::default(),
            nodes: UniformGrid::new(origin, h),
            limits: None,
            template: Template::new(W),
            particle_blocks: KeyMap::default(),
            node_blocks: KeyMap::default(),
            blocks: Vec::new(),
            node_count: 0,
            neighbours: Vec::new(),
            sorted_blocks: Vec::new(),
            occupied: Vec::new(),
            cell_keys: Vec::new(),
            touched: Vec::new(),
            places: Vec::new(),
            schedule: Schedule::default(),
            scratch: Scratch {
                chunks: Vec::new(),
                ranks: Vec::new(),
                keys: Vec::new(),
                bin_starts: Vec::new(),
                cursors: Vec::new(),
            },
        };
        grid.place(origin, h)?;
        Ok(grid)
    }

    /// The same grid with another kernel of its kind.
    pub fn with_kernel(self, kernel: S) -> Self {
        Self { kernel, ..self }
    }

    /// The same grid, which refuses particles outside the box from `lower` to `upper`.
    ///
    /// # Errors
    /// [`MpmError::InvalidParameter`] unless the box is longer than nothing along every axis.
    pub fn with_limits(mut self, lower: [f64; D], upper: [f64; D]) -> Result<Self, MpmError> {
        for a in 0..D {
            let value = upper[a] - lower[a];
            if value.is_nan() || value <= 0.0 {
                let (field, expected) = ("upper limit - lower limit", "positive");
                return Err(MpmError::InvalidParameter { field, value, expected });
            }
        }
        self.limits = Some((lower, upper));
        Ok(self)
    }
}

impl<S: Spline<W>, const W: usize, const D: usize> SplineGrid<S, W, D> {
    /// Where a particle's nodes stand in its tile.
    #[inline(always)]
    fn layout(&self, particle: usize) -> Layout<D> {
        let first = self.places.get(particle).map_or(0, |&place| usize::from(place)); // there are none without tiles
        const { Layout::in_box(W, &tile::edges::<D>(W)) }.from(first)
    }

    /// The stencil of a particle, with its nodes at their places in the tile.
    #[inline(always)]
    fn stencil(&self, particle: usize, x: &[f64; D]) -> Stencil<W, D> {
        Stencil::of(&self.kernel, x, &self.nodes).at(self.layout(particle))
    }
}

impl<S: Spline<W>, const W: usize, const D: usize> UniformBasis<D> for SplineGrid<S, W, D> {
    fn place(&mut self, origin: [f64; D], h: f64) -> Result<(), MpmError> {
        self.nodes = placed_grid(origin, h)?;
        Ok(())
    }

    fn cell_point(&self, fraction: &[f64; D], h: f64) -> [f64; D] {
        fraction.map(|c| c * h)
    }
}

impl<S: Spline<W>, const W: usize, const D: usize> Basis<D> for SplineGrid<S, W, D> {
    type Cell = ();

    fn sort(&mut self, positions: &[[f64; D]]) -> Result<(), MpmError> {
        let sorted = self.sort_or_keep(positions);
        if sorted.is_err() {
            self.schedule.clear();
        }
        sorted
    }

    fn activate(&mut self, sorted: &[[f64; D]]) -> Result<(), MpmError> {
        if const { has_tiles::<D>() } && !self.schedule.keeps_order {
            self.locate_particles(sorted, 0)?; // the same tiles, and now the places of their particles
            self.rank_blocks();
        }
        self.activate_nodes()?;
        self.divide_cells();
        Ok(())
    }

    fn schedule(&self) -> &Schedule {
        &self.schedule
    }

    fn node_count(&self) -> usize {
        self.node_count
    }

    fn node_positions(&self, out: &mut Vec<[f64; D]>) {
        out.clear();
        out.reserve(self.node_count());
        for (block, active) in self.node_blocks.keys().iter().zip(&self.blocks) {
            let mut rest = active.mask;
            while rest != 0 {
                let node = node_at(block, rest.trailing_zeros());
                out.push(self.nodes.node_position(&node));
                rest &= rest - 1;
            }
        }
    }

    fn node_number(&self, position: &[f64; D]) -> Option<u32> {
        let u: [f64; D] = std::array::from_fn(|a| self.nodes.coordinate(position, a));
        let node = u.map(|u| u.round() as i32);
        let on_node = (0..D).all(|a| (u[a] - f64::from(node[a])).abs() < 1e-6);
        let (block, place) = locate(&node);
        let block = self.blocks[on_node.then(|| self.node_blocks.find(block))?? as usize];
        (block.mask >> place & 1 != 0).then(|| block.number(place as u8))
    }

    fn spacing(&self) -> f64 {
        self.nodes.spacing()
    }

    fn stencil_size(&self) -> usize {
        Stencil::<W, D>::SIZE
    }

    #[inline(always)]
    fn cell_stencil_size(&self, _: usize) -> usize {
        tile::size::<D>(W)
    }

    #[inline]
    fn cell_nodes<'a>(&'a self, cell: usize, scratch: &'a mut Vec<u32>) -> &'a [u32] {
        self.look_up(cell, scratch)
    }

    #[inline(always)]
    fn for_each_node(&self, particle: usize, x: &[f64; D], visit: impl FnMut(usize, &Entry<D>)) {
        self.stencil(particle, x).for_each(visit);
    }

    #[inline(always)]
    fn for_each_deposit(
        &self,
        particle: usize,
        x: &[f64; D],
        value: &Deposit<D>,
        scale: f64,
        visit: impl FnMut(usize, f64, &Deposit<D>),
    ) {
        self.stencil(particle, x).for_each_deposit(value, scale, visit);
    }

    #[inline(always)]
    fn deposit<A: Columns<D>, F: Columns<D>>(
        &self,
        Member { particle, x, .. }: Member<(), D>,
        value: &Deposit<D>,
        affine: &A,
        flux: &F,
        sink: &mut impl NodeSink<D>,
    ) {
        self.stencil(particle, x).deposit(value, affine, flux, sink);
    }

    #[inline(always)]
    fn interpolate(
        &self,
        Member { particle, x, .. }: Member<(), D>,
        wanted: Wanted,
        nodes: &impl NodeField<D>,
    ) -> Interpolated<D> {
        let with_slopes = wanted != Wanted::default();
        if const { S::IS_QUADRATIC && D == 3 }
            && with_slopes
            && let Some(cube) = QuadraticCube::new(x, &self.nodes, self.layout(particle))
        {
            return cube.interpolate(wanted, nodes);
        }
        self.stencil(particle, x).interpolate(wanted, nodes)
    }

    #[inline(always)]
    fn affine_direction(&self, _: usize, x: &[f64; D], entry: &Entry<D>) -> [f64; D] {
        match Stencil::<W, D>::of(&self.kernel, x, &self.nodes).second_moments() {
            None => entry.gradient,
            Some(moments) => std::array::from_fn(|a| entry.weight * entry.offset[a] / moments[a]),
        }
    }

    fn storage_bytes(&self) -> usize {
        let s = &self.scratch;
        let words = [
            &self.neighbours,
            &self.sorted_blocks,
            &self.cell_keys,
            &s.keys,
            &s.ranks,
            &s.bin_starts,
            &s.cursors,
        ];
        self.template.storage_bytes()
            + self.particle_blocks.storage_bytes()
            + self.node_blocks.storage_bytes()
            + self.blocks.capacity() * size_of::<NodeBlock>()
            + (self.occupied.capacity() + self.touched.capacity()) * 8
            + self.places.capacity() * 2
            + s.chunks.iter().map(ChunkRuns::storage_bytes).sum::<usize>()
            + words.iter().map(|v| v.capacity() * 4).sum::<usize>()
            + self.schedule.storage_bytes()
    }
}
