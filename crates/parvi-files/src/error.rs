//! What is wrong with files.

use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

/// A file that cannot be read or written, or does not hold what it should.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FileError {
    /// A file or directory could not be read or written.
    #[error("cannot {operation} {path}: {source}")]
    System {
        /// What was tried, e.g. `write`.
        operation: &'static str,
        /// The file.
        path: String,
        /// What the system said.
        source: io::Error,
    },
    /// A file does not hold what is written into such files.
    #[error("{file}: {message}")]
    Unreadable {
        /// The file.
        file: String,
        /// What is wrong, with line and value.
        message: String,
    },
    /// The extension of a file is not one that there is.
    #[error("--{flag} {}: the extension must be .csv or .npy", .path.display())]
    Extension {
        /// The flag that asked for the file, without dashes in front.
        flag: &'static str,
        /// The file.
        path: PathBuf,
    },
    /// A file that was handed over is no table of numbers.
    #[error("--{flag}: {}: {reason}", .path.display())]
    NoTable {
        /// The flag that named the file, without dashes in front.
        flag: &'static str,
        /// The file.
        path: PathBuf,
        /// What is wrong, with the line where it can be told.
        reason: String,
    },
    /// A file stands where a directory is needed.
    #[error("--{flag}: {} is a file, and a directory is needed", .path.display())]
    NoDirectory {
        /// The flag that asked for the directory, without dashes in front.
        flag: &'static str,
        /// The file.
        path: PathBuf,
    },
    /// This build has no `.npy` files.
    #[error("files .npy: built without npy: cargo build --features npy")]
    NpyLeftOut,
}

impl FileError {
    /// An operation on a file failed.
    pub fn system(operation: &'static str, path: impl AsRef<Path>, source: io::Error) -> Self {
        Self::System {
            operation,
            path: path.as_ref().display().to_string(),
            source,
        }
    }

    /// A file does not hold what is written into such files.
    pub fn unreadable(path: &Path, message: impl ToString) -> Self {
        Self::Unreadable {
            file: path.display().to_string(),
            message: message.to_string(),
        }
    }

    /// Whether something was asked for that cannot be, rather than that something failed.
    pub fn is_of_request(&self) -> bool {
        !matches!(
            self,
            Self::System { .. } | Self::Unreadable { .. } | Self::NoTable { .. }
        )
    }
}
