use std::collections::HashMap;
use std::path::Path;

use mpm_scenes::output::write_whole;
use safetensors::tensor::{Dtype, TensorView};
use serde::Serialize;

use super::{Envelope, FileLayout, METADATA, TensorFault, TensorFileError};

/// Collects tensors and writes them as one file.
#[derive(Debug, Default)]
pub struct TensorWriter {
    /// Names, shapes and bytes.
    tensors: Vec<(String, Vec<usize>, Vec<u8>)>,
}

impl TensorWriter {
    /// Adds a tensor, row-major; the product of `shape` is the number of values (the container refuses others).
    pub fn add(&mut self, name: impl Into<String>, shape: &[usize], values: impl IntoIterator<Item = f64>) {
        let bytes = values.into_iter().flat_map(f64::to_le_bytes).collect();
        self.tensors.push((name.into(), shape.to_vec(), bytes));
    }

    /// Adds a tensor of one axis.
    pub fn add_list(&mut self, name: &str, values: &[f64]) {
        self.add(name, &[values.len()], values.iter().copied());
    }

    /// Writes the file whole or not at all; an earlier one is replaced.
    ///
    /// # Errors
    /// [`TensorFault::Unwritable`], [`TensorFault::Header`] for a header that is no JSON, [`TensorFault::Damaged`] for a tensor whose
    /// shape and number of values differ.
    pub fn write(
        self,
        path: &Path,
        (kind, version): FileLayout,
        header: &impl Serialize,
    ) -> Result<(), TensorFileError> {
        let refused = |error: serde_json::Error| TensorFault::Header(error.to_string()).of(path);
        let envelope = Envelope {
            kind: kind.to_owned(),
            version,
            header: serde_json::to_value(header).map_err(refused)?,
        };
        let metadata = HashMap::from([(METADATA.to_owned(), serde_json::to_string(&envelope).map_err(refused)?)]);
        let damaged = |error| TensorFault::Damaged(error).of(path);
        let views = self.tensors.iter().map(|(name, shape, bytes)| {
            let view = TensorView::new(Dtype::F64, shape.clone(), bytes).map_err(damaged)?;
            Ok((name, view))
        });
        let views: Vec<_> = views.collect::<Result<_, TensorFileError>>()?;
        let bytes = safetensors::serialize(views, Some(metadata)).map_err(damaged)?;
        write_whole(path, &bytes).map_err(|error| TensorFault::Unwritable(error).of(path))
    }
}
