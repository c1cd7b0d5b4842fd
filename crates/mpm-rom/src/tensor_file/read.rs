use std::path::{Path, PathBuf};

use safetensors::SafeTensors;
use safetensors::tensor::Dtype;
use serde::de::DeserializeOwned;

use super::{Envelope, METADATA, TensorFileError};

/// A file of tensors in memory.
#[derive(Debug)]
pub struct TensorReader {
    path: PathBuf,
    bytes: Vec<u8>,
    header: serde_json::Value,
}

impl TensorReader {
    /// Reads the file and checks that it holds `kind` in the layout `version`.
    ///
    /// # Errors
    /// [`TensorFileError::Unreadable`], [`TensorFileError::Damaged`], [`TensorFileError::Header`], [`TensorFileError::Kind`],
    /// [`TensorFileError::Version`].
    pub fn open(path: &Path, kind: &'static str, version: u32) -> Result<Self, TensorFileError> {
        let owned = || path.to_owned();
        let bytes = std::fs::read(path).map_err(|source| TensorFileError::Unreadable { path: owned(), source })?;
        let damaged = |source| TensorFileError::Damaged { path: owned(), source };
        // The views of `deserialize` are made anew for each tensor; here it only checks.
        SafeTensors::deserialize(&bytes).map_err(damaged)?;
        let (_, metadata) = SafeTensors::read_metadata(&bytes).map_err(damaged)?;
        let text = metadata.metadata().as_ref().and_then(|map| map.get(METADATA));
        let text = text.ok_or_else(|| TensorFileError::Header {
            path: owned(),
            reason: format!("no key {METADATA}"),
        })?;
        let envelope: Envelope = serde_json::from_str(text).map_err(|error| TensorFileError::Header {
            path: owned(),
            reason: error.to_string(),
        })?;
        if envelope.kind != kind {
            return Err(TensorFileError::Kind {
                path: owned(),
                found: envelope.kind,
                expected: kind,
            });
        }
        if envelope.version != version {
            return Err(TensorFileError::Version {
                path: owned(),
                kind,
                found: envelope.version,
                expected: version,
            });
        }
        Ok(Self {
            path: owned(),
            bytes,
            header: envelope.header,
        })
    }

    /// The header.
    ///
    /// # Errors
    /// [`TensorFileError::Header`] for other fields.
    pub fn header<H: DeserializeOwned>(&self) -> Result<H, TensorFileError> {
        H::deserialize(&self.header).map_err(|error| TensorFileError::Header {
            path: self.path.clone(),
            reason: error.to_string(),
        })
    }

    /// The entries of a tensor, row-major, all of them finite.
    ///
    /// # Errors
    /// [`TensorFileError::Missing`], [`TensorFileError::Shape`], [`TensorFileError::NotFinite`].
    pub fn tensor(&self, name: &str, shape: &[usize]) -> Result<Vec<f64>, TensorFileError> {
        let values = self.unchecked(name, shape)?;
        match values.iter().position(|value| !value.is_finite()) {
            None => Ok(values),
            Some(entry) => Err(TensorFileError::NotFinite {
                path: self.path.clone(),
                name: name.to_owned(),
                entry,
                value: values.get(entry).copied().unwrap_or(f64::NAN),
            }),
        }
    }

    /// The entries of a tensor, row-major; for callers that say more about an entry that is not finite.
    ///
    /// # Errors
    /// [`TensorFileError::Missing`], [`TensorFileError::Shape`].
    pub fn unchecked(&self, name: &str, shape: &[usize]) -> Result<Vec<f64>, TensorFileError> {
        let missing = || TensorFileError::Missing {
            path: self.path.clone(),
            name: name.to_owned(),
        };
        let tensors = SafeTensors::deserialize(&self.bytes).map_err(|source| TensorFileError::Damaged {
            path: self.path.clone(),
            source,
        })?;
        let view = tensors.tensor(name).map_err(|_| missing())?;
        if view.dtype() != Dtype::F64 || view.shape() != shape {
            return Err(TensorFileError::Shape {
                path: self.path.clone(),
                name: name.to_owned(),
                dtype: format!("{:?}", view.dtype()),
                found: view.shape().to_vec(),
                expected: shape.to_vec(),
            });
        }
        let (words, _) = view.data().as_chunks::<8>();
        Ok(words.iter().map(|word| f64::from_le_bytes(*word)).collect())
    }

    /// Refuses a file made for another number of axes.
    ///
    /// # Errors
    /// [`TensorFileError::Dimension`].
    pub fn expect_dimension(&self, found: usize, expected: usize) -> Result<(), TensorFileError> {
        if found == expected {
            return Ok(());
        }
        Err(TensorFileError::Dimension {
            path: self.path.clone(),
            found,
            expected,
        })
    }

    /// An error that says in which file values contradict each other.
    pub fn inconsistent(&self, reason: impl ToString) -> TensorFileError {
        TensorFileError::Inconsistent {
            path: self.path.clone(),
            reason: reason.to_string(),
        }
    }
}
