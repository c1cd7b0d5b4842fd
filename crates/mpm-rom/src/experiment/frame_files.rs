//! Frames of reduced runs for ParaView.

use std::path::{Path, PathBuf};

use mpm_scenes::Snapshot;
use mpm_scenes::output::{self, vtu, write_index, write_whole};

use super::ExperimentError;

/// The frames of a run, in a directory of their own.
pub(super) struct FrameFiles {
    directory: PathBuf,
    times: Vec<f64>,
}

impl FrameFiles {
    /// Files of the run with this number, in `run_0000` of `directory`.
    pub fn of_run(directory: &Path, run: usize) -> Result<Self, ExperimentError> {
        let directory = directory.join(format!("run_{run:04}"));
        std::fs::create_dir_all(&directory).map_err(|source| ExperimentError::file("create", &directory, source))?;
        Ok(Self {
            directory,
            times: Vec::new(),
        })
    }

    /// Writes the next frame, and the index with it.
    pub fn write(&mut self, snapshot: &Snapshot) -> Result<(), ExperimentError> {
        let name = output::names::frame(self.times.len() as u64);
        write_whole(&self.directory.join(name), &vtu(snapshot))?;
        self.times.push(snapshot.time);
        Ok(write_index(&self.directory, &self.times)?)
    }
}
