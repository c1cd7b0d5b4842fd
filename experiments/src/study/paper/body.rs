//! One setting of the paper's algorithms: what the sampler is told, and how tables name it.

use parvi::{PaperMaterial, PaperOptions, ReferenceVolumes};

use super::configuration::Setting;
use crate::study::prelude::*;

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
