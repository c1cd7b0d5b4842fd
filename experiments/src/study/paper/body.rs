//! One setting of the paper's algorithms: what the sampler is told, and how tables name it.

use parvi::{Method, PaperOptions, ReferenceVolumes};

use super::configuration::Setting;
use crate::study::prelude::*;

/// What tells settings apart, seed and target apart: the columns, and the symbols that stand before their values.
pub const PARTS: [(&str, &str); 11] = [
    ("method", ""),
    ("variant", ""),
    ("material", ""),
    ("schedule", "α "),
    ("score", "force at "),
    ("volumes", "V⁰ "),
    ("friction", "friction "),
    ("spacing", "h "),
    ("time_step", "Δt "),
    ("particles", "M "),
    ("steps", "T "),
];

/// Whether a row is that of a rival, of which only method and size are settings.
pub fn is_rival(row: &Row) -> bool {
    row.text("variant").is_empty()
}

/// A value as a setting names it.
pub fn part(row: &Row, column: &str) -> String {
    match row.value(column).to_string() {
        empty if empty.is_empty() => "default".to_owned(),
        text => text,
    }
}

impl Setting {
    /// The rival, or the paper's algorithm.
    ///
    /// # Errors
    /// A parameter of the material that is out of range.
    pub fn method(&self) -> Result<Method, CommandError> {
        if let Some(rival) = &self.rival {
            return Ok(rival.method(None)?);
        }
        let material = self.material.material();
        Ok(Method::Paper(PaperOptions {
            affine: self.algorithm.get() == 2,
            material: material.map_err(|error| refusal("materials", error.to_string()))?,
            annealing: self.schedule,
            score_location: self.score.into(),
            spacing: self.spacing,
            steps: Some(self.steps.get()),
            time_step: self.time_step,
            friction: self.friction,
            guards: self.variant.guards(),
            coordinates: self.variant.coordinates,
            reference_volumes: self.volume,
            certificate: false,
            ..PaperOptions::default()
        }))
    }

    /// Notes in a row what is run.
    fn note(&self, row: &mut Row) {
        row.set("target", self.target.label());
        row.set("friction", self.friction);
        row.set("spacing", self.spacing);
        row.set("time_step", self.time_step);
        row.set("steps", self.steps);
        row.set("particles", self.particles);
        row.set("seed", self.seed);
        if let Some(rival) = &self.rival {
            row.set("method", rival.label());
            return;
        }
        let volumes = match self.volume {
            ReferenceVolumes::Uniform => "uniform",
            ReferenceVolumes::OfStartDensity => "of-start-density",
            ReferenceVolumes::OfGrid => "of-grid",
        };
        row.set("method", format!("algorithm {}", self.algorithm));
        row.set("variant", self.variant.text());
        row.set("material", self.material.text());
        row.set("schedule", self.schedule.to_string());
        row.set("score", self.score);
        row.set("volumes", volumes);
    }

    /// A name made of all of it.
    pub fn id(&self) -> String {
        let mut row = Row::default();
        self.note(&mut row);
        let named = |(column, symbol): (&str, &str)| {
            let word = match column {
                "method" if is_rival(&row) => "method ".to_owned(),
                "variant" | "material" => format!("{column} "),
                _ => symbol.to_owned(),
            };
            word + &part(&row, column)
        };
        let is_told = |(column, _): &(&str, &str)| !is_rival(&row) || ["method", "particles"].contains(column);
        let parts: Vec<String> = PARTS.into_iter().filter(is_told).map(named).collect();
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
        let case = Case::new(self.id(), self.clone()).costing(work * (stencil(dim) + looks));
        let mut case = case.with("dim", dim);
        self.note(&mut case.row);
        Ok(self.rival.iter().fold(case, Case::by))
    }
}
