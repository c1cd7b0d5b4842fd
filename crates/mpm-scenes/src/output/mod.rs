//! The files of a run.

mod earlier_frames;
mod frame;
mod pvd;
mod series_file;
mod validation_file;
mod vtu;
mod whole_file;

pub use earlier_frames::{remove_file, remove_frames};
pub use frame::{Frame, frame_files};
pub use pvd::write_index;
pub use series_file::{SeriesFile, read_series};
pub use validation_file::write_validation;
pub use vtu::vtu;
pub use whole_file::write_whole;

/// Names of the files in a run's directory.
pub mod names {
    /// The scene as it was run.
    pub const SCENE: &str = "scene.toml";
    /// The time series.
    pub const SERIES: &str = "series.csv";
    /// The index of the frames.
    pub const INDEX: &str = "particles.pvd";
    /// The comparison with the reference.
    pub const VALIDATION: &str = "validation.csv";
    /// The state to go on from.
    pub const CHECKPOINT: &str = "checkpoint.cbor";

    /// The frame of this number.
    pub fn frame(number: u64) -> String {
        format!("particles_{number:06}.vtu")
    }
}

/// A number that reads back to the same bits, in scientific notation where that is shorter.
pub(crate) fn number(value: f64) -> String {
    format!("{value:?}")
}
