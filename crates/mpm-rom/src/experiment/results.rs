//! What reduced runs gave, as tables.

use std::fmt::Write;

/// A reduced run beside the full-order run of the same case.
#[derive(Clone, Debug, PartialEq)]
pub struct ReducedRow {
    /// Number of the test case, counted from 0.
    pub case: usize,
    /// Values of its parameters.
    pub parameters: Vec<f64>,
    /// The family of maps.
    pub manifold: &'static str,
    /// |𝒫|.
    pub samples: usize,
    /// How they were chosen.
    pub chosen: &'static str,
    /// The quadrature.
    pub quadrature: &'static str,
    /// The update.
    pub update: &'static str,
    /// Δt over that of the full-order run.
    pub step_factor: u64,
    /// The position error over all frames reached, in per cent.
    pub error: f64,
    /// What encoder and network lose of the full-order frames without any dynamics, in per cent; `None` without an encoder.
    pub reconstruction_error: Option<f64>,
    /// Time simulated (s).
    pub simulated: f64,
    /// Steps.
    pub steps: u64,
    /// Wall time of the reduced steps (s).
    pub seconds: f64,
    /// Wall time of the full-order run of as many steps (s).
    pub full_seconds: f64,
    /// |ℐ| of the last step.
    pub nodes: usize,
    /// Quadrature points of the last step.
    pub quadrature_points: usize,
    /// Neighbour lists made.
    pub refreshes: u64,
    /// `finished`, or why the run ended before its time.
    pub outcome: String,
}

impl ReducedRow {
    /// How the run was made: manifold, samples and their choice, quadrature, update and step factor.
    pub fn way(&self) -> (&'static str, usize, &'static str, &'static str, &'static str, u64) {
        (
            self.manifold,
            self.samples,
            self.chosen,
            self.quadrature,
            self.update,
            self.step_factor,
        )
    }
}

/// A frame of a reduced run.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameRow {
    /// t (s).
    pub time: f64,
    /// The position error of this frame, in per cent.
    pub error: f64,
    /// x̂.
    pub latent: Vec<f64>,
}

/// All rows as CSV.
pub(super) fn results(parameters: &[String], rows: &[ReducedRow]) -> String {
    let mut text = format!(
        "case,{},manifold,samples,choice,quadrature,update,step_factor,position_error_percent,",
        parameters.join(",")
    );
    text.push_str(
        "reconstruction_error_percent,simulated_seconds,steps,seconds,full_seconds,speed_up,real_time_factor,",
    );
    text.push_str("nodes,quadrature_points,neighbour_lists,outcome\n");
    for row in rows {
        let values: Vec<String> = row.parameters.iter().map(|value| format!("{value:?}")).collect();
        let (speed_up, real_time) = (row.full_seconds / row.seconds, row.simulated / row.seconds);
        // A String takes everything.
        let _ = writeln!(
            text,
            "{},{},{},{},{},{},{},{},{:?},{},{:?},{},{:.6},{:.6},{speed_up:.3},{real_time:.3},{},{},{},\"{}\"",
            row.case,
            values.join(","),
            row.manifold,
            row.samples,
            row.chosen,
            row.quadrature,
            row.update,
            row.step_factor,
            row.error,
            row.reconstruction_error
                .map_or(String::new(), |error| format!("{error:?}")),
            row.simulated,
            row.steps,
            row.seconds,
            row.full_seconds,
            row.nodes,
            row.quadrature_points,
            row.refreshes,
            row.outcome.replace('"', "'"),
        );
    }
    text
}

/// All frames of all runs as CSV; `run` is the row of the run in the results, counted from 0.
pub(super) fn frames(runs: &[Vec<FrameRow>]) -> String {
    let coordinates = runs.iter().flatten().next().map_or(0, |row| row.latent.len());
    let names: String = (1..=coordinates).map(|k| format!(",x{k}")).collect();
    let mut text = format!("run,time,position_error_percent{names}\n");
    for (run, rows) in runs.iter().enumerate() {
        for row in rows {
            let latent: String = row.latent.iter().map(|value| format!(",{value:?}")).collect();
            let _ = writeln!(text, "{run},{:?},{:?}{latent}", row.time, row.error);
        }
    }
    text
}
