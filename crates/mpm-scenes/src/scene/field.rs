//! Vectors and pressures that may differ from place to place.

use std::fmt;
use std::marker::PhantomData;

use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Error, IntoDeserializer, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};

/// A value, or a field: a table with a `kind`.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Placed<T, F> {
    /// The same everywhere.
    Uniform(T),
    /// Different from place to place.
    Field(F),
}

/// A vector, or a field as in `{ kind = "rotation", centre = [0.0, 0.0], rate = [1.5] }`.
pub type VectorTable = Placed<Vec<f64>, VectorField>;

/// A pressure, or one that differs from place to place, as in `{ kind = "hydrostatic", density = 1000.0, surface = [0.0, 2.0] }`.
pub type PressureTable = Placed<f64, PressureField>;

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

impl<'de, T: Deserialize<'de>, F: Deserialize<'de>> Deserialize<'de> for Placed<T, F> {
    fn deserialize<S: Deserializer<'de>>(deserializer: S) -> Result<Self, S::Error> {
        deserializer.deserialize_any(PlacedVisitor(PhantomData))
    }
}

/// Not an untagged enum: that would forget what was wrong with the table.
struct PlacedVisitor<T, F>(PhantomData<(T, F)>);

impl<'de, T: Deserialize<'de>, F: Deserialize<'de>> Visitor<'de> for PlacedVisitor<T, F> {
    type Value = Placed<T, F>;

    fn expecting(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.write_str("a value or a table with a kind")
    }

    fn visit_f64<E: Error>(self, number: f64) -> Result<Self::Value, E> {
        T::deserialize(number.into_deserializer()).map(Placed::Uniform)
    }

    fn visit_i64<E: Error>(self, number: i64) -> Result<Self::Value, E> {
        self.visit_f64(number as f64)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, entries: A) -> Result<Self::Value, A::Error> {
        T::deserialize(SeqAccessDeserializer::new(entries)).map(Placed::Uniform)
    }

    fn visit_map<A: MapAccess<'de>>(self, entries: A) -> Result<Self::Value, A::Error> {
        F::deserialize(MapAccessDeserializer::new(entries)).map(Placed::Field)
    }
}
