use std::path::PathBuf;

/// Why a file of tensors cannot be written or read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TensorFileError {
    /// The file cannot be opened or read.
    #[error("{}: {source}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// The file cannot be written.
    #[error(transparent)]
    Unwritable(#[from] mpm_scenes::SimulationError),
    /// The file is no safetensors file, or is cut off.
    #[error("{}: no safetensors file, or damaged: {source}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What the reader of the container says.
        source: safetensors::SafeTensorError,
    },
    /// A safetensors file of another program, or with a header that has other fields.
    #[error("{}: metadata: {reason}", path.display())]
    Header {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// The file holds something else.
    #[error("{}: holds {found}, not {expected}", path.display())]
    Kind {
        /// The file.
        path: PathBuf,
        /// What it holds.
        found: String,
        /// What was asked for.
        expected: &'static str,
    },
    /// The file was written by another version of the layout.
    #[error("{}: layout {found} of {kind}; this program reads {expected}", path.display())]
    Version {
        /// The file.
        path: PathBuf,
        /// What it holds.
        kind: &'static str,
        /// Its layout.
        found: u32,
        /// The layout that is read.
        expected: u32,
    },
    /// The file belongs to another number of axes.
    #[error("{}: made for {found} dimensions, not {expected}", path.display())]
    Dimension {
        /// The file.
        path: PathBuf,
        /// D of the file.
        found: usize,
        /// D asked for.
        expected: usize,
    },
    /// A tensor is not there.
    #[error("{}: no tensor {name}", path.display())]
    Missing {
        /// The file.
        path: PathBuf,
        /// The tensor.
        name: String,
    },
    /// A tensor is not `F64`, or has another shape.
    #[error("{}: tensor {name} is {dtype} {found:?}, not F64 {expected:?}", path.display())]
    Shape {
        /// The file.
        path: PathBuf,
        /// The tensor.
        name: String,
        /// Its type.
        dtype: String,
        /// Its shape.
        found: Vec<usize>,
        /// The shape expected.
        expected: Vec<usize>,
    },
    /// An entry of a tensor is NaN or infinite.
    #[error("{}: tensor {name}: entry {entry} is {value}", path.display())]
    NotFinite {
        /// The file.
        path: PathBuf,
        /// The tensor.
        name: String,
        /// The entry, row-major.
        entry: usize,
        /// Its value.
        value: f64,
    },
    /// The values are readable but contradict each other.
    #[error("{}: {reason}", path.display())]
    Inconsistent {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        reason: String,
    },
}
