//! Files of particles: the format that a name stands for, and a file that waits for its particles.

use std::path::{Path, PathBuf};

use super::{AtomicFile, FileError, Particles, particles_csv, particles_npy};

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
    pub(crate) fn told(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_lowercase().as_str() {
            "csv" => Some(Self::Csv),
            "npy" => Some(Self::Npy),
            _ => None,
        }
    }

    /// The same; `flag` asked for the file.
    ///
    /// # Errors
    /// [`FileError::Extension`] for any other extension, [`FileError::NpyLeftOut`] where this build lacks the format.
    pub fn of(flag: &'static str, path: &Path) -> Result<Self, FileError> {
        let format = Self::told(path).ok_or_else(|| FileError::Extension {
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
/// [`FileError::NpyLeftOut`].
pub fn npy_is_built() -> Result<(), FileError> {
    if cfg!(feature = "npy") {
        return Ok(());
    }
    Err(FileError::NpyLeftOut)
}

/// A file that waits for its particles.
pub struct ParticleFile {
    format: ParticleFormat,
    file: AtomicFile,
}

impl ParticleFile {
    /// Opens a temporary file beside `path`, which `flag` asks for, before the work that fills it.
    ///
    /// # Errors
    /// As for [`ParticleFormat::of`] and [`AtomicFile::create`].
    pub fn create(flag: &'static str, path: impl Into<PathBuf>) -> Result<Self, FileError> {
        let path = path.into();
        Ok(Self {
            format: ParticleFormat::of(flag, &path)?,
            file: AtomicFile::create(path)?,
        })
    }

    /// Writes the particles, columns called by `names` where the format has room for them and there are such, and gives the file its
    /// final name.
    ///
    /// # Errors
    /// [`FileError::System`].
    pub fn write(mut self, particles: &Particles, names: &[String]) -> Result<(), FileError> {
        self.file.fill(|writer| match self.format {
            ParticleFormat::Csv => particles_csv::write(particles, names, writer),
            ParticleFormat::Npy => particles_npy::write(particles, writer),
        })?;
        self.file.commit()
    }
}
