use std::borrow::Cow;
use std::collections::HashMap;
use std::path::Path;

use mpm_scenes::output::write_whole;
use safetensors::tensor::{Dtype, View};
use serde::Serialize;

use super::{Envelope, METADATA, TensorFileError};

/// Collects tensors and writes them as one file.
#[derive(Debug, Default)]
pub struct TensorWriter {
    tensors: Vec<(String, Tensor)>,
}

#[derive(Debug)]
struct Tensor {
    shape: Vec<usize>,
    bytes: Vec<u8>,
}

impl View for &Tensor {
    fn dtype(&self) -> Dtype {
        Dtype::F64
    }

    fn shape(&self) -> &[usize] {
        &self.shape
    }

    fn data(&self) -> Cow<'_, [u8]> {
        Cow::Borrowed(&self.bytes)
    }

    fn data_len(&self) -> usize {
        self.bytes.len()
    }
}

impl TensorWriter {
    /// Adds a tensor, row-major; the product of `shape` is the number of values (the container refuses others).
    pub fn add(&mut self, name: impl Into<String>, shape: &[usize], values: impl IntoIterator<Item = f64>) {
        let bytes = values.into_iter().flat_map(f64::to_le_bytes).collect();
        let tensor = Tensor {
            shape: shape.to_vec(),
            bytes,
        };
        self.tensors.push((name.into(), tensor));
    }

    /// Writes the file whole or not at all; an earlier one is replaced.
    ///
    /// # Errors
    /// [`TensorFileError::Unwritable`], [`TensorFileError::Header`] for a header that is no JSON, [`TensorFileError::Damaged`] for a tensor whose
    /// shape and number of values differ.
    pub fn write(self, path: &Path, kind: &str, version: u32, header: &impl Serialize) -> Result<(), TensorFileError> {
        let refused = |error: serde_json::Error| TensorFileError::Header {
            path: path.to_owned(),
            reason: error.to_string(),
        };
        let envelope = Envelope {
            kind: kind.to_owned(),
            version,
            header: serde_json::to_value(header).map_err(refused)?,
        };
        let metadata = HashMap::from([(METADATA.to_owned(), serde_json::to_string(&envelope).map_err(refused)?)]);
        let tensors = self.tensors.iter().map(|(name, tensor)| (name.as_str(), tensor));
        let bytes = safetensors::serialize(tensors, Some(metadata)).map_err(|source| TensorFileError::Damaged {
            path: path.to_owned(),
            source,
        })?;
        Ok(write_whole(path, &bytes)?)
    }
}
