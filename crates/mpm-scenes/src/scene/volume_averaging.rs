//! What of the volumes is averaged.

use std::fmt;

use mpm_core::VolumeAveraging;
use serde::Deserializer;
use serde::de::{Error, Visitor};

/// `false`, `true` or a name.
pub(super) fn read<'de, S: Deserializer<'de>>(deserializer: S) -> Result<VolumeAveraging, S::Error> {
    deserializer.deserialize_any(Names)
}

struct Names;

impl Visitor<'_> for Names {
    type Value = VolumeAveraging;

    fn expecting(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.write_str("false, true, \"ratios\" or \"changes\"")
    }

    fn visit_bool<E: Error>(self, averaged: bool) -> Result<VolumeAveraging, E> {
        Ok(if averaged {
            VolumeAveraging::Ratios
        } else {
            VolumeAveraging::Off
        })
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<VolumeAveraging, E> {
        match name {
            "ratios" => Ok(VolumeAveraging::Ratios),
            "changes" => Ok(VolumeAveraging::Changes),
            other => Err(E::invalid_value(serde::de::Unexpected::Str(other), &self)),
        }
    }
}
