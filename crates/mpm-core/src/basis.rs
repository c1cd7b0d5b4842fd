//! The one seam: where a particle sits → which nodes, with which weight and gradient.

use mpm_kernels::Entry;

use crate::{MpmError, Schedule};

/// A background discretisation: shape functions w_i that sum to one.
///
/// The step is written once over this trait; a uniform B-spline grid, a simplex lattice and an unstructured mesh are
/// implementations. A basis groups particles into *cells*, in which all particles touch the same nodes, so that node
/// numbers are looked up once per cell.
///
/// # Safety
/// [`scatter`](crate::scatter) writes to the nodes of all groups of one colour concurrently, without locks. From one rebuild
/// to the next, therefore, and on every call:
///
/// * [`schedule`](Self::schedule) is the same, and no group occurs twice among its colours;
/// * [`cell_nodes`](Self::cell_nodes) of cells in two different groups of one colour have no node number in common.
///
/// Everything else an implementation may get wrong leads to wrong results or a panic, not to a data race.
#[allow(unsafe_code)]
pub unsafe trait Basis<const D: usize>: Sync {
    /// Activate the nodes that these positions touch, number them 0..n, and lay out the particles by cell.
    ///
    /// Afterwards particle `k` of the schedule is particle `schedule().order()[k]` of `positions`. After an error the basis
    /// is of no use until a rebuild succeeds.
    ///
    /// # Errors
    /// [`MpmError::PositionOutOfRange`], [`MpmError::TooManyNodes`].
    fn rebuild(&mut self, positions: &[[f64; D]]) -> Result<(), MpmError>;

    /// Order of the particles, their cells, and which cells may work side by side.
    fn schedule(&self) -> &Schedule;

    /// Number of active nodes n.
    fn node_count(&self) -> usize;

    /// Positions of all active nodes, in the order of their numbers.
    fn node_positions(&self, out: &mut Vec<[f64; D]>);

    /// Length h over which the basis resolves a field.
    fn spacing(&self) -> f64;

    /// Nodes that one particle touches, the same for all; nodes on which its weight and gradient vanish count too.
    fn stencil_size(&self) -> usize;

    /// The [`stencil_size`](Self::stencil_size) node numbers that the particles of `cell` touch, in the order of
    /// [`for_each_node`](Self::for_each_node).
    fn cell_nodes(&self, cell: usize, nodes: &mut Vec<u32>);

    /// Visit the stencil of a particle at `x`: place in [`cell_nodes`](Self::cell_nodes), weight, gradient, offset.
    fn for_each_node(&self, x: &[f64; D], visit: impl FnMut(usize, &Entry<D>));

    /// Visit the stencil of a particle at `x` with weight and flux w_ip `value` + `scale` ∇w_ip.
    ///
    /// A basis of tensor products overrides it: the flux of an isotropic stress needs D + 1 products per node.
    #[inline(always)]
    fn for_each_flux(&self, x: &[f64; D], value: &[f64; D], scale: f64, mut visit: impl FnMut(usize, f64, &[f64; D])) {
        self.for_each_node(x, |index, entry| {
            let flux = std::array::from_fn(|a| entry.weight * value[a] + scale * entry.gradient[a]);
            visit(index, entry.weight, &flux);
        });
    }

    /// w_ip D_p⁻¹ (x_i − x_p), by which APIC sends the affine part of a particle's velocity to node i, with
    /// D_p = Σ_i w_ip (x_i − x_p)(x_i − x_p)ᵀ; equals ∇w_ip for piecewise linear bases (Jiang et al. 2015, §5.3).
    fn affine_direction(&self, entry: &Entry<D>) -> [f64; D];

    /// Bytes held.
    fn storage_bytes(&self) -> usize;
}
