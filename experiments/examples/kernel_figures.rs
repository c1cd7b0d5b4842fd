//! Figures of the tables of `kernel_plots` (mpm-mesh): `kernel_figures DIRECTORY OUT`.
//!
//! `graded_R.svg`: nodes 5 to 8, weights and gradients with η and without; `ampersand.svg`: a node at a re-entrant corner.

use std::collections::BTreeMap;
use std::error::Error;
use std::path::Path;

use parvi_experiments::plots::{
    Axis, AxisKind, CellAxis, HeatMapPlot, HeatPanel, LineSeries, MultiplesPanel, MultiplesPlot, heat_map, multiples,
};
use parvi_files::AtomicFile;

type Result<T> = std::result::Result<T, Box<dyn Error>>;

fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [directory, out] = &arguments[..] else {
        return Err("usage: kernel_figures DIRECTORY OUT".into());
    };
    let (directory, out) = (Path::new(directory), Path::new(out));
    for ratio in ["1.1", "1.2", "1.3", "1.4", "1.5"] {
        let table = Table::read(&directory.join(format!("graded_{ratio}.csv")))?;
        AtomicFile::write(out.join(format!("graded_{ratio}.svg")), graded(&table, ratio)?)?;
    }
    let table = Table::read(&directory.join("ampersand.csv"))?;
    AtomicFile::write(out.join("ampersand.svg"), ampersand(&table)?)?;
    Ok(())
}

/// Columns by name.
struct Table(BTreeMap<String, Vec<f64>>);

impl Table {
    fn read(path: &Path) -> Result<Self> {
        let mut reader = csv::Reader::from_path(path)?;
        let names: Vec<String> = reader.headers()?.iter().map(str::to_owned).collect();
        let mut columns: BTreeMap<String, Vec<f64>> = names.iter().map(|name| (name.clone(), Vec::new())).collect();
        for row in reader.records() {
            for (name, value) in names.iter().zip(row?.iter()) {
                columns.entry(name.clone()).or_default().push(value.parse()?);
            }
        }
        Ok(Self(columns))
    }

    fn column(&self, name: &str) -> Result<&[f64]> {
        let column = self.0.get(name).ok_or_else(|| format!("no column {name}"))?;
        Ok(column)
    }
}

fn graded(table: &Table, ratio: &str) -> Result<String> {
    let (x, nodes) = (table.column("x")?, table.column("node")?);
    let mut panels = Vec::new();
    for (column, label) in [
        ("weight", "weight"),
        ("gradient", "gradient (1/m)"),
        ("weight_distance_alone", "weight without η"),
        ("gradient_distance_alone", "gradient without η (1/m)"),
    ] {
        let values = table.column(column)?;
        let of_node = |node: u32| {
            let rows = (0..x.len()).filter(move |&row| nodes[row] == f64::from(node));
            LineSeries::through(format!("node {node}"), rows.map(|row| (x[row], values[row])))
        };
        panels.push(MultiplesPanel::over(label, AxisKind::Linear, (5..=8).map(of_node)));
    }
    let title = format!("Kernels of segments of sizes 1, R, R², R in turn, R = {ratio}");
    Ok(multiples(&MultiplesPlot::traces(title, "x (m)", panels))?)
}

/// Parts of the figure's edge.
const PIXELS: usize = 40;

/// A pixel has the value of the nearest point, up to so many pixels away.
const NEAR: f64 = 1.0;

fn ampersand(table: &Table) -> Result<String> {
    let (x, y) = (table.column("x")?, table.column("y")?);
    let edges = |values: &[f64]| -> Vec<f64> {
        let low = values.iter().copied().fold(f64::INFINITY, f64::min);
        let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let edge = |k| low + (high - low) * k as f64 / PIXELS as f64;
        (0..=PIXELS).map(edge).collect()
    };
    let (x_edges, y_edges) = (edges(x), edges(y));
    let (width, height) = (x_edges[1] - x_edges[0], y_edges[1] - y_edges[0]);
    let mut nearest = Vec::with_capacity(PIXELS * PIXELS);
    for row in y_edges.windows(2) {
        for column in x_edges.windows(2) {
            let centre = [0.5 * (column[0] + column[1]), 0.5 * (row[0] + row[1])];
            let away = |k: &usize| ((x[*k] - centre[0]) / width).hypot((y[*k] - centre[1]) / height);
            let point = (0..x.len()).min_by(|a, b| away(a).total_cmp(&away(b)));
            nearest.push(point.filter(|point| away(point) <= NEAR));
        }
    }
    let mut panels = Vec::new();
    for (suffix, with) in [("", "with η"), ("_distance_alone", "without η")] {
        let weights = table.column(&format!("weight{suffix}"))?;
        let (along_x, along_y) = (
            table.column(&format!("gradient_x{suffix}"))?,
            table.column(&format!("gradient_y{suffix}"))?,
        );
        let lengths: Vec<f64> = along_x.iter().zip(along_y).map(|(a, b)| a.hypot(*b)).collect();
        for (values, what) in [(weights, "weight"), (&lengths[..], "|gradient|")] {
            let largest = values.iter().copied().fold(0.0, f64::max);
            let share = |point: &Option<usize>| point.map(|point| values[point] / largest);
            panels.push(HeatPanel {
                title: format!("{what} {with}, 100 % = {largest:.3}"),
                shares: nearest.iter().map(share).collect(),
            });
        }
    }
    let axis = |label: &str, edges: Vec<f64>| CellAxis {
        axis: Axis::new(label, AxisKind::Linear),
        edges,
    };
    let plot = HeatMapPlot {
        title: "A node at a re-entrant corner of an \"&\"".to_owned(),
        x: axis("x (m)", x_edges),
        y: axis("y (m)", y_edges),
        panels,
        notes: vec!["Grey: outside of the shape, or of the cells whose rings have the node.".to_owned()],
    };
    Ok(heat_map(&plot)?)
}
