//! The figure of the study `random-targets`.

use super::RandomTargets;
use crate::options::Dimension;
use crate::plots::{AxisKind, LineSeries, MultiplesPanel, MultiplesPlot, ReferenceLevel};
use crate::study::run_row::{ENERGY_RATIO, RunRow};

/// ED² of every method in order of size, one panel per dimension.
pub fn plot(study: &RandomTargets, rows: &[RunRow]) -> MultiplesPlot {
    MultiplesPlot {
        title: String::new(),
        x_label: "share of the targets (%)".to_owned(),
        y_label: "ED^{2} relative to independent draws".to_owned(),
        x_axis: AxisKind::Linear,
        y_axis: AxisKind::Logarithmic,
        panels: study.dims.iter().map(|&dim| panel(study, rows, dim)).collect(),
        notes: vec![
            "Every method's targets are in the order of its own ED²; runs without particles are left out.".to_owned(),
        ],
    }
}

fn panel(study: &RandomTargets, rows: &[RunRow], dim: Dimension) -> MultiplesPanel {
    let line = |label: &str| {
        let here = rows.iter().filter(|row| row.dim == dim.get() && row.method == label);
        let mut ratios: Vec<f64> = here.filter_map(ENERGY_RATIO).collect();
        ratios.sort_by(f64::total_cmp);
        let count = study.target_seeds.count.get() as f64;
        LineSeries {
            label: label.to_owned(),
            x: (0..ratios.len()).map(|k| 100.0 * (k as f64 + 0.5) / count).collect(),
            y: ratios,
            bars: Vec::new(),
        }
    };
    MultiplesPanel {
        title: format!("d = {dim}"),
        series: study.methods.iter().map(|method| line(method.label())).collect(),
        guides: Vec::new(),
        levels: vec![ReferenceLevel {
            value: 1.0,
            label: "independent draws".to_owned(),
        }],
    }
}
