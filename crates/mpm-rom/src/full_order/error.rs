use mpm_scenes::{SceneError, SimulationError};

use crate::snapshots::SnapshotsError;
use crate::words::in_number;

/// Why there is no data.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FullOrderError {
    /// No run was asked for.
    #[error("no runs")]
    NoRuns,
    /// A stop was asked for between two runs.
    #[error("stopped after {}", in_number(*.runs, "run"))]
    Stopped {
        /// Runs done.
        runs: usize,
    },
    /// One of several runs failed.
    #[error("run {run} ({values}): {source}")]
    Run {
        /// The run, counted from 0.
        run: usize,
        /// Its parameters and their values.
        values: String,
        /// What went wrong.
        source: Box<Self>,
    },
    /// The file cannot be read.
    #[error("cannot read {file}: {source}")]
    Unreadable {
        /// The scene's file.
        file: String,
        /// What the system says.
        source: std::io::Error,
    },
    /// A key of a change does not fit the document.
    #[error("{file}, change of `{key}`: {reason}")]
    Change {
        /// The scene's file.
        file: String,
        /// The dotted key.
        key: String,
        /// What is in the way.
        reason: String,
    },
    /// The scene has another dimension than is asked for.
    #[error("a scene of dimension {found}, not {expected}")]
    Dimension {
        /// That of the scene.
        found: usize,
        /// What is asked for.
        expected: usize,
    },
    /// The file is no TOML, or the scene cannot be run.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// Materials of different density.
    #[error("densities {densities:?}: one for all materials is needed")]
    Densities {
        /// ρ₀ of the materials.
        densities: Vec<f64>,
    },
    /// A change of parameters changes the points, so that the runs have no common body.
    #[error("run {run} has other points or frames than run 0")]
    AnotherBody {
        /// The run, counted from 0.
        run: usize,
    },
    /// The instants at which frames are looked for would change the time steps of the scene.
    #[error("the number of instants per frame, {per_frame}, does not divide that of its steps, {steps}")]
    FramesBetween {
        /// Instants per frame.
        per_frame: u64,
        /// Time steps of a frame.
        steps: u64,
    },
    /// Time steps of a run were cut, so that a reduced run would not be damped alike.
    #[error(
        "{file}: the number of time steps is {found}, where time.step = {step} makes {expected}: the Courant condition, time.end or an interval of [output] has cut some of them, and reduced runs would not be damped alike"
    )]
    CutSteps {
        /// The scene's file.
        file: String,
        /// Steps taken.
        found: u64,
        /// The time step.
        step: f64,
        /// Steps of this length until the end.
        expected: f64,
    },
    /// A run failed.
    #[error(transparent)]
    Simulation(#[from] SimulationError),
    /// What the runs gave is of no use.
    #[error(transparent)]
    Snapshots(#[from] SnapshotsError),
    /// The mechanics refused a body or a step.
    #[error(transparent)]
    Mechanics(#[from] mpm_core::MpmError),
}
