//! Error against cost: what each method reaches for its time, on every target.

use super::line_series::LineSeries;
use super::multiples::{Look, MultiplesPanel, MultiplesPlot};
use super::statistics::summarize;

/// A method at growing budgets.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TimeErrorCurve {
    /// The method's name, which decides colour and marker.
    pub method: String,
    /// The settings, in the order in which they are connected: cost, e.g. wall time or score evaluations, and error of every run; where one is not finite, the run failed.
    pub settings: Vec<Vec<(f64, f64)>>,
}

impl TimeErrorCurve {
    /// Whether a run has a finite error.
    pub fn is_drawable(&self) -> bool {
        self.settings.iter().flatten().any(|(_, error)| error.is_finite())
    }

    /// The line through the medians; how many runs there are, and how many of them failed.
    fn line(&self) -> (LineSeries, usize, usize) {
        let mut line = LineSeries::named(&self.method);
        let (mut runs, mut failed) = (0, 0);
        for setting in &self.settings {
            let known = setting.iter().copied();
            let known = known.filter(|(cost, error)| cost.is_finite() && error.is_finite());
            let (costs, errors): (Vec<f64>, Vec<f64>) = known.unzip();
            runs += setting.len();
            failed += setting.len() - errors.len();
            match summarize(&costs) {
                Ok(cost) => line.push_median(cost.median, &errors),
                Err(_) => line.push_gap(),
            }
        }
        (line, runs, failed)
    }
}

/// One target.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TimeErrorPanel {
    /// The target's name.
    pub target: String,
    /// The methods.
    pub curves: Vec<TimeErrorCurve>,
    /// The error of independent draws of the same number.
    pub iid_level: Option<f64>,
}

impl TimeErrorPanel {
    /// The settings of a target's curve for a method; both begin where they are not yet among the panels.
    pub fn settings<'a>(panels: &'a mut Vec<Self>, target: &str, method: &str) -> &'a mut Vec<Vec<(f64, f64)>> {
        let panel = place(panels, |panel| panel.target == target);
        panels[panel].target = target.to_owned();
        let curves = &mut panels[panel].curves;
        let curve = place(curves, |curve| curve.method == method);
        curves[curve].method = method.to_owned();
        &mut curves[curve].settings
    }
}

/// The place of an entry, behind all others and empty if there is none yet.
fn place<T: Default>(entries: &mut Vec<T>, is_it: impl Fn(&T) -> bool) -> usize {
    entries.iter().position(is_it).unwrap_or_else(|| {
        entries.push(T::default());
        entries.len() - 1
    })
}

/// Median errors against median costs on logarithmic axes, one panel per target. Failed runs are left out of the medians and counted in a note below the figure.
pub fn time_error(x_label: &str, y_label: &str, panels: impl IntoIterator<Item = TimeErrorPanel>) -> MultiplesPlot {
    let mut failures = Vec::new();
    let mut drawn = Vec::new();
    for TimeErrorPanel {
        target,
        curves,
        iid_level,
    } in panels
    {
        let line = |curve: &TimeErrorCurve| {
            let (line, runs, failed) = curve.line();
            if failed > 0 {
                failures.push(format!("{} on {target} ({failed} of {runs})", curve.method));
            }
            line
        };
        let lines: Vec<LineSeries> = curves.iter().map(line).collect();
        drawn.push(MultiplesPanel::new(target, lines).with_level(iid_level, "independent draws"));
    }
    let mut plot = MultiplesPlot::logarithmic(x_label, y_label)
        .with_panels(drawn)
        .with_note("Medians over seeds; bars from the smallest to the largest error.");
    plot.look = Look::LowPoints;
    if !failures.is_empty() {
        plot.notes
            .push(format!("Runs without a finite error: {}.", failures.join(", ")));
    }
    plot
}
