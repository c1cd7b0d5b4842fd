//! What a case gave.

use serde::{Deserialize, Serialize};

use crate::study::attempt::Status;
use crate::study::results;

/// A number of one run; a line of results.csv.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// The case.
    pub case: String,
    /// How the run ended.
    pub status: Status,
    /// Why it ended before its time.
    pub reason: String,
    /// The family.
    pub family: String,
    /// The series within the family.
    pub label: String,
    /// The place on the horizontal axis.
    pub x: f64,
    /// What was read.
    pub quantity: String,
    /// The number.
    pub value: Option<f64>,
    /// What validation.csv compares it with.
    pub reference: Option<f64>,
    /// How far from the reference it may be.
    pub tolerance: Option<f64>,
    /// Steps of the run.
    pub steps: Option<u64>,
    /// Its particles.
    pub particles: Option<usize>,
    /// The scene's fingerprint; its run is in `raw/` under this name.
    pub scene: String,
    /// That of the run that it is compared with; empty where there is none.
    #[serde(default)]
    pub against: String,
    /// Time of the run; none where a part of it was there before.
    pub wall_seconds: Option<f64>,
}

impl results::Row for Row {
    fn case(&self) -> &str {
        &self.case
    }
}
