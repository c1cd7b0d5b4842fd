//! Several meshes of one domain, of which one at a time is the basis.

use mpm_core::{Basis, MpmError, Schedule};
use mpm_kernels::Entry;
use mpm_mesh::{HatBasis, MeshError, SimplexMesh};
use rand::{Rng, RngExt};

/// How far a vertex goes towards a random point of a random neighbouring cell.
const AMPLITUDE: f64 = 0.7;

/// Hat functions on a mesh and on copies of it with inner vertices moved at random; vertices keep their numbers.
#[derive(Clone, Debug)]
pub struct Meshes<const D: usize> {
    bases: Vec<HatBasis<D>>,
    /// The one that particles meet.
    chosen: usize,
}

impl<const D: usize> Meshes<D> {
    /// The mesh itself, number 0, and `copies` of it.
    ///
    /// # Errors
    /// [`MeshError`]: a cell without volume.
    pub fn new(mesh: &SimplexMesh<D>, copies: usize, generator: &mut impl Rng) -> Result<Self, MeshError> {
        let mut bases = vec![HatBasis::new(mesh)];
        for _ in 0..copies {
            bases.push(HatBasis::new(&mesh.jittered(AMPLITUDE, || generator.random())?));
        }
        Ok(Self { bases, chosen: 0 })
    }

    /// The mesh itself.
    pub(super) fn mesh(&self) -> &SimplexMesh<D> {
        self.bases[0].mesh()
    }

    /// Choose the mesh, number 0, or one of its copies, counted round.
    pub(super) fn choose(&mut self, copy: usize) {
        self.chosen = copy % self.bases.len();
    }

    /// Choose the copy made last.
    pub(super) fn choose_last(&mut self) {
        self.chosen = self.bases.len() - 1;
    }

    /// The basis that particles meet.
    pub fn basis(&self) -> &HatBasis<D> {
        &self.bases[self.chosen]
    }
}

impl<const D: usize> Basis<D> for Meshes<D> {
    type Cell = ();

    fn sort(&mut self, positions: &[[f64; D]]) -> Result<(), MpmError> {
        self.bases[self.chosen].sort(positions)
    }

    fn activate(&mut self, sorted: &[[f64; D]]) -> Result<(), MpmError> {
        self.bases[self.chosen].activate(sorted)
    }

    fn schedule(&self) -> &Schedule {
        self.basis().schedule()
    }

    fn node_count(&self) -> usize {
        self.basis().node_count()
    }

    fn node_positions(&self, out: &mut Vec<[f64; D]>) {
        self.basis().node_positions(out);
    }

    /// That of the mesh itself.
    fn spacing(&self) -> f64 {
        self.bases[0].spacing()
    }

    fn stencil_size(&self) -> usize {
        self.basis().stencil_size()
    }

    #[inline(always)]
    fn cell_nodes<'a>(&'a self, cell: usize, scratch: &'a mut Vec<u32>) -> &'a [u32] {
        self.basis().cell_nodes(cell, scratch)
    }

    #[inline(always)]
    fn for_each_node(&self, particle: usize, x: &[f64; D], visit: impl FnMut(usize, &Entry<D>)) {
        self.basis().for_each_node(particle, x, visit);
    }

    #[inline(always)]
    fn affine_direction(&self, particle: usize, x: &[f64; D], entry: &Entry<D>) -> [f64; D] {
        self.basis().affine_direction(particle, x, entry)
    }

    fn storage_bytes(&self) -> usize {
        self.bases.iter().map(Basis::storage_bytes).sum()
    }
}
