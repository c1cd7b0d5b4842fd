//! The figure of the study `random-targets`.

use super::RandomTargets;
use crate::options::Dimension;
use crate::plots::{AxisKind, LineSeries, MultiplesPanel, MultiplesPlot, ReferenceLevel};
use crate::study::run_row::{ENERGY_RATIO, RunRow};

/// ED² of every method in order of size, one panel per dimension.
pub fn plot(study: &RandomTargets, rows: &[RunRow]) -> MultiplesPlot {
    MultiplesPlot {
        x_axis: AxisKind::Linear,
        panels: study.dims.iter().map(|&dim| panel(study, rows, dim)).collect(),
        notes: vec![
            "Every method's targets are in the order of its own ED²; runs without particles are left out.".to_owned(),
        ],
        ..MultiplesPlot::logarithmic("share of the targets (%)", "ED^{2} relative to independent draws")
    }
}

fn panel(study: &RandomTargets, rows: &[RunRow], dim: Dimension) -> MultiplesPanel {
    let line = |label: &str| {
        let here = rows.iter().filter(|row| row.dim == dim.get() && row.method == label);
        let count = study.target_seeds.count.get();
        LineSeries::in_order(label, here.filter_map(ENERGY_RATIO).collect(), count)
    };
    MultiplesPanel {
        title: format!("d = {dim}"),
        series: study.methods.iter().map(|method| line(method.label())).collect(),
        levels: vec![ReferenceLevel::new(1.0, "independent draws")],
        ..MultiplesPanel::default()
    }
}
