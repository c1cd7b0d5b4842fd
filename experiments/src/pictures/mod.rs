//! Pictures of one run: marginals, pairs of coordinates, the history of its quantities and of the cloud.

mod history;
mod known;
pub mod trace_panels;
#[cfg(feature = "mesh")]
mod within;
#[cfg(not(feature = "mesh"))]
#[path = "within_left_out.rs"]
mod within;

use std::path::Path;

pub use self::history::History;
use self::known::look;
pub use self::known::{Known, contours};
use crate::dispatch::on_target;
use crate::options::TargetSpecification;
use crate::output::{AtomicFile, OutputDirectory, Particles};
use crate::plots::{
    AxisKind, DensityPlot, LineSeries, MultiplesPanel, MultiplesPlot, PlotError, PointCloud, StripPanel, StripPlot,
    corner, histogram, multiples, strip,
};
use crate::sampling::{Outcome, SurveyPoint, Watched};
use crate::{CommandError, console};

/// The file of the marginals.
pub const HISTOGRAM: &str = "histogram.svg";
/// The file of the pairs of coordinates.
pub const CORNER: &str = "corner.svg";
/// The file of the quantities' history.
pub const TRACE: &str = "trace.svg";
/// The file of the survey's history.
pub const SURVEY: &str = "survey.svg";
/// The file of the cloud's history.
pub const STRIP: &str = "strip.svg";

/// Coordinates of a corner plot, at most.
const CORNER_COORDINATES: usize = 6;
/// Panels of the strip.
const MOMENTS: usize = 6;

/// What the pictures are of.
pub struct Subject<'a> {
    /// The target.
    pub target: &'a TargetSpecification,
    /// The file of the mesh that the density is kept to.
    pub mesh: Option<&'a Path>,
    /// The method's name.
    pub method: &'a str,
    /// What the run gave.
    pub outcome: &'a Outcome,
    /// The cloud on its way.
    pub history: &'a History,
    /// Why the run has no trace, if it was not to have one.
    pub untraced: Option<&'a str>,
}

impl Subject<'_> {
    /// Draws into a directory and returns the names of the files. What cannot be drawn is said on standard error, and a file of its name is removed.
    ///
    /// # Errors
    /// What the target refuses, and files that cannot be written.
    pub fn draw(&self, directory: &OutputDirectory) -> Result<Vec<&'static str>, CommandError> {
        let known = on_target!(self.target, target, D => Ok(look::<D>(target.as_ref(), self.mesh)))?;
        let known = known.or_pool(self.outcome.pool.as_ref());
        if let Known::Nothing(reason) = &known {
            console::notice(&format!("--plots: no exact marginals and no contours: {reason}"));
        }
        let dimension = self.outcome.particles.dimension();
        let drawings = [
            (HISTOGRAM, Some(self.histogram(&known))),
            (CORNER, (dimension > 1).then(|| self.corner(&known))),
            (SURVEY, self.survey()),
            (TRACE, self.trace()),
            (STRIP, if dimension == 2 { self.strip(&known) } else { None }),
        ];
        let mut written = Vec::new();
        for (name, drawing) in drawings {
            match drawing {
                Some(Ok(svg)) => {
                    AtomicFile::write(directory.file(name), svg)?;
                    written.push(name);
                    continue;
                }
                Some(Err(error)) => console::notice(&format!("--plots: {name} was not drawn: {error}")),
                None => {}
            }
            directory.remove(name)?;
        }
        Ok(written)
    }

    fn title(&self) -> String {
        let (target, count) = (self.target.label(), self.outcome.particles.len());
        format!("{target}: {count} particles of {}", self.method)
    }

    fn histogram(&self, known: &Known) -> Result<String, PlotError> {
        self.beside(known, usize::MAX).draw(histogram)
    }

    fn corner(&self, known: &Known) -> Result<String, PlotError> {
        let dimension = self.outcome.particles.dimension();
        let shown = dimension.min(CORNER_COORDINATES);
        if shown < dimension {
            let text = format!("--plots: {CORNER} shows the first {shown} of {dimension} coordinates");
            console::notice(&text);
        }
        self.beside(known, shown).draw(corner)
    }

    /// The particles beside what is known, of the first coordinates.
    fn beside<'a>(&'a self, known: &'a Known, shown: usize) -> Beside<'a> {
        Beside {
            title: self.title(),
            shown,
            ..Beside::new(self.target, &self.outcome.particles, known, known.label())
        }
    }

    /// The survey by rounds; none without one.
    fn survey(&self) -> Option<Result<String, PlotError>> {
        let survey = &self.outcome.survey;
        let over_evaluations = |y_label: &str, y_axis, value: fn(&SurveyPoint) -> f64| {
            let points = survey.iter().map(|point| (point.evaluations as f64, value(point)));
            MultiplesPanel::over(y_label, y_axis, [LineSeries::through("survey", points)])
        };
        let panels = [
            over_evaluations("effective size of the pool", AxisKind::Logarithmic, |point| {
                point.effective_size
            }),
            over_evaluations("effective share of the round", AxisKind::Linear, |point| point.share),
        ];
        let plot = MultiplesPlot::traces(self.title(), "evaluations", panels);
        (!survey.is_empty()).then(|| multiples(&plot))
    }

    /// None without a trace, which is said.
    fn trace(&self) -> Option<Result<String, PlotError>> {
        if self.outcome.trace.is_empty() {
            let reason = self.untraced.unwrap_or("the run has no trace of steps");
            console::notice(&format!("--plots: no {TRACE}: {reason}"));
            return None;
        }
        let watched = self.outcome.watched.as_ref().map(|seen| self.watched(seen));
        let runs = [(self.method.to_owned(), self.outcome.trace.clone())];
        let mut panels: Vec<_> = trace_panels::panels(trace_panels::ALL, &runs).into();
        panels.extend(watched);
        // A quantity that the method does not have is zero or not there.
        let holds = |panel: &MultiplesPanel| {
            let mut values = panel.series.iter().flat_map(|series| &series.y);
            values.any(|&value| value != 0.0)
        };
        panels.retain(holds);
        // Of several rounds it is that of the one whose particles were returned.
        let several = self.history.rounds > 1;
        let x_label = if several { "step of the round returned" } else { "step" };
        Some(multiples(&MultiplesPlot::traces(self.title(), x_label, panels)))
    }

    /// What the monitor said.
    fn watched(&self, seen: &Watched) -> MultiplesPanel {
        let looks = seen.history.iter().map(|look| (look.0 as f64, look.1));
        let y_label = format!("monitor, least after step {}", seen.best_step);
        MultiplesPanel::over(y_label, AxisKind::Linear, [LineSeries::through(self.method, looks)])
    }

    /// None where nothing has moved, which is said.
    fn strip(&self, known: &Known) -> Option<Result<String, PlotError>> {
        let moments = self.history.selected(MOMENTS - 1);
        if moments.is_empty() {
            console::notice(&format!("--plots: no {STRIP}: no particles have moved in this process"));
            return None;
        }
        let titles: Vec<String> = moments.iter().map(|moment| format!("step {}", moment.step)).collect();
        let returned = self.outcome.particles.to_rows();
        let (title, particles) = ("returned", self.weighted(&returned));
        let clouds = moments.iter().map(|moment| PointCloud::equal(&moment.points));
        let panels = titles.iter().zip(clouds);
        let panels = panels.map(|(title, particles)| StripPanel { title, particles });
        let panels: Vec<StripPanel<'_>> = panels.chain([StripPanel { title, particles }]).collect();
        Some(strip(&StripPlot {
            title: &self.title(),
            panels: &panels,
            labels: &self.target.coordinate_names(),
            reference: known.reference(known.draws()),
            reference_label: known.label(),
        }))
    }

    /// Points with the weights of the particles.
    fn weighted<'a>(&'a self, points: &'a [Vec<f64>]) -> PointCloud<'a> {
        PointCloud::weighted(points, self.outcome.particles.weights())
    }
}

/// Particles beside what is known of their target.
pub struct Beside<'a> {
    /// The title; empty for none.
    title: String,
    /// The target.
    target: &'a TargetSpecification,
    /// The particles.
    particles: &'a Particles,
    /// What is known.
    known: &'a Known,
    /// The text in the legend for it; empty for "target".
    label: &'a str,
    /// The first coordinates that are shown, at most.
    shown: usize,
}

impl<'a> Beside<'a> {
    /// All coordinates, without a title.
    pub fn new(target: &'a TargetSpecification, particles: &'a Particles, known: &'a Known, label: &'a str) -> Self {
        Self {
            title: String::new(),
            target,
            particles,
            known,
            label,
            shown: usize::MAX,
        }
    }

    /// The figure of all that.
    ///
    /// # Errors
    /// What cannot be drawn.
    pub fn draw(&self, figure: fn(&DensityPlot<'_>) -> Result<String, PlotError>) -> Result<String, PlotError> {
        let cut = |mut rows: Vec<Vec<f64>>| {
            rows.iter_mut().for_each(|row| row.truncate(self.shown));
            rows
        };
        let points = cut(self.particles.to_rows());
        let draws = cut(self.known.draws().to_vec());
        let mut labels = self.target.coordinate_names();
        labels.truncate(self.shown);
        figure(&DensityPlot {
            title: &self.title,
            particles: PointCloud::weighted(&points, self.particles.weights()),
            labels: &labels,
            reference: self.known.reference(&draws),
            reference_label: self.label,
        })
    }
}
