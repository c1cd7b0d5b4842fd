//! Figures of the tables of `kernel_plots` (mpm-mesh): `kernel_figures DIRECTORY OUT`.
//!
//! `graded_R.svg`: nodes 5 to 8, weights and gradients with η and without; `ampersand.svg`: a node at a re-entrant corner.

use std::collections::BTreeMap;
use std::error::Error;
use std::path::Path;

use parvi_experiments::output::AtomicFile;
use parvi_experiments::plots::{AxisKind, HeatMapPlot, HeatPanel, TracePanel, TracePlot, TraceSeries, heat_map, trace};

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
            TraceSeries {
                label: format!("node {node}"),
                step: rows.clone().map(|row| x[row]).collect(),
                value: rows.map(|row| values[row]).collect(),
            }
        };
        panels.push(TracePanel {
            y_label: label.to_owned(),
            y_axis: AxisKind::Linear,
            series: (5..=8).map(of_node).collect(),
            levels: Vec::new(),
        });
    }
    let plot = TracePlot {
        title: format!("Kernels of segments of sizes 1, R, R², R in turn, R = {ratio}"),
        x_label: "x (m)".to_owned(),
        panels,
    };
    Ok(trace(&plot)?)
}

/// Parts of the figure's edge.
const PIXELS: usize = 64;

fn ampersand(table: &Table) -> Result<String> {
    let (x, y) = (table.column("x")?, table.column("y")?);
    let range = |values: &[f64]| {
        let low = values.iter().copied().fold(f64::INFINITY, f64::min);
        let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        (low, (high - low) / PIXELS as f64)
    };
    let ((left, width), (bottom, height)) = (range(x), range(y));
    let edges = |low: f64, size: f64| (0..=PIXELS).map(|k| low + size * k as f64).collect();
    let place = |value: f64, low: f64, size: f64| (((value - low) / size) as usize).min(PIXELS - 1);
    let mut panels = Vec::new();
    for (suffix, with) in [("", "with η"), ("_distance_alone", "without η")] {
        let weights = table.column(&format!("weight{suffix}"))?;
        let (along_x, along_y) = (
            table.column(&format!("gradient_x{suffix}"))?,
            table.column(&format!("gradient_y{suffix}"))?,
        );
        let lengths: Vec<f64> = along_x.iter().zip(along_y).map(|(a, b)| a.hypot(*b)).collect();
        for (values, what) in [(weights, "weight"), (&lengths[..], "length of the gradient")] {
            let largest = values.iter().copied().fold(0.0, f64::max);
            let mut sums = vec![(0.0, 0u32); PIXELS * PIXELS];
            for ((x, y), value) in x.iter().zip(y).zip(values) {
                let (sum, count) = &mut sums[place(*y, bottom, height) * PIXELS + place(*x, left, width)];
                *sum += value;
                *count += 1;
            }
            let share = |(sum, count): (f64, u32)| (count > 0).then(|| sum / f64::from(count) / largest);
            panels.push(HeatPanel {
                title: format!("{what}, {with}; 100 % = {largest:.3}"),
                shares: sums.into_iter().map(share).collect(),
            });
        }
    }
    let plot = HeatMapPlot {
        title: "A node at a re-entrant corner of an \"&\"".to_owned(),
        x_label: "x (m)".to_owned(),
        y_label: "y (m)".to_owned(),
        x_edges: edges(left, width),
        y_edges: edges(bottom, height),
        axis: AxisKind::Linear,
        panels,
        notes: vec!["Grey: outside of the shape, or of the cells whose rings have the node.".to_owned()],
    };
    Ok(heat_map(&plot)?)
}
