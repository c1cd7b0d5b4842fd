//! What is given of the particles at the start: files, or words that need none.

use std::path::{Path, PathBuf};

use super::{MethodName, MethodOptions, OptionError};

impl MethodOptions {
    /// The file of the start positions.
    pub fn start_file(&self) -> Option<&Path> {
        self.start.as_deref()
    }

    /// The file of the masses, unless they are all the same.
    pub fn masses_file(&self) -> Option<&Path> {
        file_unless(&self.masses, "equal")
    }

    /// The file of the velocities, unless they are zero.
    pub fn velocities_file(&self) -> Option<&Path> {
        file_unless(&self.velocities, "zero")
    }

    /// The file of the reference volumes, unless a rule finds them.
    pub fn volumes_file(&self) -> Option<&Path> {
        self.volumes.as_deref().filter(|_| self.volume_rule().is_none())
    }

    /// Whether reference volumes are to be those of the start's density.
    pub fn volumes_of_start(&self) -> bool {
        self.volume_rule() == Some(parvi::ReferenceVolumes::OfStartDensity)
    }

    /// Refuses what a study does not read or write: every run of it draws its start from a law in the frame, and a pool belongs to a single run.
    pub(super) fn check_study(&self, method: MethodName) -> Result<(), OptionError> {
        let reason = |name: &str, value: &str| match name {
            "pool" if self.pool_file(method).is_some() => Some("a study writes no pools"),
            "masses" if value == "equal" => None,
            "velocities" if value == "zero" => None,
            "volumes" if self.volumes_file().is_none() => None,
            "start" | "start-law" | "start-centre" | "masses" | "velocities" | "volumes" => {
                Some("a study gives no particles")
            }
            _ => None,
        };
        let refused = |(name, value): (String, String)| {
            let reason = reason(&name, &value)?;
            Some(OptionError::new(
                &name,
                format!("{value}: {reason}, `parvi sample` does"),
            ))
        };
        self.given().find_map(refused).map_or(Ok(()), Err)
    }
}

fn file_unless<'a>(value: &'a Option<PathBuf>, word: &str) -> Option<&'a Path> {
    value.as_deref().filter(|path| *path != Path::new(word))
}
