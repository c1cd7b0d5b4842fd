//! What `[run]` asks for.

use std::path::PathBuf;

use serde::Deserialize;

use super::beside::Choice;
use super::chosen::Chosen;
use super::options::{ChoiceName, ManifoldName, QuadratureName, SampleCount};
use crate::online::{
    Inverted, OnlineError, Options, Quadrature, ReducedBody, SampleChoice, SampleWeights, Search, Update,
};

/// The reduced runs of every test case: each manifold with each number of sample points, quadrature and update.
///
/// A `scene` of their own is the same body with other points, spacing or time step, which the network has not seen; it takes the same keys.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ReducedRuns {
    /// The scene's file, seen from the experiment's; that of the training if left out.
    pub scene: Option<PathBuf>,
    /// Families of maps.
    pub manifold: Vec<ManifoldName>,
    /// |𝒫|.
    pub samples: Vec<SampleCount>,
    /// Ways to choose them.
    pub choice: Vec<ChoiceName>,
    /// Seed of the draws of sample points.
    pub seed: u64,
    /// Exchanges that are tried on training runs (with the first quadrature and update), of greedily chosen points where they are 24 at most.
    pub exchanges: usize,
    /// What sample points count: `"equal"`, the paper's, or `"nearest"`, each the number of points that are nearest to it.
    pub weights: SampleWeights,
    /// Quadratures.
    pub quadrature: Vec<QuadratureName>,
    /// Updates.
    pub update: Vec<Update>,
    /// Time steps of reduced runs in those of the full-order run; each must divide the steps of a frame.
    pub step_factor: Vec<u64>,
    /// ℓ of the Eulerian quadrature.
    pub points_per_axis: usize,
    /// The skin of neighbour lists, in grid spacings.
    pub skin: f64,
    /// What happens at quadrature points with J ≤ 0: `"refuse"` ends the run, `"limit"` goes on with a limited F there and counts them.
    pub inverted: Inverted,
    /// Super-resolution: the file of a scene of the same body with more points, seen from the experiment's. Reduced runs are then also compared with its full-order runs, at its points,
    /// and so are tracers on the runs of the scene itself. Linear manifolds know their own points only and are left out.
    pub super_resolution: Option<PathBuf>,
    /// Whether every reduced run writes its frames as `.vtu` files, at the points of the super-resolution or else at those that errors are taken at.
    pub vtu: bool,
}

impl Default for ReducedRuns {
    fn default() -> Self {
        Self {
            scene: None,
            manifold: vec![ManifoldName::Network],
            samples: vec![SampleCount::Drawn(50), SampleCount::All],
            choice: vec![ChoiceName::default()],
            seed: 0,
            exchanges: 0,
            weights: SampleWeights::default(),
            quadrature: vec![QuadratureName::Lagrangian],
            update: vec![Update::default()],
            step_factor: vec![1],
            points_per_axis: 2,
            skin: 0.5,
            inverted: Inverted::Refuse,
            super_resolution: None,
            vtu: false,
        }
    }
}

impl ReducedRuns {
    /// The numbers of sample points that are not all.
    pub(super) fn counts(&self) -> impl Iterator<Item = usize> {
        self.samples.iter().filter_map(|samples| samples.count())
    }

    /// Whether sample points are chosen on training runs.
    pub(super) fn chooses_on_training(&self) -> bool {
        self.counts().next().is_some() && self.choice.iter().any(|choice| choice.needs_training())
    }

    /// The sample points of a run of this body; `chosen` has those that are chosen on training runs.
    pub(super) fn samples<const D: usize>(
        &self,
        choice: &Choice,
        chosen: &mut Chosen<D>,
        coordinates: usize,
        body: &ReducedBody<D>,
    ) -> Result<SampleChoice, OnlineError> {
        let (count, seed) = match choice.samples {
            SampleCount::All => return Ok(SampleChoice::All),
            SampleCount::Drawn(count) => (count, self.seed),
        };
        match choice.chosen {
            ChoiceName::Drawn => Ok(SampleChoice::Drawn { count, seed }),
            ChoiceName::Redrawn => Ok(SampleChoice::Redrawn { count, seed }),
            ChoiceName::Spread => Ok(SampleChoice::Spread { count, seed }),
            ChoiceName::Greedy | ChoiceName::Cubature => {
                let of = (choice.manifold, choice.network, choice.chosen, count);
                chosen.points(of, coordinates, body)
            }
        }
    }

    /// The options of one run with these sample points.
    pub(super) fn options(&self, choice: &Choice, samples: SampleChoice) -> Options {
        Options {
            samples,
            weights: self.weights,
            quadrature: match (choice.quadrature, choice.samples) {
                // All points are near a sample point when all are samples.
                (QuadratureName::Lagrangian, SampleCount::All) => Quadrature::Lagrangian { search: Search::All },
                (QuadratureName::Lagrangian, _) => Quadrature::Lagrangian {
                    search: Search::Lists { skin: self.skin },
                },
                (QuadratureName::Eulerian, _) => Quadrature::Eulerian {
                    per_axis: self.points_per_axis,
                },
            },
            update: choice.update,
            inverted: self.inverted,
        }
    }
}
