//! What a deformation map says at a set of points.

use mpm_tensor::{Matrix, vector};

/// Which derivatives an evaluation carries beside the values.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Wanted {
    /// ∇_X g̃, the deformation gradient of the map.
    pub gradients: bool,
    /// ∂g̃/∂x̂.
    pub jacobians: bool,
}

impl Wanted {
    /// ∇_X g̃ alone.
    pub const GRADIENTS: Self = Self {
        gradients: true,
        jacobians: false,
    };

    /// ∂g̃/∂x̂ alone.
    pub const JACOBIANS: Self = Self {
        gradients: false,
        jacobians: true,
    };

    /// Both.
    pub const ALL: Self = Self {
        gradients: true,
        jacobians: true,
    };
}

/// Values and derivatives of a deformation map at P points; vectors that were not wanted are empty.
#[derive(Clone, Debug, Default)]
pub struct Evaluation<const D: usize> {
    /// g̃(X_p, x̂), P entries (m).
    pub positions: Vec<[f64; D]>,
    /// ∇_X g̃(X_p, x̂), P entries, row = component of g̃, column = axis of X.
    pub gradients: Vec<Matrix<D>>,
    /// ∂g̃/∂x̂ (X_p, x̂) as P × r columns: entry p r + k is ∂g̃/∂x̂_k at point p.
    pub jacobians: Vec<[f64; D]>,
    /// ∂g̃/∂x̂ (X_p, x̂) v̂, P entries (m/s), of an evaluation along rates v̂ ([`Manifold::evaluate_moving`](super::Manifold::evaluate_moving)).
    pub velocities: Vec<[f64; D]>,
}

/// ∂g̃/∂x̂ v̂ at every point, of `jacobians` as in an [`Evaluation`].
pub(crate) fn velocities<const D: usize>(jacobians: &[[f64; D]], rates: &[f64]) -> impl Iterator<Item = [f64; D]> {
    jacobians.chunks_exact(rates.len().max(1)).map(move |columns| {
        let mut velocity = [0.0; D];
        for (column, rate) in columns.iter().zip(rates) {
            vector::accumulate(&mut velocity, *rate, column);
        }
        velocity
    })
}
