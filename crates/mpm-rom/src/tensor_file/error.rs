use std::path::{Path, PathBuf};

/// A file of tensors that cannot be written or read, and why.
#[derive(Debug, thiserror::Error)]
#[error("{}", described(path, fault))]
pub struct TensorFileError {
    /// The file.
    pub path: PathBuf,
    /// What is wrong with it.
    pub fault: Box<TensorFault>,
}

/// What is wrong with a file of tensors.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TensorFault {
    /// The file cannot be opened or read.
    #[error("{0}")]
    Unreadable(std::io::Error),
    /// The file cannot be written.
    #[error(transparent)]
    Unwritable(mpm_scenes::SimulationError),
    /// The file is no safetensors file, or is cut off.
    #[error("no safetensors file, or damaged: {0}")]
    Damaged(safetensors::SafeTensorError),
    /// A safetensors file of another program, or with a header that has other fields.
    #[error("metadata: {0}")]
    Header(String),
    /// The file holds something else.
    #[error("holds {found}, not {expected}")]
    Kind {
        /// What it holds.
        found: String,
        /// What was asked for.
        expected: &'static str,
    },
    /// The file was written by another version of the layout.
    #[error("layout {found} of {kind}; this program reads {expected}")]
    Version {
        /// What it holds.
        kind: &'static str,
        /// Its layout.
        found: u32,
        /// The layout that is read.
        expected: u32,
    },
    /// The file belongs to another number of axes.
    #[error("made for dimension {found}, not {expected}")]
    Dimension {
        /// D of the file.
        found: usize,
        /// D asked for.
        expected: usize,
    },
    /// A tensor is not there.
    #[error("no tensor {0}")]
    Missing(String),
    /// A tensor is not `F64`, or has another shape.
    #[error("tensor {name} is {dtype} {found:?}, not F64 {expected:?}")]
    Shape {
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
    #[error("tensor {name}: entry {entry} is {value}")]
    NotFinite {
        /// The tensor.
        name: String,
        /// The entry, row-major.
        entry: usize,
        /// Its value.
        value: f64,
    },
    /// The values are readable but contradict each other.
    #[error("{0}")]
    Inconsistent(String),
}

/// The fault with its file, once.
fn described(path: &Path, fault: &TensorFault) -> String {
    match fault {
        TensorFault::Unwritable(error) => error.to_string(),
        fault => format!("{}: {fault}", path.display()),
    }
}

impl TensorFault {
    /// The error of a file with this fault.
    pub(super) fn of(self, path: impl Into<PathBuf>) -> TensorFileError {
        TensorFileError {
            path: path.into(),
            fault: Box::new(self),
        }
    }
}
