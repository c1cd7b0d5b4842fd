//! Figures of a run's time series, one file per group of columns that it has.

use std::path::Path;

use mpm_scenes::Series;
use mpm_scenes::output::{names, read_series};
use parvi_files::AtomicFile;

use crate::CommandError;
use crate::plots::{AxisKind, LineSeries, MultiplesPanel, MultiplesPlot, multiples};

/// Columns that share a panel: the group whose file it is in, what their names begin and end with, the rest of a name being the line's label,
/// and the label of the axis.
type Panel<Text> = (Text, Text, &'static str, &'static str);

/// Draws the series of a directory.
pub fn draw(directory: &Path, title: &str) -> Result<(), CommandError> {
    let (series, file) = (read_series(directory)?, directory.join(names::SERIES));
    if series.rows().is_empty() {
        return Err(CommandError::unreadable(
            &file,
            "no rows, so that there is nothing to draw",
        ));
    }
    let panels = panels(&series);
    let mut groups: Vec<&str> = panels.iter().map(|panel| panel.0.as_str()).collect();
    groups.dedup();
    remove_others(directory, &groups)?;
    for name in groups {
        let panels = panels.iter().filter(|panel| panel.0 == name);
        let panels: Vec<_> = panels.filter_map(|panel| drawn(&series, panel)).collect();
        if panels.is_empty() {
            continue;
        }
        let plot = MultiplesPlot::traces(format!("{title}: {}", name.replace('_', " ")), "time", panels);
        let figure = multiples(&plot).map_err(|error| CommandError::unreadable(&file, error))?;
        AtomicFile::write(directory.join(file_name(name)), figure)?;
    }
    Ok(())
}

fn file_name(group: &str) -> String {
    format!("series_{group}.svg")
}

/// Removes figures of probes that an earlier run had and this one has not.
fn remove_others(directory: &Path, groups: &[&str]) -> Result<(), CommandError> {
    let refused = |source| CommandError::file("read", directory, source);
    for entry in std::fs::read_dir(directory).map_err(refused)? {
        let entry = entry.map_err(refused)?;
        let name = entry.file_name().to_string_lossy().into_owned();
        let of_probe = name.starts_with("series_probe_") && name.ends_with(".svg");
        if of_probe && !groups.iter().any(|group| file_name(group) == name) {
            std::fs::remove_file(entry.path()).map_err(|source| CommandError::file("remove", entry.path(), source))?;
        }
    }
    Ok(())
}

/// The ends of the names of energies, of which the sum is drawn too.
const ENERGY: &str = "_energy";

/// The ends of the names of what has become of energy; columns of 0 alone are left out.
const SHARES: [&str; 2] = ["_dissipation", "_work"];

/// The panels of every run, group by group.
const OF_RUN: [Panel<&str>; 9] = [
    ("centre_of_mass", "centre_", "", "centre of mass"),
    ("energies", "", ENERGY, "energy"),
    ("energy_budget", "", SHARES[0], "energy taken"),
    ("energy_budget", "", SHARES[1], "work"),
    ("energy_budget", "energy_balance", "", "energy balance"),
    ("momenta", "momentum_", "", "momentum"),
    ("momenta", "angular_momentum", "", "angular momentum"),
    ("extent", "lower_", "", "lowest position"),
    ("extent", "upper_", "", "highest position"),
];

/// The panels of every probe: what follows its name in those of columns, and the label of the axis. A share is there where the scene asks for it.
const OF_PROBE: [(&str, &str); 4] = [
    ("displacement", "displacement"),
    ("velocity", "velocity"),
    ("stress", "stress"),
    ("share", "front of the share"),
];

/// All panels, those of a probe in a group of its own.
fn panels(series: &Series) -> Vec<Panel<String>> {
    let of_run = OF_RUN.map(|(group, begin, end, y_label)| (group.to_owned(), begin.to_owned(), end, y_label));
    let of_probe = probes(series).flat_map(|probe| {
        let panel = |(column, y_label)| (format!("probe_{probe}"), format!("{probe}_{column}_"), "", y_label);
        OF_PROBE.map(panel)
    });
    of_run.into_iter().chain(of_probe).collect()
}

/// Names of the probes: columns that end with the first component of a displacement.
fn probes(series: &Series) -> impl Iterator<Item = &str> {
    let columns = series.columns().iter();
    columns.filter_map(|column| column.strip_suffix("_displacement_x"))
}

/// The lines of a panel; `None` without any.
fn drawn(series: &Series, (_, begin, end, y_label): &Panel<String>) -> Option<MultiplesPanel> {
    let times = series.column("time")?;
    let through = |label: &str, values: Vec<f64>| LineSeries::through(label, times.iter().copied().zip(values));
    let mut lines: Vec<LineSeries> = Vec::new();
    for column in series.columns() {
        let rest = column.strip_prefix(begin.as_str());
        let Some(label) = rest.and_then(|rest| rest.strip_suffix(end)) else {
            continue;
        };
        let values = series.column(column)?;
        if SHARES.contains(end) && values.iter().all(|&share| share == 0.0) {
            continue;
        }
        lines.push(through(&label.trim_matches('_').replace('_', " "), values));
    }
    if *end == ENERGY && !lines.is_empty() {
        let sum = |k: usize| lines.iter().filter_map(|line| line.y.get(k)).sum();
        lines.push(through("total", (0..times.len()).map(sum).collect()));
    }
    (!lines.is_empty()).then(|| MultiplesPanel::over(*y_label, AxisKind::Linear, lines))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_group_of_columns_has_a_figure() {
        let columns = [
            "time",
            "centre_x",
            "kinetic_energy",
            "strain_energy",
            "transfer_dissipation",
            "momentum_x",
            "angular_momentum",
            "lower_x",
            "upper_x",
            "tip_displacement_x",
            "tip_velocity_x",
            "tip_stress_xx",
            "tip_share_x",
        ];
        let directory = tempfile::tempdir().unwrap();
        let rows = ["0.0,0,1,2,3,4,5,6,7,8,9,10,11", "1.0,1,2,3,4,5,6,7,8,9,10,11,12"];
        let text = format!("{}\n{}\n", columns.join(","), rows.join("\n"));
        std::fs::write(directory.path().join("series.csv"), text).unwrap();
        let earlier = directory.path().join("series_probe_head.svg");
        std::fs::write(&earlier, "").unwrap();
        draw(directory.path(), "bar").unwrap();
        assert!(!earlier.exists());
        for name in [
            "centre_of_mass",
            "energies",
            "energy_budget",
            "momenta",
            "extent",
            "probe_tip",
        ] {
            let figure = std::fs::read_to_string(directory.path().join(format!("series_{name}.svg"))).unwrap();
            assert!(figure.contains("bar: ") && figure.contains("</svg>"), "{name}");
        }
        let energies = std::fs::read_to_string(directory.path().join("series_energies.svg")).unwrap();
        assert!(
            ["kinetic", "strain", "total"]
                .iter()
                .all(|label| energies.contains(label))
        );
        let probe = std::fs::read_to_string(directory.path().join("series_probe_tip.svg")).unwrap();
        assert!(probe.contains("front of the share"));
        assert!(draw(&directory.path().join("none"), "").is_err());
    }
}
