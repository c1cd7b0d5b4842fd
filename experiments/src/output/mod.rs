//! Files of particles, written whole or not at all.

mod atomic_file;
mod directory;
mod distinct_names;
pub mod frames;
#[cfg(feature = "npy")]
mod npy;
#[cfg(not(feature = "npy"))]
#[path = "npy_left_out.rs"]
mod npy;
mod number_table;
mod particles;
pub mod particles_csv;
pub mod particles_npy;
pub mod table_file;

use std::path::{Path, PathBuf};

pub use atomic_file::AtomicFile;
pub use directory::OutputDirectory;
pub use distinct_names::distinct_names;
pub use frames::FrameWriter;
pub use number_table::NumberTable;
pub use particles::Particles;

use crate::CommandError;

/// How particles are written; the extension of the file decides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ParticleFormat {
    /// Comma-separated values with a header.
    Csv,
    /// A NumPy array.
    Npy,
}

impl ParticleFormat {
    /// The format that the extension of `path` stands for, in upper or lower case.
    fn told(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_lowercase().as_str() {
            "csv" => Some(Self::Csv),
            "npy" => Some(Self::Npy),
            _ => None,
        }
    }

    /// The same; `flag` asked for the file.
    ///
    /// # Errors
    /// [`CommandError::OutputExtension`] for any other extension, [`CommandError::LeftOut`] where this build lacks the format.
    pub fn of(flag: &'static str, path: &Path) -> Result<Self, CommandError> {
        let format = Self::told(path).ok_or_else(|| CommandError::OutputExtension {
            flag,
            path: path.to_owned(),
        })?;
        if format == Self::Npy {
            npy_is_built()?;
        }
        Ok(format)
    }
}

/// Whether this build has `.npy` files.
///
/// # Errors
/// [`CommandError::LeftOut`].
pub fn npy_is_built() -> Result<(), CommandError> {
    if cfg!(feature = "npy") {
        return Ok(());
    }
    Err(CommandError::LeftOut {
        asked: "files .npy",
        feature: "npy",
    })
}

/// A file that waits for its particles.
pub struct ParticleFile {
    format: ParticleFormat,
    file: AtomicFile,
}

impl ParticleFile {
    /// Opens a temporary file beside `path`, before the work that fills it.
    pub fn create(path: impl Into<PathBuf>) -> Result<Self, CommandError> {
        let path = path.into();
        Ok(Self {
            format: ParticleFormat::of("out", &path)?,
            file: AtomicFile::create(path)?,
        })
    }

    /// Writes the particles, columns called by `names` where the format has room for them and there are such, and gives the file its
    /// final name.
    pub fn write(mut self, particles: &Particles, names: &[String]) -> Result<(), CommandError> {
        self.file.fill(|writer| match self.format {
            ParticleFormat::Csv => particles_csv::write(particles, names, writer),
            ParticleFormat::Npy => particles_npy::write(particles, writer),
        })?;
        self.file.commit()
    }
}
