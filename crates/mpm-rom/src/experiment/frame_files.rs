//! Frames of reduced runs for ParaView.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use mpm_scenes::Snapshot;
use mpm_scenes::output::{self, remove_frames, vtu, write_index, write_whole};

use super::{ExperimentError, files};

/// The frames of a run, in a directory of their own.
pub(super) struct FrameFiles {
    directory: PathBuf,
    times: Vec<f64>,
}

impl FrameFiles {
    /// Files of the run with this number, in `run_0000` of `directory`.
    pub fn of_run(directory: &Path, run: usize) -> Result<Self, ExperimentError> {
        let directory = directory.join(name_of(run));
        files::create(&directory)?;
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

fn name_of(run: usize) -> String {
    format!("run_{run:04}")
}

/// Removes the frames that earlier reduced runs have left in `directory`, with the directories that they leave empty.
pub(super) fn forget_earlier(directory: &Path) -> Result<(), ExperimentError> {
    let refused = |source| ExperimentError::file("read", directory, source);
    for entry in std::fs::read_dir(directory).map_err(refused)? {
        let entry = entry.map_err(refused)?;
        let name = entry.file_name().to_string_lossy().into_owned();
        let number = name.strip_prefix("run_").and_then(|digits| digits.parse().ok());
        if number.is_some_and(|number| name_of(number) == name) && entry.path().is_dir() {
            remove_frames(&entry.path())?;
            match std::fs::remove_dir(entry.path()) {
                Err(source) if source.kind() != ErrorKind::DirectoryNotEmpty => {
                    return Err(ExperimentError::file("remove", &entry.path(), source));
                }
                _ => {}
            }
        }
    }
    Ok(())
}
