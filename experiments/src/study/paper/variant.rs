//! How a run of the paper's algorithms departs from the paper, and α over its steps.

use parvi::{Annealing, Coordinates, Guards};

use crate::options::words;
use crate::study::prelude::*;

words! {
    /// Which of the guards a run has.
    GuardChoice {
        /// None, as the paper has it.
        Off,
        /// The force times the mass, alone.
        MassWeightedForce,
        /// The mass floor alone.
        MassFloor,
        /// The Courant condition alone.
        Courant,
        /// The displacement limit alone.
        DisplacementLimit,
        /// All.
        On,
    }
}

/// `{ guards = "off", coordinates = "own" }`: how far a run departs from the paper; these two are its algorithms as written.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Variant {
    /// Guards.
    pub guards: GuardChoice,
    /// Coordinates.
    pub coordinates: Coordinates,
}

impl Variant {
    /// The guards for the sampler.
    pub fn guards(self) -> Guards {
        let all = Guards::default();
        let mut guards = Guards::none();
        match self.guards {
            GuardChoice::Off => {}
            GuardChoice::MassWeightedForce => guards.mass_weighted_force = all.mass_weighted_force,
            GuardChoice::MassFloor => guards.mass_floor = all.mass_floor,
            GuardChoice::Courant => guards.courant = all.courant,
            GuardChoice::DisplacementLimit => guards.displacement_limit = all.displacement_limit,
            GuardChoice::On => guards = all,
        }
        guards
    }

    /// In words.
    pub fn text(self) -> String {
        match (self.guards, self.coordinates) {
            (GuardChoice::Off, Coordinates::Own) => "as written".to_owned(),
            (guards, Coordinates::Own) => format!("guards {guards}"),
            (guards, Coordinates::Frame) => format!("guards {guards}, frame"),
        }
    }
}

/// `{ shape = "geometric", from = 0.1, to = 1.0 }`: α over the steps, of either sign.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(tag = "shape", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Schedule {
    /// The same in every step.
    Constant {
        /// α.
        alpha: f64,
    },
    /// Geometric.
    Geometric {
        /// α in the first step.
        from: f64,
        /// α in the last step.
        to: f64,
    },
    /// Linear.
    Linear {
        /// α in the first step.
        from: f64,
        /// α in the last step.
        to: f64,
    },
    /// Linear, several times.
    Cyclic {
        /// α where a cycle begins.
        from: f64,
        /// α where it ends.
        to: f64,
        /// Their number.
        cycles: usize,
    },
}

impl Schedule {
    /// The schedule for the sampler.
    pub fn annealing(self) -> Annealing {
        match self {
            Self::Constant { alpha } => Annealing::Constant(alpha),
            Self::Geometric { from, to } => Annealing::Geometric { from, to },
            Self::Linear { from, to } => Annealing::Linear { from, to },
            Self::Cyclic { from, to, cycles } => Annealing::Cyclic { from, to, cycles },
        }
    }

    /// What is wrong with it.
    pub fn fault(self) -> Option<String> {
        self.annealing().of_either_sign().err().map(|error| error.to_string())
    }

    pub fn text(self) -> String {
        match self {
            Self::Constant { alpha } => format!("{alpha}"),
            Self::Geometric { from, to } => format!("geometric {from}…{to}"),
            Self::Linear { from, to } => format!("linear {from}…{to}"),
            Self::Cyclic { from, to, cycles } => format!("{cycles} × linear {from}…{to}"),
        }
    }
}
