//! Options that are a file, or a word that needs none: what is given of the particles at the start, and what draws are chosen from.

use std::path::Path;

use clap::ValueEnum;

use super::{MethodName, MethodOptions, OptionError, PoolChoice};

impl MethodOptions {
    /// The file of the start positions.
    pub fn start_file(&self) -> Option<&Path> {
        self.start.as_deref().map(Path::new)
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
        let file = self.volumes.as_deref().filter(|_| self.volume_rule().is_none());
        file.map(Path::new)
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
            let reason = format!("{value}: {}, `parvi sample` does", reason(&name, &value)?);
            Some(OptionError::new(&name, reason))
        };
        self.given().find_map(refused).map_or(Ok(()), Err)
    }

    /// What Stein thinning chooses from, where it is said.
    ///
    /// # Errors
    /// A word that is none of the choices.
    pub(super) fn pool_choice(&self) -> Result<Option<PoolChoice>, OptionError> {
        let choice = |word: &String| {
            let refused = |_| OptionError::out_of_range("pool", word, "`exact` or `nuts`");
            PoolChoice::from_str(word, false).map_err(refused)
        };
        self.pool.as_ref().map(choice).transpose()
    }

    /// Whether a method with these options draws by the No-U-Turn sampler.
    pub(super) fn uses_chains(&self, method: MethodName) -> bool {
        match method {
            MethodName::Nuts => true,
            MethodName::SteinThinning => matches!(self.pool_choice(), Ok(Some(PoolChoice::Nuts))),
            _ => false,
        }
    }

    /// The file that a method writes its weighted pool into.
    pub fn pool_file(&self, method: MethodName) -> Option<&Path> {
        let weighs = method.kind().has("pool") && method != MethodName::SteinThinning;
        self.pool.as_deref().filter(|_| weighs).map(Path::new)
    }
}

/// The file, where the value is not this word.
fn file_unless<'a>(value: &'a Option<String>, word: &str) -> Option<&'a Path> {
    value.as_deref().filter(|value| *value != word).map(Path::new)
}
