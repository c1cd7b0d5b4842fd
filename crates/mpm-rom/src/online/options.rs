//! The choices of a reduced run.

use serde::Deserialize;

use super::OnlineError;
use super::neighbours::Search;
use super::samples::SampleChoice;
use crate::words::words;

/// The choices of a reduced run; quadrature and update are independent of each other.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// The sample points 𝒫.
    pub samples: SampleChoice,
    /// What each of them counts in the sums for v̂ and x̂, unless the choice says it.
    pub weights: SampleWeights,
    /// Where the momentum balance of the nodes is summed.
    pub quadrature: Quadrature,
    /// How x̂ follows from the velocities of the sample points.
    pub update: Update,
    /// What happens at J ≤ 0.
    pub inverted: Inverted,
}

/// Weights ω_p of the sample points: v̂ = argmin Σ ω_p |∂g/∂x̂(X_p, x̂) v̂ − v_p|², and x̂ accordingly.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SampleWeights {
    /// 1 (the paper's).
    #[default]
    Equal,
    /// The number of material points that are nearer at rest to p than to other sample points (ours): sums over 𝒫 then stand for those over all points, wherever the points of 𝒫 crowd.
    Nearest,
}

/// The quadrature of nodal masses, momenta and forces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Quadrature {
    /// The material points that touch the nodes, with their masses.
    Lagrangian {
        /// How they are found.
        search: Search,
    },
    /// Points of space, ℓᴰ in every cell of the nodes' support.
    Eulerian {
        /// ℓ, points per axis of a cell; the paper's is 2.
        per_axis: usize,
    },
}

impl Quadrature {
    /// Whether its numbers are in range.
    ///
    /// # Errors
    /// [`OnlineError::Option`].
    pub(crate) fn check(&self) -> Result<(), OnlineError> {
        let (field, value, fits, expected) = match *self {
            Self::Lagrangian { search: Search::All } => return Ok(()),
            Self::Lagrangian {
                search: Search::Lists { skin },
            } => ("skin", skin, skin > 0.0 && skin.is_finite(), "positive and finite"),
            Self::Eulerian { per_axis } => ("per_axis", per_axis as f64, (1..=16).contains(&per_axis), "1 to 16"),
        };
        let error = OnlineError::Option { field, value, expected };
        fits.then_some(()).ok_or(error)
    }
}

/// What happens where the map has J ≤ 0 at a quadrature point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Inverted {
    /// The run ends with an error.
    #[default]
    Refuse,
    /// The point has the stress of the nearest F whose stretches are at least 0.1, which pushes it back; such points are counted in the step's report.
    Limit,
}

words! {
    /// How x̂ moves.
    Update {
        /// x̂ ← x̂ + Δt v̂; kinematic points have the velocity that takes them to their prescribed position (ours), so that errors at them do not add up.
        VelocityOnly = "velocity-only",
        /// x̂ = argmin Σ|g(X_p, x̂) − x_p|², begun at 2 x̂_n − x̂_{n−1}, with at most three steps (ours: the paper's searches typically end after two or three).
        #[default]
        PositionVelocity = "position-velocity",
    }
}
