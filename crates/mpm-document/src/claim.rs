use std::fs::{File, TryLockError};
use std::io::{Error, ErrorKind};
use std::path::Path;

/// Takes a directory for as long as what is returned lives: no other process that asks has it meanwhile. `None` where the system locks no directories.
///
/// The lock ends with the process, however that ends, and leaves no file.
///
/// # Errors
/// [`ErrorKind::ResourceBusy`] where another process has it.
pub fn claim(directory: &Path) -> Result<Option<File>, Error> {
    let Ok(handle) = File::open(directory) else {
        return Ok(None);
    };
    match handle.try_lock() {
        Ok(()) => Ok(Some(handle)),
        Err(TryLockError::WouldBlock) => {
            let reason = "another process writes into this directory";
            Err(Error::new(ErrorKind::ResourceBusy, reason))
        }
        Err(TryLockError::Error(_)) => Ok(None),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[cfg(unix)]
    fn a_directory_has_one_owner_at_a_time() {
        let directory = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
        let first = claim(&directory).unwrap();
        assert!(first.is_some());
        assert_eq!(claim(&directory).unwrap_err().kind(), ErrorKind::ResourceBusy);
        drop(first);
        assert!(claim(&directory).unwrap().is_some());
    }

    #[test]
    fn what_is_no_directory_is_not_taken() {
        assert!(claim(Path::new("no/such/directory")).unwrap().is_none());
    }
}
