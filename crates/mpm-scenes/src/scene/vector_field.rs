//! Vectors that may differ from place to place.

use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};

/// A vector, or a field as in `{ kind = "rotation", centre = [0.0, 0.0], rate = [1.5] }`.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum VectorTable {
    /// The same everywhere.
    Uniform(Vec<f64>),
    /// Different from place to place.
    Field(VectorField),
}

/// A vector v as a function of the position X.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum VectorField {
    /// v = a sin(k · X + φ).
    Sine {
        /// a.
        amplitude: Vec<f64>,
        /// k, in radians per length.
        wave_vector: Vec<f64>,
        /// φ in radians. Default 0.
        #[serde(default)]
        phase: f64,
    },
    /// v = ω × (X − centre).
    Rotation {
        /// A point where v = 0.
        centre: Vec<f64>,
        /// ω, of a velocity in radians per time: one number in two dimensions, three in three.
        rate: Vec<f64>,
    },
    /// v = L (X − centre).
    Linear {
        /// A point where v = 0.
        centre: Vec<f64>,
        /// The rows of L.
        gradient: Vec<Vec<f64>>,
    },
    /// The velocity of a manufactured solution at t = 0.
    Manufactured {
        /// Its name.
        solution: String,
    },
}

impl<'de> Deserialize<'de> for VectorTable {
    fn deserialize<S: Deserializer<'de>>(deserializer: S) -> Result<Self, S::Error> {
        deserializer.deserialize_any(VectorVisitor)
    }
}

/// Not an untagged enum: that would forget what was wrong with the table.
struct VectorVisitor;

impl<'de> Visitor<'de> for VectorVisitor {
    type Value = VectorTable;

    fn expecting(&self, formatter: &mut std::fmt::Formatter) -> std::fmt::Result {
        formatter.write_str("a vector or a table with a kind")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, entries: A) -> Result<VectorTable, A::Error> {
        Vec::deserialize(SeqAccessDeserializer::new(entries)).map(VectorTable::Uniform)
    }

    fn visit_map<A: MapAccess<'de>>(self, entries: A) -> Result<VectorTable, A::Error> {
        VectorField::deserialize(MapAccessDeserializer::new(entries)).map(VectorTable::Field)
    }
}
