//! The density that a grid sees of particles.

use mpm_core::{Basis, Masses, MpmError, NodeSums, gather};

/// ρ_h(x_p) = Σ_i w_ip m_i / h^D with m_i = Σ_p w_ip m_p, in the order of `positions`, on `basis` (which is rebuilt); every node has the volume h^D
/// (Stomakhin et al., *A material point method for snow simulation*, 2013, step 2).
pub(crate) fn grid_densities<const D: usize, B: Basis<D>>(
    basis: &mut B,
    positions: &[[f64; D]],
    masses: &Masses,
) -> Result<Vec<f64>, MpmError> {
    let sorted = basis.rebuild(positions)?;
    let basis = &*basis;
    let order = basis.schedule().order();
    let mut nodes = NodeSums::<f64>::default();
    nodes.scatter(basis, &sorted, |p, x, stencil| {
        let mass = masses.get(order[p] as usize);
        basis.for_each_node(p, x, |index, entry| *stencil.node(index) += entry.weight * mass);
    });
    let (nodes, volume) = (nodes.as_slice(), basis.spacing().powi(D as i32));
    let mut found = vec![0.0; positions.len()];
    gather(basis, found.as_mut_slice(), |found, k, p, numbers| {
        let mut mass = 0.0;
        basis.for_each_node(p, &sorted[p], |index, entry| {
            mass += entry.weight * nodes[numbers[index] as usize];
        });
        found[k] = mass / volume;
    });
    let mut densities = vec![0.0; positions.len()];
    for (&density, &particle) in found.iter().zip(order) {
        densities[particle as usize] = density;
    }
    Ok(densities)
}
