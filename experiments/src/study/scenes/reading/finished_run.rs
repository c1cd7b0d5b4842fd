//! A run that came to its end.

use std::path::PathBuf;

use mpm_scenes::{Series, Summary};

use crate::study::scenes::scene_files::PreparedScene;

/// What a run gave.
pub struct FinishedRun<'a> {
    /// What was run.
    pub prepared: &'a PreparedScene,
    /// Where its files are.
    pub directory: PathBuf,
    /// How it ended.
    pub summary: Summary,
    /// Its time series.
    pub series: Series,
}
