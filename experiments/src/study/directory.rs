//! A study's directory: config.toml, manifest.json, results.csv, raw/, figures/ and report.md.

use std::fmt::Display;
use std::fs;
use std::path::{Path, PathBuf};

use parvi_files::AtomicFile;

use super::configuration::Configuration;
use crate::CommandError;
use crate::plots::page::Page;

/// The name of the configuration in it.
pub const CONFIGURATION: &str = "config.toml";

/// A directory that holds one study and nothing else.
#[derive(Debug)]
pub struct StudyDirectory {
    path: PathBuf,
    /// What the prose of its report may name.
    values: Vec<(String, String)>,
    /// Threads that the study asks for; `None`: as many as the environment gives.
    pub threads: Option<usize>,
    /// While a study runs; no other process takes the directory meanwhile.
    claimed: Option<fs::File>,
}

impl StudyDirectory {
    /// Takes a directory for a study: a new one, an empty one, or one that holds a part of the same study.
    ///
    /// # Errors
    /// [`CommandError::Refused`] if it holds something else, which is left untouched;
    /// [`CommandError::Files`] if it cannot be made or written, or another process runs a study in it.
    pub fn claim(path: &Path, configuration: &Configuration) -> Result<Self, CommandError> {
        let mut directory = Self::of(path, configuration);
        let existing = directory.file(CONFIGURATION);
        if !path.exists() {
            fs::create_dir_all(path).map_err(|source| CommandError::file("create", path, source))?;
        }
        directory.claimed =
            mpm_document::claim(path).map_err(|source| CommandError::file("write into", path, source))?;
        if existing.exists() {
            directory.check_same_study(configuration)?;
        } else {
            directory.check_empty()?;
            AtomicFile::write(existing, &configuration.text)?;
        }
        directory.make_parts()?;
        if directory.claimed.is_some() {
            directory.clear_partial()?;
        }
        Ok(directory)
    }

    /// Removes what runs that were killed have not written to the end; no other process is in the directory.
    fn clear_partial(&self) -> Result<(), CommandError> {
        for part in ["", "raw", "figures"].map(|part| self.path.join(part)) {
            let entries = fs::read_dir(&part).map_err(|source| CommandError::file("read", &part, source))?;
            let paths = entries.flatten().map(|entry| entry.path());
            for path in paths.filter(|path| AtomicFile::is_partial(path)) {
                fs::remove_file(&path).map_err(|source| CommandError::file("remove", &path, source))?;
            }
        }
        Ok(())
    }

    /// A directory in which a study was run before.
    ///
    /// # Errors
    /// [`CommandError::Refused`] for a directory without a configuration.
    pub fn existing(path: &Path) -> Result<(Self, Configuration), CommandError> {
        if path.is_dir() && !path.join(CONFIGURATION).exists() {
            let path = path.display();
            return Err(CommandError::Refused(format!(
                "{path} holds no results: a study has its config.toml there, a simulated scene its scene.toml, a reduced-order model its model.safetensors"
            )));
        }
        let configuration = Configuration::read(&path.join(CONFIGURATION))?;
        let directory = Self::of(path, &configuration);
        directory.make_parts()?;
        Ok((directory, configuration))
    }

    fn of(path: &Path, configuration: &Configuration) -> Self {
        Self {
            path: path.to_owned(),
            values: configuration.values(),
            threads: configuration.threads(),
            claimed: None,
        }
    }

    fn make_parts(&self) -> Result<(), CommandError> {
        for part in ["raw", "figures"] {
            let part = self.path.join(part);
            fs::create_dir_all(&part).map_err(|source| CommandError::file("create", &part, source))?;
        }
        Ok(())
    }

    fn check_same_study(&self, configuration: &Configuration) -> Result<(), CommandError> {
        // A config.toml that is no study's is a stranger's as well.
        let here = Configuration::read(&self.file(CONFIGURATION))
            .map_err(|error| self.occupied(format!("holds a {CONFIGURATION} that is no study's ({error})")))?;
        if here.hash == configuration.hash {
            return Ok(());
        }
        let told = |study: &Configuration| format!("kind `{}`, config hash {}", study.kind(), study.hash);
        let (other, own, file) = (told(&here), told(configuration), &configuration.file);
        Err(self.occupied(format!("holds another study ({other}; {file} has {own})")))
    }

    fn check_empty(&self) -> Result<(), CommandError> {
        let entries = fs::read_dir(&self.path).map_err(|source| CommandError::file("write", &self.path, source))?;
        for entry in entries {
            let entry = entry.map_err(|source| CommandError::file("read", &self.path, source))?;
            let name = entry.file_name().to_string_lossy().into_owned();
            if !AtomicFile::is_partial(&entry.path()) {
                return Err(self.occupied(format!("is not empty and holds no study (there is `{name}`)")));
            }
        }
        Ok(())
    }

    fn occupied(&self, occupant: String) -> CommandError {
        CommandError::occupied(&self.path, &occupant)
    }

    /// A page whose prose names values of the configuration by their keys, and these.
    pub fn page(&self, prose: &str, values: &[(&str, &dyn Display)]) -> Page {
        let configured = self.values.iter();
        let configured = configured.map(|(key, value)| (key.as_str(), value as &dyn Display));
        Page::of(prose, &configured.chain(values.iter().copied()).collect::<Vec<_>>())
    }

    /// ` (at most 2)`, where the study asks for a number of threads.
    pub fn at_most_threads(&self) -> String {
        let threads = self.threads.map(|threads| format!(" (at most {threads})"));
        threads.unwrap_or_default()
    }

    /// A file by its name: report.md, manifest.json, results.csv.
    pub fn file(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    /// A file of raw results.
    pub fn raw(&self, name: &str) -> PathBuf {
        self.path.join("raw").join(name)
    }

    /// The same of one case, by what it is: particles, moments.
    pub fn raw_of(&self, case: &str, what: &str) -> PathBuf {
        self.raw(&format!("{case}-{what}.csv"))
    }

    /// A figure, by the name that the report links to.
    pub fn figure(&self, name: &str) -> PathBuf {
        self.path.join("figures").join(name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn configuration(directory: &Path, text: &str) -> Configuration {
        let path = directory.join("study.toml");
        fs::write(&path, text).unwrap();
        Configuration::read(&path).unwrap()
    }

    #[test]
    fn new_empty_and_own_directories_are_taken() {
        let root = tempfile::tempdir().unwrap();
        let study = configuration(root.path(), "kind = \"a\"\n");
        let path = root.path().join("deep/new");
        let held = StudyDirectory::claim(&path, &study).unwrap();
        if held.claimed.is_some() {
            let message = StudyDirectory::claim(&path, &study).unwrap_err().to_string();
            assert!(message.contains("another process"), "{message}");
        }
        let is_locked = held.claimed.is_some();
        drop(held);
        // What a killed run left is cleared.
        let left = [".report.md.77.partial", "raw/.trace.csv.77.partial"].map(|name| path.join(name));
        left.iter().for_each(|path| fs::write(path, "half").unwrap());
        fs::write(path.join("raw/whole.csv"), "whole").unwrap();
        StudyDirectory::claim(&path, &study).unwrap();
        assert!(left.iter().all(|path| path.exists() != is_locked));
        assert!(path.join("raw/whole.csv").exists());
        let empty = root.path().join("empty");
        fs::create_dir(&empty).unwrap();
        let starting = mpm_document::claim(&empty).unwrap();
        if starting.is_some() {
            StudyDirectory::claim(&empty, &study).unwrap_err();
            assert!(!empty.join(CONFIGURATION).exists());
        }
        drop(starting);
        StudyDirectory::claim(&empty, &study).unwrap();
        assert_eq!(fs::read_to_string(empty.join(CONFIGURATION)).unwrap(), study.text);
    }

    #[test]
    fn strangers_are_left_alone() {
        let root = tempfile::tempdir().unwrap();
        let path = root.path().join("out");
        StudyDirectory::claim(&path, &configuration(root.path(), "kind = \"a\"\n")).unwrap();
        let other = configuration(root.path(), "kind = \"a\"\nseed = 3\n");
        let message = StudyDirectory::claim(&path, &other).unwrap_err().to_string();
        assert!(message.contains("holds another study"), "{message}");
        assert_eq!(fs::read_to_string(path.join(CONFIGURATION)).unwrap(), "kind = \"a\"\n");

        let full = root.path().join("full");
        fs::create_dir(&full).unwrap();
        fs::write(full.join("thesis.tex"), "").unwrap();
        let message = StudyDirectory::claim(&full, &other).unwrap_err().to_string();
        assert!(message.contains("`thesis.tex`"), "{message}");
        assert_eq!(fs::read_dir(&full).unwrap().count(), 1);
    }

    #[test]
    fn a_file_is_no_directory() {
        let root = tempfile::tempdir().unwrap();
        let path = root.path().join("study.toml");
        let study = configuration(root.path(), "kind = \"a\"\n");
        let message = StudyDirectory::claim(&path, &study).unwrap_err().to_string();
        assert!(message.starts_with("cannot write"), "{message}");
        let message = StudyDirectory::claim(&path.join("below"), &study)
            .unwrap_err()
            .to_string();
        assert!(message.starts_with("cannot create"), "{message}");
    }
}
