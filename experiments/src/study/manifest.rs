//! manifest.json: what a study was computed with.

use std::collections::BTreeMap;
use std::path::Path;

use parvi_files::AtomicFile;
use serde::{Deserialize, Serialize};

use crate::CommandError;
use crate::provenance::Provenance;

/// The file's name.
pub const FILE_NAME: &str = "manifest.json";

/// The whole manifest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// The study's kind.
    pub kind: String,
    /// Fingerprint of the configuration.
    pub config_hash: String,
    /// Fingerprints of the data files, and of the files in commands of programs, that the configuration names, by their names there.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub data: BTreeMap<String, String>,
    /// Seeds, as in the configuration.
    pub seed: Vec<u64>,
    /// The first start.
    #[serde(flatten)]
    pub first: Provenance,
    /// Later starts that resumed it.
    #[serde(default)]
    pub resumed: Vec<Provenance>,
    /// Versions of all crates in the binary.
    pub crates: BTreeMap<String, String>,
}

impl Manifest {
    /// For a study that begins.
    pub fn new(kind: &str, config_hash: &str, seed: Vec<u64>, threads: usize) -> Self {
        Self {
            kind: kind.to_owned(),
            config_hash: config_hash.to_owned(),
            data: BTreeMap::new(),
            seed,
            first: Provenance::now(threads),
            resumed: Vec::new(),
            crates: locked_crates(),
        }
    }

    /// Reads a study's manifest.
    pub fn read(path: &Path) -> Result<Self, CommandError> {
        let text = std::fs::read_to_string(path).map_err(|source| CommandError::file("read", path, source))?;
        serde_json::from_str(&text).map_err(|error| CommandError::unreadable(path, error))
    }

    /// Writes it.
    pub fn write(&self, path: &Path) -> Result<(), CommandError> {
        let written = AtomicFile::filled(path, |writer| {
            serde_json::to_writer_pretty(&mut *writer, self)?;
            writeln!(writer)
        });
        Ok(written?)
    }

    /// Whether all starts used the same code, compiler, processor and number of threads.
    pub fn is_uniform(&self) -> bool {
        self.resumed.iter().all(|start| start.same_origin(&self.first))
    }
}

/// Names and versions in the lock file; several versions of one crate are joined by commas.
fn locked_crates() -> BTreeMap<String, String> {
    let lock = include_str!("../../../Cargo.lock").parse::<toml::Table>();
    let lock = lock.unwrap_or_default();
    let packages = lock.get("package").and_then(toml::Value::as_array);
    let mut crates: BTreeMap<String, String> = BTreeMap::new();
    for package in packages.into_iter().flatten() {
        let text = |key: &str| package.get(key).and_then(toml::Value::as_str).unwrap_or_default();
        let versions = crates.entry(text("name").to_owned()).or_default();
        if !versions.is_empty() {
            versions.push_str(", ");
        }
        versions.push_str(text("version"));
    }
    crates
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_manifest_reads_back() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join(FILE_NAME);
        let mut manifest = Manifest::new("quickstart", "0123", vec![0, 1], 2);
        manifest.resumed.push(Provenance::now(2));
        manifest.write(&path).unwrap();
        assert_eq!(Manifest::read(&path).unwrap(), manifest);
        assert!(manifest.is_uniform());
        assert!(manifest.crates.contains_key("parvi"));
        assert!(manifest.first.rustc.starts_with("rustc "));
    }

    #[test]
    fn another_number_of_threads_is_another_origin() {
        let mut manifest = Manifest::new("quickstart", "0123", vec![0], 2);
        manifest.resumed.push(Provenance::now(1));
        assert!(!manifest.is_uniform());
    }
}
