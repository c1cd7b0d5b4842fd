//! The Galerkin–Stein residual: how far the particles are from Stein's identity on a grid's shape functions.

use mpm_core::{Basis, MpmError, NodeSums, Sum};
use mpm_kernels::Deposit;
use mpm_tensor::vector::norm_squared;

/// R and what it would be for independent draws.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Residual {
    /// R = (Σ_i |f_i|² / (m_i + ε))^½ with f_i = Σ_p m_p (w_ip s_p + ∇w_ip), ε a tenth of the mean particle mass.
    pub value: f64,
    /// The root mean square of R for i.i.d. draws, E R² = Σ_i Σ_p m_p² |w_ip s_p + ∇w_ip|² / (m_i + ε), estimated on the
    /// same particles.
    pub of_independent_draws: f64,
}

impl Residual {
    /// R relative to i.i.d. draws.
    pub fn ratio(&self) -> f64 {
        self.value / self.of_independent_draws
    }
}

/// Mass and force of a node, and the squares of what the particles contributed to the force.
#[derive(Clone, Copy, Default)]
struct Node<const D: usize> {
    sum: Deposit<D>,
    variance: f64,
}

impl<const D: usize> Sum for Node<D> {
    fn merge(&mut self, other: &Self) {
        self.sum.add(&other.sum);
        self.variance += other.variance;
    }
}

/// The residual of equally heavy particles of total mass one, with scores `scores`, on `basis` (which is rebuilt).
///
/// Take a basis that the particles were not moved on: forces on the one they were moved on are small by construction.
///
/// # Errors
/// As [`Basis::rebuild`], and [`MpmError::FieldLength`] unless there are as many scores as positions.
pub fn galerkin_stein_residual<const D: usize, B: Basis<D>>(
    basis: &mut B,
    positions: &[[f64; D]],
    scores: &[[f64; D]],
) -> Result<Residual, MpmError> {
    galerkin_stein_residual_at(basis, positions, scores, |_| true)
}

/// As [`galerkin_stein_residual`], of the nodes whose numbers `counts`: on a bounded domain those whose functions vanish on its boundary, as Stein's identity has a boundary term for
/// the others.
pub(crate) fn galerkin_stein_residual_at<const D: usize, B: Basis<D>>(
    basis: &mut B,
    positions: &[[f64; D]],
    scores: &[[f64; D]],
    counts: impl Fn(usize) -> bool,
) -> Result<Residual, MpmError> {
    let (length, expected) = (scores.len(), positions.len());
    if length != expected {
        return Err(MpmError::FieldLength {
            field: "scores",
            length,
            expected,
        });
    }
    let sorted = basis.rebuild(positions)?;
    let order = basis.schedule().order();
    let mass = 1.0 / positions.len() as f64;
    let basis = &*basis;
    let mut nodes = NodeSums::<Node<D>>::default();
    nodes.scatter(basis, &sorted, |p, x, stencil| {
        let value = Deposit {
            scalar: mass,
            vector: scores[order[p] as usize].map(|s| mass * s),
        };
        basis.for_each_deposit(p, x, &value, mass, |index, _, deposit| {
            let node = stencil.node(index);
            node.sum.add(deposit);
            node.variance += norm_squared(&deposit.vector);
        });
    });
    let (mut square, mut expected) = (0.0, 0.0);
    for (_, node) in nodes
        .as_slice()
        .iter()
        .enumerate()
        .filter(|&(number, _)| counts(number))
    {
        let scale = 1.0 / (node.sum.scalar + 0.1 * mass);
        square += scale * norm_squared(&node.sum.vector);
        expected += scale * node.variance;
    }
    Ok(Residual {
        value: square.sqrt(),
        of_independent_draws: expected.sqrt(),
    })
}

#[cfg(test)]
mod tests {
    use mpm_core::SimplexLattice;

    use super::*;

    #[test]
    fn every_particle_needs_a_score() {
        let mut lattice = SimplexLattice::<2>::permutohedral([0.0; 2], 1.0).expect("a lattice");
        let positions = [[0.1, 0.2], [0.4, -0.3]];
        for length in [0, 1, 3] {
            let refused = galerkin_stein_residual(&mut lattice, &positions, &vec![[0.0; 2]; length]);
            let (field, expected) = ("scores", 2);
            assert_eq!(
                refused,
                Err(MpmError::FieldLength {
                    field,
                    length,
                    expected
                })
            );
        }
    }
}
