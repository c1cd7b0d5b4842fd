//! Files of named tensors with a typed header: what snapshots, models and checkpoints are kept in.
//!
//! The container is safetensors, every tensor `F64`, row-major. Its metadata has the one key `mpm-rom`, whose value is a JSON object
//! `{"kind": …, "version": …, "header": …}`: `kind` names what the file holds (`snapshots`, `model`, `training-checkpoint`), `version` the layout
//! of that kind, and `header` what is no tensor.

mod error;
mod read;
mod write;

pub use error::{TensorFault, TensorFileError};
pub use read::TensorReader;
pub use write::TensorWriter;

use serde::{Deserialize, Serialize};

/// The key of the metadata.
const METADATA: &str = "mpm-rom";

/// What a file holds, and the version of its layout.
pub type FileLayout = (&'static str, u32);

/// What the metadata holds.
#[derive(Serialize, Deserialize)]
struct Envelope {
    kind: String,
    version: u32,
    header: serde_json::Value,
}
