//! Files that appear under their final name whole or not at all.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use crate::FileError;

/// What temporary names end with.
const PARTIAL_SUFFIX: &str = ".partial";

/// A file under a temporary name in the directory of its final one.
///
/// It is renamed by [`commit`](Self::commit); dropped before that, it is removed.
pub struct AtomicFile {
    destination: PathBuf,
    temporary: PathBuf,
    writer: Option<BufWriter<File>>,
}

impl AtomicFile {
    /// Whether a path has the name of a file that was not written to its end.
    pub fn is_partial(path: &Path) -> bool {
        let name = path.file_name().map(|name| name.to_string_lossy());
        name.is_some_and(|name| name.starts_with('.') && name.ends_with(PARTIAL_SUFFIX))
    }

    /// Opens the temporary file, which shows early that the directory can be written.
    ///
    /// # Errors
    /// [`FileError::System`] if the directory does not exist, cannot be written, or the destination is a directory or no file at all: a device or a pipe, which the file would take the place of.
    pub fn create(destination: impl Into<PathBuf>) -> Result<Self, FileError> {
        let destination = destination.into();
        let refuse = |source| FileError::system("write", &destination, source);
        let Some(name) = destination.file_name() else {
            return Err(refuse(io::Error::other("it names no file")));
        };
        if destination.is_dir() {
            return Err(refuse(io::Error::from(io::ErrorKind::IsADirectory)));
        }
        if destination.exists() && !destination.is_file() {
            return Err(refuse(io::Error::other(
                "it is a device or a pipe, in whose place a file would be put",
            )));
        }
        let temporary_name = format!(".{}.{}{PARTIAL_SUFFIX}", name.to_string_lossy(), std::process::id());
        let temporary = destination.with_file_name(temporary_name);
        let writer = Some(BufWriter::new(File::create(&temporary).map_err(refuse)?));
        Ok(Self {
            destination,
            temporary,
            writer,
        })
    }

    /// Writes all bytes of a whole file.
    ///
    /// # Errors
    /// [`FileError::System`].
    pub fn write(destination: impl Into<PathBuf>, content: impl AsRef<[u8]>) -> Result<(), FileError> {
        Self::filled(destination, |writer| writer.write_all(content.as_ref()))
    }

    /// Lets a function write the content of a whole file.
    ///
    /// # Errors
    /// [`FileError::System`], also with what the function says.
    pub fn filled(
        destination: impl Into<PathBuf>,
        content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), FileError> {
        let mut file = Self::create(destination)?;
        file.fill(content)?;
        file.commit()
    }

    /// Lets a function write the content.
    ///
    /// # Errors
    /// [`FileError::System`] with what it says.
    pub fn fill(&mut self, content: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), FileError> {
        let result = self.writer.as_mut().map_or(Ok(()), |writer| content(writer));
        result.map_err(|source| FileError::system("write", &self.destination, source))
    }

    /// Flushes to the disk and moves the file to its final name.
    ///
    /// # Errors
    /// [`FileError::System`]; nothing is left under the temporary name then.
    pub fn commit(mut self) -> Result<(), FileError> {
        let writer = self.writer.take();
        let result = writer.map_or(Ok(()), |writer| finish(writer, &self.temporary, &self.destination));
        result.map_err(|source| FileError::system("write", &self.destination, source))
    }
}

fn finish(writer: BufWriter<File>, temporary: &Path, destination: &Path) -> io::Result<()> {
    let file = writer.into_inner().map_err(io::IntoInnerError::into_error)?;
    file.sync_all()?;
    fs::rename(temporary, destination)
}

impl Drop for AtomicFile {
    fn drop(&mut self) {
        // After a commit the temporary name is gone; else nothing of it may remain.
        let _ = fs::remove_file(&self.temporary);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_left_of_an_abandoned_file() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("x.csv");
        let mut file = AtomicFile::create(&path).unwrap();
        file.fill(|writer| writer.write_all(b"half a line")).unwrap();
        drop(file);
        assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 0);
    }

    #[test]
    fn a_committed_file_is_whole_and_replaces_the_old_one() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("x.csv");
        AtomicFile::write(&path, "old").unwrap();
        AtomicFile::write(&path, "new").unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "new");
        assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 1);
    }

    #[test]
    #[cfg(unix)]
    fn a_socket_stays_one() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("x.csv");
        let _socket = std::os::unix::net::UnixListener::bind(&path).unwrap();
        let message = AtomicFile::create(&path).err().unwrap().to_string();
        assert!(message.ends_with("in whose place a file would be put"), "{message}");
        assert!(!path.is_file());
    }

    #[test]
    fn a_directory_is_no_file() {
        let directory = tempfile::tempdir().unwrap();
        let message = AtomicFile::create(directory.path()).err().unwrap().to_string();
        assert!(message.starts_with("cannot write "), "{message}");
    }
}
