//! `facets.pressure`.

use serde::de::value::MapAccessDeserializer;
use serde::de::{Error, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};

/// A pressure, or one that differs from place to place, as in `{ kind = "hydrostatic", density = 1000.0, surface = [0.0, 2.0] }`.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum PressureTable {
    /// The same everywhere.
    Uniform(f64),
    /// Different from place to place.
    Field(PressureField),
}

/// A pressure p as a function of the position X.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum PressureField {
    /// That of a fluid at rest, p = ρ max(g · (X − surface), 0) with the scene's gravity g.
    Hydrostatic {
        /// ρ of the fluid.
        density: f64,
        /// A point of its surface.
        surface: Vec<f64>,
    },
}

impl<'de> Deserialize<'de> for PressureTable {
    fn deserialize<S: Deserializer<'de>>(deserializer: S) -> Result<Self, S::Error> {
        deserializer.deserialize_any(PressureVisitor)
    }
}

/// Not an untagged enum: that would forget what was wrong with the table.
struct PressureVisitor;

impl<'de> Visitor<'de> for PressureVisitor {
    type Value = PressureTable;

    fn expecting(&self, formatter: &mut std::fmt::Formatter) -> std::fmt::Result {
        formatter.write_str("a number or a table with a kind")
    }

    fn visit_f64<E: Error>(self, pressure: f64) -> Result<PressureTable, E> {
        Ok(PressureTable::Uniform(pressure))
    }

    fn visit_i64<E: Error>(self, pressure: i64) -> Result<PressureTable, E> {
        Ok(PressureTable::Uniform(pressure as f64))
    }

    fn visit_map<A: MapAccess<'de>>(self, entries: A) -> Result<PressureTable, A::Error> {
        PressureField::deserialize(MapAccessDeserializer::new(entries)).map(PressureTable::Field)
    }
}
