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

    /// Options of the start that need or exclude each other.
    pub(super) fn check_starts(&self, method: MethodName) -> Result<(), OptionError> {
        let ways = [
            ("start", self.start.as_ref().map(|path| path.display().to_string())),
            ("start-law", self.start_law.clone()),
            ("start-centre", self.start_centre.clone()),
        ];
        let mut given = ways.iter().filter_map(|(name, value)| Some((*name, value.as_ref()?)));
        if let (Some((first, _)), Some((name, value))) = (given.next(), given.next()) {
            return Err(contradiction(name, value, first));
        }
        let law = [("start-mean", self.start_mean), ("start-sd", self.start_sd)];
        let law = law.into_iter().find_map(|(name, value)| Some((name, value?)));
        let way = ways.iter().find(|(_, value)| value.is_some());
        if let (Some((other, _)), Some((name, value))) = (way, law) {
            return Err(contradiction(name, &value.to_string(), other));
        }
        if let (None, Some(covariance)) = (&self.start_centre, &self.start_covariance) {
            let reason = format!("{covariance} needs --start-centre beside it");
            return Err(OptionError::new("start-covariance", reason));
        }
        if let Some((name, Some(value))) = way
            && method == MethodName::Mpm
            && self.surveys()
        {
            let reason = format!("{value} needs --survey off: a survey says where the particles begin");
            return Err(OptionError::new(name, reason));
        }
        if self.start.is_some() && self.volumes_of_start() {
            let reason = "start-density needs a start law, which a file of positions does not have";
            return Err(OptionError::new("volumes", reason));
        }
        Ok(())
    }

    /// Refuses what a study does not read: every run of it draws its start from a law in the frame.
    pub(super) fn check_study_start(&self) -> Result<(), OptionError> {
        let is_given = |name: &str, value: &str| match name {
            "start" | "start-law" | "start-centre" => true,
            "masses" => value != "equal",
            "velocities" => value != "zero",
            "volumes" => self.volumes_file().is_some(),
            _ => false,
        };
        match self.given().find(|(name, value)| is_given(name, value)) {
            None => Ok(()),
            Some((name, value)) => Err(OptionError::new(
                &name,
                format!("{value}: a study gives no particles, `parvi sample` does"),
            )),
        }
    }
}

fn file_unless<'a>(value: &'a Option<PathBuf>, word: &str) -> Option<&'a Path> {
    value.as_deref().filter(|path| *path != Path::new(word))
}

fn contradiction(name: &str, value: &str, other: &str) -> OptionError {
    OptionError::new(name, format!("{value} contradicts --{other}"))
}
