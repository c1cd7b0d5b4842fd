//! What results were computed with.

use serde::{Deserialize, Serialize};

use crate::machine;

/// One start of the command.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Provenance {
    /// When it was started, in UTC.
    pub started: String,
    /// Commit that the binary was built from; `None` outside of a repository.
    pub commit: Option<String>,
    /// Whether the sources differed from that commit.
    pub dirty: Option<bool>,
    /// Compiler.
    pub rustc: String,
    /// Processor.
    pub cpu: Option<String>,
    /// Threads that samplers and metrics may use.
    pub threads: usize,
}

impl Provenance {
    /// Of this process.
    pub fn now(threads: usize) -> Self {
        let commit = Some(env!("PARVI_COMMIT")).filter(|text| !text.is_empty());
        Self {
            started: machine::utc_now(),
            commit: commit.map(str::to_owned),
            dirty: env!("PARVI_DIRTY").parse().ok(),
            rustc: env!("PARVI_RUSTC").to_owned(),
            cpu: machine::processor(),
            threads,
        }
    }

    /// The same but for the time of the start.
    pub fn same_origin(&self, other: &Self) -> bool {
        let mut other = other.clone();
        other.started.clone_from(&self.started);
        *self == other
    }
}
