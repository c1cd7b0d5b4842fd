//! Frames, read back.

use std::path::{Path, PathBuf};

use super::names;
use crate::SimulationError;

/// A frame of a run: a `.vtu` file as [`vtu`](super::vtu) writes it.
pub struct Frame {
    path: PathBuf,
    bytes: Vec<u8>,
    /// The length of the part that is text.
    header: usize,
    /// Where the appended data begin.
    data: usize,
}

/// The files of all frames of a run's directory, that of t = 0 first.
pub fn frame_files(directory: &Path) -> Vec<PathBuf> {
    let files = (0..).map(|number| directory.join(names::frame(number)));
    files.take_while(|file| file.exists()).collect()
}

impl Frame {
    /// Reads a file.
    ///
    /// # Errors
    /// [`SimulationError::File`], also for what is no frame.
    pub fn read(path: &Path) -> Result<Self, SimulationError> {
        let bytes = std::fs::read(path).map_err(|error| SimulationError::file("read", path, error))?;
        Self::of(path, bytes).ok_or_else(|| refused(path, "it has no appended data"))
    }

    fn of(path: &Path, bytes: Vec<u8>) -> Option<Self> {
        let header = find(&bytes, b"<AppendedData")?;
        let data = header + find(bytes.get(header..)?, b"_")? + 1;
        Some(Self {
            path: path.to_owned(),
            bytes,
            header,
            data,
        })
    }

    /// The instant.
    ///
    /// # Errors
    /// [`SimulationError::File`] where there is none.
    pub fn time(&self) -> Result<f64, SimulationError> {
        let rest = self.after("TimeValue").and_then(|rest| rest.split_once('>'));
        let time = rest.and_then(|(_, rest)| rest.split_once('<')?.0.trim().parse().ok());
        time.ok_or_else(|| refused(&self.path, "it has no time"))
    }

    /// A field of real numbers, particle by particle: one number, three (vectors, also `position`) or nine (tensors) for each.
    ///
    /// # Errors
    /// [`SimulationError::File`] where there is no such field, or a part of it.
    pub fn field(&self, name: &str) -> Result<Vec<f64>, SimulationError> {
        let values = self.values(name);
        values.ok_or_else(|| refused(&self.path, &format!("it has no field `{name}`, or not all of it")))
    }

    fn values(&self, name: &str) -> Option<Vec<f64>> {
        let (_, rest) = self.after(name)?.split_once("offset=\"")?;
        let offset: usize = rest.split_once('"')?.0.parse().ok()?;
        let (length, values) = self.bytes.get(self.data.checked_add(offset)?..)?.split_at_checked(8)?;
        let length = usize::try_from(u64::from_le_bytes(length.try_into().ok()?)).ok()?;
        let words = values.get(..length)?.chunks_exact(8);
        words
            .map(|word| Some(f64::from_le_bytes(word.try_into().ok()?)))
            .collect()
    }

    /// The header behind the name of an array.
    fn after(&self, name: &str) -> Option<&str> {
        let header = std::str::from_utf8(self.bytes.get(..self.header)?).ok()?;
        Some(header.split_once(&format!("Name=\"{name}\""))?.1)
    }
}

fn find(bytes: &[u8], mark: &[u8]) -> Option<usize> {
    bytes.windows(mark.len()).position(|window| window == mark)
}

fn refused(path: &Path, reason: &str) -> SimulationError {
    SimulationError::file("read", path, std::io::Error::other(reason.to_owned()))
}

#[cfg(test)]
mod tests {
    use super::super::vtu;
    use super::*;
    use crate::Snapshot;

    fn file() -> Vec<u8> {
        vtu(&Snapshot {
            dimension: 1,
            time: 0.25,
            reference_positions: vec![0.0, 1.0],
            positions: vec![0.5, 0.75],
            velocities: vec![0.0, 1.0],
            stresses: vec![1.0, 2.0],
            stresses_across: Vec::new(),
            deformation_gradients: vec![1.0, 1.0],
            volume_ratios: vec![1.0, 1.0],
            masses: vec![0.5, 0.5],
            reference_volumes: vec![1.0, 1.0],
            bodies: vec![0, 0],
            materials: vec![0, 0],
            scalars: Vec::new(),
        })
    }

    #[test]
    fn what_was_written_is_read() {
        let directory = tempfile::tempdir().expect("a directory");
        for number in [0, 1, 3] {
            std::fs::write(directory.path().join(names::frame(number)), file()).expect("writable");
        }
        let files = frame_files(directory.path());
        assert_eq!(files.len(), 2);
        let frame = Frame::read(&files[1]).expect("a frame");
        assert_eq!(frame.time().expect("a time"), 0.25);
        assert_eq!(
            frame.field("displacement").expect("there"),
            [0.5, 0.0, 0.0, -0.25, 0.0, 0.0]
        );
        assert!(frame.field("plastic_strain").is_err());
    }

    #[test]
    fn a_truncated_frame_is_refused() {
        let whole = file();
        for length in [0, 40, whole.len() / 2, whole.len() - 80] {
            let part = Frame::of(Path::new("part.vtu"), whole[..length].to_vec());
            assert!(part.is_none_or(|part| part.field("particle").is_err()), "{length}");
        }
        assert!(Frame::read(Path::new("none.vtu")).is_err());
    }
}
