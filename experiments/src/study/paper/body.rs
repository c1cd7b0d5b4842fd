//! One setting of the paper's algorithms.

use parvi::{Annealing, Coordinates, Guards, PaperMaterial, PaperOptions, ReferenceVolumes};
use serde::Deserialize;

use super::material::MaterialTable;
use crate::options::Score;

/// Which of the guards a run has.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum GuardChoice {
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

impl GuardChoice {
    fn guards(self) -> Guards {
        let (none, all) = (Guards::none(), Guards::default());
        match self {
            Self::Off => none,
            Self::MassWeightedForce => Guards {
                mass_weighted_force: all.mass_weighted_force,
                ..none
            },
            Self::MassFloor => Guards {
                mass_floor: all.mass_floor,
                ..none
            },
            Self::Courant => Guards {
                courant: all.courant,
                ..none
            },
            Self::DisplacementLimit => Guards {
                displacement_limit: all.displacement_limit,
                ..none
            },
            Self::On => all,
        }
    }

    fn text(self) -> &'static str {
        match self {
            Self::Off => "off",
            Self::MassWeightedForce => "mass-weighted-force",
            Self::MassFloor => "mass-floor",
            Self::Courant => "courant",
            Self::DisplacementLimit => "displacement-limit",
            Self::On => "on",
        }
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
    /// In words.
    pub fn text(self) -> String {
        match (self.guards, self.coordinates) {
            (GuardChoice::Off, Coordinates::Own) => "as written".to_owned(),
            (guards, Coordinates::Own) => format!("guards {}", guards.text()),
            (guards, Coordinates::Frame) => format!("guards {}, frame", guards.text()),
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

    fn text(self) -> String {
        match self {
            Self::Constant { alpha } => format!("{alpha}"),
            Self::Geometric { from, to } => format!("geometric {from}…{to}"),
            Self::Linear { from, to } => format!("linear {from}…{to}"),
            Self::Cyclic { from, to, cycles } => format!("{cycles} × linear {from}…{to}"),
        }
    }
}

/// Everything that a run of Algorithm 1 or 2 is told beside target, M, T and seed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// 1 (PIC) or 2 (APIC).
    pub algorithm: usize,
    /// Guards and coordinates.
    pub variant: Variant,
    /// Ψ.
    pub material: MaterialTable,
    /// α(t).
    pub schedule: Schedule,
    /// Where the force acts.
    pub score: Score,
    /// V⁰_p.
    pub volumes: ReferenceVolumes,
    /// γ.
    pub friction: f64,
    /// h in units of the coordinates; `None`: the library's default.
    pub spacing: Option<f64>,
    /// Δt; `None`: the library's default for h.
    pub time_step: Option<f64>,
}

impl Body {
    /// The options of the sampler; the material has been checked.
    pub fn options(&self, material: PaperMaterial, steps: usize) -> PaperOptions {
        PaperOptions {
            affine: self.algorithm == 2,
            material,
            annealing: self.schedule.annealing(),
            score_location: self.score.into(),
            spacing: self.spacing,
            steps: Some(steps),
            time_step: self.time_step,
            friction: self.friction,
            guards: self.variant.guards.guards(),
            coordinates: self.variant.coordinates,
            reference_volumes: self.volumes,
            certificate: false,
            ..PaperOptions::default()
        }
    }

    /// Name and value of everything.
    pub fn parts(&self) -> [(&'static str, String); 9] {
        let number = |value: Option<f64>| value.map_or("default".to_owned(), |value| value.to_string());
        let volumes = match self.volumes {
            ReferenceVolumes::Uniform => "uniform",
            ReferenceVolumes::OfStartDensity => "of-start-density",
            ReferenceVolumes::OfGrid => "of-grid",
        };
        [
            ("algorithm", self.algorithm.to_string()),
            ("variant", self.variant.text()),
            ("material", self.material.text()),
            ("α", self.schedule.text()),
            ("force at", self.score.to_string()),
            ("V⁰", volumes.to_owned()),
            ("friction", self.friction.to_string()),
            ("h", number(self.spacing)),
            ("Δt", number(self.time_step)),
        ]
    }
}
