//! One setting of the paper's algorithms: what the sampler is told, and how tables name it.

use parvi::{Annealing, Coordinates, Guards, PaperMaterial, PaperOptions, ReferenceVolumes};

use super::configuration::Setting;
use crate::study::prelude::*;

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
        let all = Guards::default();
        let mut guards = Guards::none();
        match self {
            Self::Off => {}
            Self::MassWeightedForce => guards.mass_weighted_force = all.mass_weighted_force,
            Self::MassFloor => guards.mass_floor = all.mass_floor,
            Self::Courant => guards.courant = all.courant,
            Self::DisplacementLimit => guards.displacement_limit = all.displacement_limit,
            Self::On => guards = all,
        }
        guards
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

impl Setting {
    /// The options of the sampler; the material has been checked.
    pub fn options(&self, material: PaperMaterial) -> PaperOptions {
        PaperOptions {
            affine: self.algorithm.get() == 2,
            material,
            annealing: self.schedule.annealing(),
            score_location: self.score.into(),
            spacing: self.spacing,
            steps: Some(self.steps.get()),
            time_step: self.time_step,
            friction: self.friction,
            guards: self.variant.guards.guards(),
            coordinates: self.variant.coordinates,
            reference_volumes: self.volume,
            certificate: false,
            ..PaperOptions::default()
        }
    }

    /// Everything but target and seed: the column of the results, the name in labels, and the value.
    pub fn parts(&self) -> Vec<(&'static str, &'static str, String)> {
        let size = ("particles", "M", self.particles.to_string());
        if let Some(rival) = &self.rival {
            return vec![("method", "method", rival.label().to_owned()), size];
        }
        let number = |value: Option<f64>| value.map_or("default".to_owned(), |value| value.to_string());
        let volumes = match self.volume {
            ReferenceVolumes::Uniform => "uniform",
            ReferenceVolumes::OfStartDensity => "of-start-density",
            ReferenceVolumes::OfGrid => "of-grid",
        };
        vec![
            ("algorithm", "algorithm", self.algorithm.to_string()),
            ("variant", "variant", self.variant.text()),
            ("material", "material", self.material.text()),
            ("schedule", "α", self.schedule.text()),
            ("score", "force at", self.score.to_string()),
            ("volumes", "V⁰", volumes.to_owned()),
            ("friction", "friction", self.friction.to_string()),
            ("spacing", "h", number(self.spacing)),
            ("time_step", "Δt", number(self.time_step)),
            size,
            ("steps", "T", self.steps.to_string()),
        ]
    }

    /// A name made of all of them.
    pub fn id(&self) -> String {
        let parts = self.parts().into_iter();
        let parts: Vec<String> = parts.map(|(_, name, text)| format!("{name} {text}")).collect();
        format!("{}, {}, seed {}", self.target.label(), parts.join(", "), self.seed)
    }

    /// The case of it.
    ///
    /// # Errors
    /// A target that there is not.
    pub fn case(self) -> Result<Case<Self>, CommandError> {
        let looks = 100.0;
        let dim = self.target.dimension()?;
        let work = (self.particles.get() * self.steps.get()) as f64;
        let mut case = Case::new(self.id(), self.clone())
            .costing(work * (3f64.powi(dim as i32) + looks))
            .with("target", self.target.label())
            .with("dim", dim)
            .with("friction", self.friction)
            .with("spacing", self.spacing)
            .with("time_step", self.time_step)
            .with("steps", self.steps)
            .with("particles", self.particles)
            .with("seed", self.seed);
        for (column, _, text) in self.parts() {
            match column {
                "algorithm" => case.row.set("method", format!("algorithm {text}")),
                "method" | "variant" | "material" | "schedule" | "score" | "volumes" => case.row.set(column, text),
                _ => {}
            }
        }
        Ok(case)
    }
}
