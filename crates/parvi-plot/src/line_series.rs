//! Lines as figures take them: measured ones, and theoretical ones beside them.

use super::statistics::summarize;

/// A labelled sequence of points.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LineSeries {
    /// The text in the legend.
    pub label: String,
    /// The abscissas, in the order in which points are connected.
    pub x: Vec<f64>,
    /// The ordinates; a value that is not finite interrupts the line.
    pub y: Vec<f64>,
    /// The lower and upper ends of error bars, one pair per point, or empty.
    pub bars: Vec<(f64, f64)>,
}

impl LineSeries {
    /// A line without points yet.
    pub fn named(label: impl Into<String>) -> Self {
        Self {
            label: label.into(),
            ..Self::default()
        }
    }

    /// A line through points (x, y).
    pub fn through(label: impl Into<String>, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let (x, y) = points.into_iter().unzip();
        Self {
            x,
            y,
            ..Self::named(label)
        }
    }

    /// The values in order of size against the share of all that are no larger, in percent; `all` may be more than have a value.
    pub fn in_order(label: impl Into<String>, mut values: Vec<f64>, all: usize) -> Self {
        values.sort_by(f64::total_cmp);
        let place = |k: usize| 100.0 * (k as f64 + 0.5) / all as f64;
        Self::through(
            label,
            values.into_iter().enumerate().map(|(k, value)| (place(k), value)),
        )
    }

    /// The points (x, y).
    pub fn points(&self) -> impl Iterator<Item = (f64, f64)> {
        self.x.iter().copied().zip(self.y.iter().copied())
    }

    /// Adds the median of the values, with a bar from the least to the largest; nothing where there are none.
    pub fn push_median(&mut self, x: f64, values: &[f64]) {
        if let Ok(summary) = summarize(values) {
            self.x.push(x);
            self.y.push(summary.median);
            self.bars.push((summary.minimum, summary.maximum));
        }
    }

    /// Interrupts the line.
    pub fn push_gap(&mut self) {
        self.x.push(f64::NAN);
        self.y.push(f64::NAN);
        self.bars.push((f64::NAN, f64::NAN));
    }

    /// Adds the mean of the values, with a bar from the least to the largest; a value that is not finite interrupts the line.
    pub fn push_mean(&mut self, x: f64, values: &[f64]) {
        let least = values.iter().copied().fold(f64::INFINITY, f64::min);
        let largest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        self.x.push(x);
        self.y.push(values.iter().sum::<f64>() / values.len() as f64);
        self.bars.push((least, largest));
    }
}

/// A theoretical curve for comparison.
#[derive(Debug, Clone, PartialEq)]
pub struct GuideCurve {
    /// The curve; guides with the same text in the legend share an entry.
    pub line: LineSeries,
    /// Whether it is dotted; else dashed.
    pub dotted: bool,
}

impl GuideCurve {
    /// The values at some places.
    fn at(label: impl Into<String>, x: Vec<f64>, dotted: bool, value: impl Fn(f64) -> f64) -> Self {
        let line = LineSeries::through(label, x.into_iter().map(|x| (x, value(x))));
        Self { line, dotted }
    }

    /// A dashed curve through places between two ends, each as many times the one before.
    pub fn bent(label: impl Into<String>, (low, high): (f64, f64), value: impl Fn(f64) -> f64) -> Self {
        let place = |i: i32| low * (high / low).powf(f64::from(i) / 20.0);
        Self::at(label, (0..=20).map(place).collect(), false, value)
    }

    /// The power of x through the first point of a line, as far as its last one or as it stays below `most`.
    pub(super) fn power(label: String, line: &LineSeries, power: i32, most: f64) -> Option<Self> {
        let (first, value) = line.points().next()?;
        let reach = first * (most / value).powf(1.0 / f64::from(power));
        let last = reach.min(*line.x.last()?);
        Some(Self::bent(label, (first, last), |x| value * (x / first).powi(power)))
    }

    /// The line between the values at two ends.
    pub fn through(
        label: impl Into<String>,
        (low, high): (f64, f64),
        dotted: bool,
        value: impl Fn(f64) -> f64,
    ) -> Self {
        Self::at(label, vec![low, high], dotted, value)
    }
}
