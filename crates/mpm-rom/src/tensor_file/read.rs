use std::path::{Path, PathBuf};

use safetensors::SafeTensors;
use safetensors::tensor::Dtype;
use serde::de::DeserializeOwned;

use super::{Envelope, FileLayout, METADATA, TensorFault, TensorFileError};

/// A file of tensors in memory.
#[derive(Debug)]
pub struct TensorReader {
    path: PathBuf,
    bytes: Vec<u8>,
    header: serde_json::Value,
}

impl TensorReader {
    /// Reads the file and checks that it holds `kind` in the layout that is asked for.
    ///
    /// # Errors
    /// [`TensorFault::Unreadable`], [`TensorFault::Damaged`], [`TensorFault::Header`], [`TensorFault::Kind`], [`TensorFault::Version`].
    pub fn open(path: &Path, (kind, version): FileLayout) -> Result<Self, TensorFileError> {
        let damaged = |error| TensorFault::Damaged(error).of(path);
        let header = |reason: String| TensorFault::Header(reason).of(path);
        let bytes = std::fs::read(path).map_err(|error| TensorFault::Unreadable(error).of(path))?;
        // The views of `deserialize` are made anew for each tensor; here it only checks.
        SafeTensors::deserialize(&bytes).map_err(damaged)?;
        let (_, metadata) = SafeTensors::read_metadata(&bytes).map_err(damaged)?;
        let text = metadata.metadata().as_ref().and_then(|map| map.get(METADATA));
        let text = text.ok_or_else(|| header(format!("no key {METADATA}")))?;
        let envelope: Envelope = serde_json::from_str(text).map_err(|error| header(error.to_string()))?;
        let (found, expected) = (envelope.kind, kind);
        if found != expected {
            return Err(TensorFault::Kind { found, expected }.of(path));
        }
        let (found, expected) = (envelope.version, version);
        if found != expected {
            return Err(TensorFault::Version { kind, found, expected }.of(path));
        }
        Ok(Self {
            path: path.to_owned(),
            bytes,
            header: envelope.header,
        })
    }

    /// The header.
    ///
    /// # Errors
    /// [`TensorFault::Header`] for other fields.
    pub fn header<H: DeserializeOwned>(&self) -> Result<H, TensorFileError> {
        H::deserialize(&self.header).map_err(|error| TensorFault::Header(error.to_string()).of(&self.path))
    }

    /// The entries of a tensor, row-major, all of them finite.
    ///
    /// # Errors
    /// [`TensorFault::Missing`], [`TensorFault::Shape`], [`TensorFault::NotFinite`].
    pub fn tensor(&self, name: &str, shape: &[usize]) -> Result<Vec<f64>, TensorFileError> {
        let values = self.unchecked(name, shape)?;
        let name = name.to_owned();
        match values.iter().enumerate().find(|(_, value)| !value.is_finite()) {
            None => Ok(values),
            Some((entry, &value)) => Err(TensorFault::NotFinite { name, entry, value }.of(&self.path)),
        }
    }

    /// The entries of a tensor, row-major; for callers that say more about an entry that is not finite.
    ///
    /// # Errors
    /// [`TensorFault::Missing`], [`TensorFault::Shape`].
    pub fn unchecked(&self, name: &str, shape: &[usize]) -> Result<Vec<f64>, TensorFileError> {
        let refused = |fault: TensorFault| fault.of(&self.path);
        let tensors = SafeTensors::deserialize(&self.bytes).map_err(|error| refused(TensorFault::Damaged(error)))?;
        let view = tensors.tensor(name);
        let view = view.map_err(|_| refused(TensorFault::Missing(name.to_owned())))?;
        if view.dtype() != Dtype::F64 || view.shape() != shape {
            return Err(refused(TensorFault::Shape {
                name: name.to_owned(),
                dtype: format!("{:?}", view.dtype()),
                found: view.shape().to_vec(),
                expected: shape.to_vec(),
            }));
        }
        let (words, _) = view.data().as_chunks::<8>();
        Ok(words.iter().map(|word| f64::from_le_bytes(*word)).collect())
    }

    /// Refuses a file made for another number of axes.
    ///
    /// # Errors
    /// [`TensorFault::Dimension`].
    pub fn expect_dimension(&self, found: usize, expected: usize) -> Result<(), TensorFileError> {
        let fault = TensorFault::Dimension { found, expected };
        (found == expected).then_some(()).ok_or_else(|| fault.of(&self.path))
    }

    /// An error that says in which file values contradict each other.
    pub fn inconsistent(&self, reason: impl ToString) -> TensorFileError {
        TensorFault::Inconsistent(reason.to_string()).of(&self.path)
    }
}
