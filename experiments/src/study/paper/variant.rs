//! How a run of the paper's algorithms departs from the paper.

use parvi::{Coordinates, Guards};
use parvi_options::words;

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
