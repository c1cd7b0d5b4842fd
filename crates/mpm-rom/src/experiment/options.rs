//! What a reduced run can be made with, by the words of the file.

use serde::Deserialize;

use crate::words::words;

/// Larger numbers of sample points are not tried: choices then differ little. The first one is taken.
pub(super) const MOST_TRIED: usize = 24;

/// How many sample points.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case", expecting = "expected a number of points or \"all\"")]
pub enum SampleCount {
    /// Every material point: the word `"all"`.
    All,
    /// So many.
    #[serde(untagged)]
    Drawn(usize),
}

impl SampleCount {
    /// The number; none for all of them.
    pub fn count(self) -> Option<usize> {
        match self {
            Self::Drawn(count) => Some(count),
            Self::All => None,
        }
    }
}

words! {
    /// How sample points are chosen; see [`SampleChoice`](crate::online::SampleChoice).
    ChoiceName {
        /// Drawn evenly, once for a run.
        Drawn = "drawn",
        /// Drawn evenly, anew in every step.
        Redrawn = "redrawn",
        /// Each the farthest from those before it.
        Spread = "spread",
        /// Those that stand for all points best in steps from frames of the training data ([`choose_greedily`](crate::online::choose_greedily)).
        #[default]
        Greedy = "greedy",
        /// Those with weights of their own that sum as all points do in such steps ([`choose_cubature`](crate::online::choose_cubature)).
        Cubature = "cubature",
    }
}

impl ChoiceName {
    /// Whether it is made on training runs.
    pub fn needs_training(self) -> bool {
        matches!(self, Self::Greedy | Self::Cubature)
    }
}

words! {
    /// Where the momentum balance is summed; see [`Quadrature`](crate::online::Quadrature).
    QuadratureName {
        /// At material points.
        #[default]
        Lagrangian = "lagrangian",
        /// At points of space.
        Eulerian = "eulerian",
    }
}

words! {
    /// The family of maps; see [`manifold`](crate::manifold).
    ManifoldName {
        /// The trained network.
        #[default]
        Network = "network",
        /// The linear manifold of as many coordinates from the same training data ([`Pod`](crate::manifold::Pod)).
        Linear = "linear",
    }
}
