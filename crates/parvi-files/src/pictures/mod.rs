//! Pictures of one run: marginals, pairs of coordinates, the history of its quantities and of the cloud.

mod history;
mod known;
mod quadrature;
pub mod trace_panels;
#[cfg(feature = "mesh")]
mod within;
#[cfg(not(feature = "mesh"))]
#[path = "within_left_out.rs"]
mod within;

use parvi_plot::page::counted;
use parvi_plot::{
    AxisKind, DensityPlot, LineSeries, MultiplesPanel, MultiplesPlot, PlotError, PointCloud, StripPanel, StripPlot,
    corner, histogram, multiples, strip,
};

pub use self::history::{History, Moment};
pub use self::known::{Known, contours, look};
pub use self::quadrature::Densities;
use crate::outcome::{Outcome, SurveyPoint, Watched};
use crate::{AtomicFile, FileError, OutputDirectory, Particles};

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
    /// The target, as titles call it.
    pub target: &'a str,
    /// The coordinates, as axes call them.
    pub coordinates: &'a [String],
    /// What is known of the target.
    pub known: &'a Known,
    /// The method's name.
    pub method: &'a str,
    /// What the run gave.
    pub outcome: &'a Outcome,
    /// The cloud on its way.
    pub history: &'a History,
    /// Why the run has no trace, if it was not to have one.
    pub untraced: Option<&'a str>,
    /// Told what is not drawn, and why.
    pub notice: fn(&str),
}

impl Subject<'_> {
    /// Draws into a directory and returns the names of the files. What cannot be drawn is told, and a file of its name is removed.
    ///
    /// # Errors
    /// Files that cannot be written.
    pub fn draw(&self, directory: &OutputDirectory) -> Result<Vec<&'static str>, FileError> {
        if let Known::Nothing(reason) = self.known {
            (self.notice)(&format!("no exact marginals and no contours: {reason}"));
        }
        let dimension = self.outcome.particles.dimension();
        let drawings = [
            (HISTOGRAM, Some(self.histogram())),
            (CORNER, (dimension > 1).then(|| self.corner())),
            (SURVEY, self.survey()),
            (TRACE, self.trace()),
            (STRIP, if dimension == 2 { self.strip() } else { None }),
        ];
        let mut written = Vec::new();
        for (name, drawing) in drawings {
            match drawing {
                Some(Ok(svg)) => {
                    AtomicFile::write(directory.file(name), svg)?;
                    written.push(name);
                    continue;
                }
                Some(Err(error)) => (self.notice)(&format!("{name} was not drawn: {error}")),
                None => {}
            }
            directory.remove(name)?;
        }
        Ok(written)
    }

    fn title(&self) -> String {
        let (target, count) = (self.target, self.outcome.particles.len());
        format!("{target}: {} of {}", counted(count, "particles"), self.method)
    }

    fn histogram(&self) -> Result<String, PlotError> {
        self.beside(usize::MAX).draw(histogram)
    }

    fn corner(&self) -> Result<String, PlotError> {
        let dimension = self.outcome.particles.dimension();
        let shown = dimension.min(CORNER_COORDINATES);
        if shown < dimension {
            (self.notice)(&format!("{CORNER} shows the first {shown} of {dimension} coordinates"));
        }
        self.beside(shown).draw(corner)
    }

    /// The particles beside what is known, of the first coordinates.
    fn beside(&self, shown: usize) -> Beside<'_> {
        Beside {
            title: self.title(),
            shown,
            ..Beside::new(
                self.coordinates,
                &self.outcome.particles,
                self.known,
                self.known.label(),
            )
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
            (self.notice)(&format!("no {TRACE}: {reason}"));
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
    fn strip(&self) -> Option<Result<String, PlotError>> {
        let moments = self.history.selected(MOMENTS - 1);
        if moments.is_empty() {
            (self.notice)(&format!("no {STRIP}: no particles have moved in this process"));
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
            labels: self.coordinates,
            reference: self.known.reference(self.known.draws()),
            reference_label: self.known.label(),
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
    /// The coordinates, as axes call them.
    coordinates: &'a [String],
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
    pub fn new(coordinates: &'a [String], particles: &'a Particles, known: &'a Known, label: &'a str) -> Self {
        Self {
            title: String::new(),
            coordinates,
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
        let labels = &self.coordinates[..self.coordinates.len().min(self.shown)];
        figure(&DensityPlot {
            title: &self.title,
            particles: PointCloud::weighted(&points, self.particles.weights()),
            labels,
            reference: self.known.reference(&draws),
            reference_label: self.label,
        })
    }
}
