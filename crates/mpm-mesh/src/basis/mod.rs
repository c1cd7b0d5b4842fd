//! The basis of UMLS-MPM.

mod activate;
mod cell_ring;
mod curve;
mod exact;
mod locate;
mod node_at;
mod one_by_one;
mod stencils;
mod transfers;
mod weights;

use std::sync::OnceLock;

use mpm_core::{Basis, CellSort, Member, MpmError, Schedule};
use mpm_kernels::{Columns, Deposit, Entry, Interpolated, LANES, Lanes, NodeField, NodeSink, Wanted};
use mpm_tensor::vector::{distance, subtract};

use self::cell_ring::CellRing;
use self::curve::AlongCurve;
use self::exact::{gradient_at, outlined};
pub(crate) use self::locate::all_found;
use self::node_at::VertexBoxes;
use self::stencils::Stencils;
pub use self::weights::WeightAt;
use crate::kernel::{Fit, Floor, Gradients};
use crate::{CellSearch, MeshError, SampleWeight, SimplexMesh};

/// What becomes of a particle that is in no cell.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Outside {
    /// The step is refused with [`MpmError::OutsideMesh`].
    #[default]
    Refuse,
    /// Up to a distance of `reach` from the mesh, a particle has the nodes of the nearest cell: b is that of the nearest point, offsets are its own, so that
    /// linear fields are still reproduced and momentum is conserved. Weights grow negative with the distance. Beyond, as
    /// [`Refuse`](Self::Refuse). For particles that overshoot a wall by a step.
    Extrapolate {
        /// The largest distance; length.
        reach: f64,
    },
}

/// h of the sample weights N₂(‖x_i − x_p‖ / h).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum KernelWidth {
    /// The longest edge of the mesh, for all particles (Cao et al. 2024, §4).
    #[default]
    LongestEdge,
    /// h(x) = Σ_n b_n(x) h_n over the vertices n of the cell, h_n the longest edge at vertex n: continuous, so weights and gradients stay so, and never less
    /// than the distance to a vertex of the cell, so that a fit exists. Where edges are equal it is their length. (The sizing field that §4 of the paper
    /// leaves to later work; the choice is ours.)
    Local,
}

/// What stands for the gradient of the weights, in the forces as in ∇v.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Gradient {
    /// d′_pi (β + Γ r_i): that of the fit (Cao et al. 2024, Eq. 29), not ∇ of w. Continuous; but ∫ g_i dV over the support of a node is zero only where nodes lie symmetrically, so that on an irregular mesh a constant stress
    /// pulls at nodes inside of a body, at any size of the mesh, and the body is too soft.
    #[default]
    Diffuse,
    /// ∇w_ip: ∫ ∇w_i dV = 0, and Σ ∇w = 0 and Σ ∇w rᵀ = I as of the other. It jumps at faces, by what η bends there. With
    /// [`SampleWeight::Smooth`], since with [`SampleWeight::Continuous`] a node that comes or goes has no mass and a gradient all the same.
    Exact,
}

/// UMLS-MPM (Cao et al. 2024, doi 10.1007/s00466-024-02524-x): a particle's nodes are the first ring of its cell, its
/// weights and gradients those of a moving least squares fit with sample weights [`SampleWeight::Continuous`].
///
/// With r_i = x_i − x_p, P_i = \[1, r_i\] and M_p = Σ_i d′_pi P_i P_iᵀ: (w_ip, g_ip) = d′_pi M_p⁻¹ P_i. So Σ w = 1, Σ w r = 0, Σ g = 0 and
/// Σ g rᵀ = I. The gradient g is *diffuse*: not ∇ of w. Both are continuous. Weights may be negative: hardly inside usual
/// meshes, and by a tenth in cells at the boundary, so a mesh should have a layer of cells around what particles reach. Where w passes through zero g does not: a node that only one
/// particle reaches has then no mass for the stress that acts on it, and turns the particle inside out; [`with_positive_weights`](Self::with_positive_weights) does away with that.
#[derive(Clone, Debug)]
pub struct MeshBasis<const D: usize> {
    search: CellSearch<D>,
    stencils: Stencils,
    /// Numbers of the cells and vertices in the mesh that the basis was made of.
    given_cells: Vec<u32>,
    given_vertices: Vec<u32>,
    weight: SampleWeight,
    outside: Outside,
    longest_edge: f64,
    shortest_edge: f64,
    /// h_n by vertex; empty where h is the longest edge.
    widths: Vec<f64>,
    /// Cells of the particles in schedule order.
    particle_cells: Vec<u32>,
    particles: Vec<ParticleFit<D>>,
    /// d′_pi of all particles, in the groups of their rings.
    samples: Vec<Lanes>,
    /// Whether weights are kept positive, and by what, by particle; empty unless they are.
    positive: bool,
    floors: Vec<Floor<D>>,
    /// ∇w of all particles, as `samples`; empty where gradients are diffuse.
    gradients: Vec<Gradients<D>>,
    gradient: Gradient,
    /// Whether D_p⁻¹ is computed.
    spreads: bool,
    /// Number by vertex; of no meaning where a vertex is not active.
    numbers: Vec<u32>,
    /// Vertex by number, ascending.
    active: Vec<u32>,
    /// Their positions, zeros behind the coordinates.
    active_positions: Vec<Lanes>,
    /// Node numbers of the cells of the schedule, in the groups of their rings, one cell after the other, and where those of a cell begin.
    cell_nodes: Vec<u32>,
    cell_node_starts: Vec<usize>,
    schedule: Schedule,
    cell_sort: CellSort,
    /// What is known of a vertex while numbers are given.
    marks: Vec<u8>,
    /// Made when a node is first asked for by its position.
    vertex_boxes: OnceLock<VertexBoxes<D>>,
}

/// What is kept of a particle from the activation on.
#[derive(Clone, Copy, Debug)]
struct ParticleFit<const D: usize> {
    fit: Fit<D>,
    cell: u32,
    /// Where its d′ begin, in groups.
    samples: u32,
}

impl<const D: usize> MeshBasis<D> {
    /// A basis on a mesh, whose cells and vertices it renumbers along a curve in space ([`mesh`](Self::mesh)).
    ///
    /// # Errors
    /// [`MeshError`], where the renumbered mesh is refused; that of a valid mesh is not.
    pub fn new(mesh: &SimplexMesh<D>) -> Result<Self, MeshError> {
        const { assert!(D <= 3, "a mass and a vector have to fit into four lanes") }
        let AlongCurve { mesh, cells, vertices } = AlongCurve::new(mesh)?;
        let lengths = mesh.edge_lengths();
        Ok(Self {
            stencils: Stencils::new(&mesh),
            search: CellSearch::new(mesh),
            given_cells: cells,
            given_vertices: vertices,
            weight: SampleWeight::default(),
            outside: Outside::default(),
            longest_edge: lengths.longest,
            shortest_edge: lengths.shortest,
            widths: Vec::new(),
            particle_cells: Vec::new(),
            particles: Vec::new(),
            samples: Vec::new(),
            positive: false,
            floors: Vec::new(),
            gradients: Vec::new(),
            gradient: Gradient::default(),
            spreads: true,
            numbers: Vec::new(),
            active: Vec::new(),
            active_positions: Vec::new(),
            cell_nodes: Vec::new(),
            cell_node_starts: Vec::new(),
            schedule: Schedule::default(),
            cell_sort: CellSort::default(),
            marks: Vec::new(),
            vertex_boxes: OnceLock::new(),
        })
    }

    /// The same basis with other sample weights.
    pub fn with_sample_weight(mut self, weight: SampleWeight) -> Self {
        self.weight = weight;
        self
    }

    /// The same basis with weights that are positive wherever a particle is inside the hull of its ring, or again with those of least squares, which need not be.
    ///
    /// w = d′ ψ(α + β·r) with ψ(s) = s for s ≥ θ = 1 / (4 Σ d′) and θ² / (2θ − s) below, and Σ w = 1, Σ w r = 0; gradients are those of the fit with the sample weights d′ ψ′. Particles without a weight
    /// below θ d′ have those of the paper, to the bit.
    pub fn with_positive_weights(mut self, positive: bool) -> Self {
        self.positive = positive;
        self
    }

    /// The same basis with other gradients.
    pub fn with_gradient(mut self, gradient: Gradient) -> Self {
        self.gradient = gradient;
        self
    }

    /// The same basis with another width of the sample weights.
    pub fn with_kernel_width(mut self, width: KernelWidth) -> Self {
        self.widths = match width {
            KernelWidth::LongestEdge => Vec::new(),
            KernelWidth::Local => longest_edges(self.mesh()),
        };
        self
    }

    /// The same basis with another rule for particles outside the mesh.
    pub fn with_outside(mut self, outside: Outside) -> Self {
        self.outside = outside;
        self
    }

    /// The mesh in the numbering of the basis.
    pub fn mesh(&self) -> &SimplexMesh<D> {
        self.search.mesh()
    }

    /// The search for cells, in the numbering of the basis.
    pub fn search(&self) -> &CellSearch<D> {
        &self.search
    }

    /// The number that a cell of the basis had in the mesh that it was made of; the cell itself where there is none such.
    pub fn given_cell(&self, cell: u32) -> u32 {
        self.given_cells.get(cell as usize).copied().unwrap_or(cell)
    }

    /// As [`given_cell`](Self::given_cell), for a vertex.
    pub fn given_vertex(&self, vertex: u32) -> u32 {
        self.given_vertices.get(vertex as usize).copied().unwrap_or(vertex)
    }

    /// Vertices, in the numbering of the basis, of the active nodes in the order of their numbers.
    pub fn active_vertices(&self) -> &[u32] {
        &self.active
    }

    /// Cells, in the numbering of the basis, that the particles are in, in schedule order.
    pub fn particle_cells(&self) -> &[u32] {
        &self.particle_cells
    }

    /// The largest h of the sample weights: the longest edge.
    pub fn kernel_width(&self) -> f64 {
        self.longest_edge
    }

    /// What keeps the weights of a particle positive.
    #[inline(always)]
    fn floor(&self, particle: usize) -> Floor<D> {
        let own = self.floors.get(particle).copied();
        own.unwrap_or_else(|| Floor::none(&self.particles[particle].fit))
    }

    /// h at a point of a cell, by its barycentric coordinates from vertex 1 on.
    #[inline(always)]
    fn width_at(&self, cell: u32, barycentric: &[f64; D]) -> f64 {
        if self.widths.is_empty() {
            return self.longest_edge;
        }
        let vertices = self.mesh().cell(cell as usize);
        let first = 1.0 - barycentric.iter().sum::<f64>();
        let shares = std::iter::once(&first).chain(barycentric);
        let each = shares.zip(vertices);
        each.map(|(share, &vertex)| share * self.widths[vertex as usize]).sum()
    }
}

/// The longest edge at each vertex; 0 where there is none.
fn longest_edges<const D: usize>(mesh: &SimplexMesh<D>) -> Vec<f64> {
    let neighbours = mesh.vertex_neighbours();
    let (vertices, lists) = (mesh.vertices(), neighbours.iter());
    let longest = |(x, list): (&[f64; D], &[u32])| {
        let lengths = list.iter().map(|&other| distance(x, &vertices[other as usize]));
        lengths.fold(0.0, f64::max)
    };
    vertices.iter().zip(lists).map(longest).collect()
}

impl<const D: usize> Basis<D> for MeshBasis<D> {
    const NODES_SIDE_BY_SIDE: bool = true;
    type Cell = CellRing<D>;

    fn sort(&mut self, positions: &[[f64; D]]) -> Result<(), MpmError> {
        let result = self.locate_particles(positions);
        match result {
            Ok(()) => self.sort_particles(),
            Err(_) => self.schedule = Schedule::default(),
        }
        result
    }

    fn activate(&mut self, sorted: &[[f64; D]]) -> Result<(), MpmError> {
        self.number_nodes();
        self.divide_cells();
        self.fit_particles(sorted)
    }

    fn expect_affine_directions(&mut self, read: bool) {
        self.spreads = read;
    }

    fn schedule(&self) -> &Schedule {
        &self.schedule
    }

    fn node_count(&self) -> usize {
        self.active.len()
    }

    fn node_positions(&self, out: &mut Vec<[f64; D]>) {
        let vertices = self.mesh().vertices();
        out.clear();
        out.extend(self.active.iter().map(|&vertex| vertices[vertex as usize]));
    }

    fn node_number(&self, position: &[f64; D]) -> Option<u32> {
        self.node_at(position)
    }

    /// The shortest edge: a wave must not cross a cell in one step. With exact gradients the least height of a cell, as ∇η goes with its inverse.
    fn spacing(&self) -> f64 {
        if self.is_exact() {
            self.search.least_height()
        } else {
            self.shortest_edge
        }
    }

    fn stencil_size(&self) -> usize {
        self.stencils.largest()
    }

    #[inline(always)]
    fn cell_stencil_size(&self, cell: usize) -> usize {
        self.cell_node_starts[cell + 1] - self.cell_node_starts[cell]
    }

    #[inline(always)]
    fn cell_nodes<'a>(&'a self, cell: usize, _: &'a mut Vec<u32>) -> &'a [u32] {
        &self.cell_nodes[self.cell_node_starts[cell]..self.cell_node_starts[cell + 1]]
    }

    #[inline(always)]
    fn enter(&self, cell: usize, ring: &mut CellRing<D>) {
        ring.collect(self.cell_nodes(cell, &mut Vec::new()), &self.active_positions, |_| {});
    }

    #[inline(always)]
    fn enter_by_fours(&self, cell: usize, ring: &mut CellRing<D>, node_count: usize, visit: impl FnMut([u32; LANES])) {
        let positions = &self.active_positions[..node_count]; // no second check per node
        ring.collect(self.cell_nodes(cell, &mut Vec::new()), positions, visit);
    }

    #[inline(always)]
    fn for_each_node(&self, particle: usize, x: &[f64; D], mut visit: impl FnMut(usize, &Entry<D>)) {
        let (fit, floor) = (&self.particles[particle].fit, self.floor(particle));
        let gradients = self.gradients_of(particle);
        self.for_each_sample(particle, |index, sample, node| {
            let mut entry = fit.entry(&floor, sample, subtract(node, x));
            if let Some(gradients) = gradients {
                entry.gradient = gradient_at(gradients, index);
            }
            visit(index, &entry);
        });
    }

    #[inline(always)]
    fn deposit<A: Columns<D>, S: Columns<D>>(
        &self,
        member: Member<CellRing<D>, D>,
        value: &Deposit<D>,
        affine: &A,
        flux: &S,
        sink: &mut impl NodeSink<D>,
    ) {
        if self.is_kept_positive(member.particle) {
            return self.deposit_one_by_one(member, value, affine, flux, sink);
        }
        if self.has_gradients() {
            return outlined(|| self.deposit_in_lanes::<true, _, _>(member, value, affine, flux, sink));
        }
        self.deposit_in_lanes::<false, _, _>(member, value, affine, flux, sink);
    }

    #[inline(always)]
    fn interpolate(
        &self,
        member: Member<CellRing<D>, D>,
        wanted: Wanted,
        nodes: &impl NodeField<D>,
    ) -> Interpolated<D> {
        if self.is_kept_positive(member.particle) {
            return self.interpolate_one_by_one(member, wanted, nodes);
        }
        if self.has_gradients() {
            return outlined(|| self.interpolate_in_lanes::<true>(member, wanted, nodes));
        }
        self.interpolate_in_lanes::<false>(member, wanted, nodes)
    }

    #[inline(always)]
    fn deposit_scalars<const N: usize>(
        &self,
        member: Member<CellRing<D>, D>,
        scalars: [f64; N],
        sums: [&mut [f64]; N],
    ) {
        self.deposit_scalars_in_lanes(member, scalars, sums);
    }

    #[inline(always)]
    fn interpolate_scalar(&self, member: Member<CellRing<D>, D>, nodes: &[f64]) -> f64 {
        self.interpolate_scalar_in_lanes(member, nodes)
    }

    #[inline(always)]
    fn affine_direction(&self, particle: usize, _: &[f64; D], entry: &Entry<D>) -> [f64; D] {
        self.particles[particle].fit.direction(entry)
    }

    /// The mesh itself is not counted.
    fn storage_bytes(&self) -> usize {
        let words = [
            &self.given_cells,
            &self.given_vertices,
            &self.particle_cells,
            &self.numbers,
            &self.active,
            &self.cell_nodes,
        ];
        self.search.storage_bytes()
            + self.stencils.storage_bytes()
            + self.schedule.storage_bytes()
            + self.cell_sort.storage_bytes()
            + words.iter().map(|v| v.capacity() * 4).sum::<usize>()
            + self.particles.capacity() * size_of::<ParticleFit<D>>()
            + self.floors.capacity() * size_of::<Floor<D>>()
            + self.gradients.capacity() * size_of::<Gradients<D>>()
            + (self.samples.capacity() + self.active_positions.capacity()) * size_of::<Lanes>()
            + (self.cell_node_starts.capacity() + self.widths.capacity()) * 8
            + self.marks.capacity()
            + self.vertex_boxes.get().map_or(0, VertexBoxes::storage_bytes)
    }
}
