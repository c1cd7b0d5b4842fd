//! Directories that a run fills beside its main file.

use std::fs;
use std::path::{Path, PathBuf};

use crate::FileError;

/// A directory for files of a run; one that was made for it and has stayed empty is removed again.
pub struct OutputDirectory {
    /// The directory.
    pub path: PathBuf,
    /// Whether it was made here.
    made: bool,
}

impl OutputDirectory {
    /// Makes the directory that `flag` asks for, where there is none, with those above it.
    ///
    /// # Errors
    /// [`FileError::NoDirectory`] for a path that is no directory, [`FileError::System`] for one that cannot be made.
    pub fn create(flag: &'static str, path: &Path) -> Result<Self, FileError> {
        if path.exists() && !path.is_dir() {
            return Err(FileError::NoDirectory {
                flag,
                path: path.to_owned(),
            });
        }
        let made = !path.exists();
        fs::create_dir_all(path).map_err(|error| FileError::system("make the directory", path, error))?;
        Ok(Self {
            path: path.to_owned(),
            made,
        })
    }

    /// A file in it.
    pub fn file(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    /// Removes a file in it; nothing where there is none.
    ///
    /// # Errors
    /// [`FileError::System`].
    pub fn remove(&self, name: &str) -> Result<(), FileError> {
        let path = self.file(name);
        match fs::remove_file(&path) {
            Err(error) if error.kind() != std::io::ErrorKind::NotFound => Err(FileError::system("remove", path, error)),
            _ => Ok(()),
        }
    }
}

impl Drop for OutputDirectory {
    fn drop(&mut self) {
        if self.made {
            // Refused, as it should be, unless it is empty.
            let _ = fs::remove_dir(&self.path);
        }
    }
}
