//! A committed scene, with changes, run in a temporary directory.

use std::path::Path;

use mpm_scenes::{Scene, Series, ValidationRow, simulate};

/// What a run gave.
pub struct Finished {
    /// What was run.
    pub scene: Scene,
    /// Its rows of `validation.csv`.
    pub rows: Vec<ValidationRow>,
    /// Its time series.
    pub series: Series,
}

/// The figures of earlier runs.
const FIGURES: &str = include_str!("figures.json");

/// How far a figure may be from the pinned one, relatively: compilers and processors round differently, and contact amplifies that.
const SAME: f64 = 1e-3;

/// Runs the committed scene `name` with texts of it replaced.
pub fn run(name: &str, changes: &[(&str, &str)]) -> Finished {
    let directory = tempfile::tempdir().expect("a directory");
    run_into(directory.path(), name, changes)
}

/// The same with its files in this directory.
pub fn run_into(directory: &Path, name: &str, changes: &[(&str, &str)]) -> Finished {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("scenes/{name}.toml"));
    let mut text = std::fs::read_to_string(&path).expect("a committed scene");
    for (old, new) in changes {
        assert!(text.contains(old), "{name} has no {old:?}");
        text = text.replace(old, new);
    }
    let scene = Scene::parse(&text, &path).expect("a valid scene");
    let summary = simulate(&scene, directory, &mut ()).expect("a run to the end");
    let text = std::fs::read_to_string(directory.join("series.csv")).expect("written");
    let mut lines = text.lines();
    let mut series = Series::new(lines.next().expect("a header").split(',').map(str::to_owned).collect());
    for line in lines {
        assert!(series.push(line.split(',').map(|value| value.parse().expect("a number")).collect()));
    }
    Finished {
        scene,
        rows: summary.validation,
        series,
    }
}

impl Finished {
    /// The row whose quantity begins with `name`.
    pub fn row(&self, name: &str) -> &ValidationRow {
        let found = self.rows.iter().find(|row| row.quantity.starts_with(name));
        found.unwrap_or_else(|| panic!("{name} in {:?}", self.rows))
    }

    /// A column of the series.
    pub fn column(&self, name: &str) -> Vec<f64> {
        self.series.column(name).expect("a column")
    }

    /// Asserts that all rows pass, and that they are those of before.
    pub fn passes_as_pinned(&self, problem: &str) {
        for row in &self.rows {
            assert!(row.passes(), "{problem}: {row:?}");
            pinned(problem, &row.quantity, row.measured);
        }
    }
}

/// Asserts that a figure is the pinned one.
pub fn pinned(problem: &str, quantity: &str, measured: f64) {
    let figures: serde_json::Value = serde_json::from_str(FIGURES).expect("a table of tables");
    let before = figures[problem][quantity].as_f64();
    let near = |before: f64| (measured - before).abs() <= SAME * before.abs();
    assert!(
        before.is_some_and(near),
        "{problem}: {quantity} = {measured:e}, pinned {before:?}"
    );
}
