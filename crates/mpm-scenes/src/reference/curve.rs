//! One quantity over time: interpolation, a root mean square difference, the first zero crossing.

/// A quantity at increasing times.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Curve {
    /// t_k, increasing.
    pub times: Vec<f64>,
    /// y_k, as many.
    pub values: Vec<f64>,
}

impl Curve {
    /// The curve of the rows t, y of a text, behind its first line.
    pub fn parse(text: &str) -> Self {
        Self::of_rows(text, |numbers| match numbers {
            [value] => Some(*value),
            _ => None,
        })
    }

    /// The curve of what the numbers behind t say of y, in the rows of a text behind its first line.
    pub fn of_rows(text: &str, value: impl Fn(&[f64]) -> Option<f64>) -> Self {
        let mut curve = Self::default();
        for line in text.lines().skip(1) {
            let numbers = line.split(',').map(|number| number.trim().parse().ok());
            let numbers: Option<Vec<f64>> = numbers.collect();
            if let Some((time, rest)) = numbers.as_deref().and_then(<[f64]>::split_first)
                && let Some(value) = value(rest)
            {
                curve.push(*time, value);
            }
        }
        curve
    }

    /// The first value; NaN without any.
    pub fn first(&self) -> f64 {
        self.values.first().copied().unwrap_or(f64::NAN)
    }

    /// The last value; NaN without any.
    pub fn last(&self) -> f64 {
        self.values.last().copied().unwrap_or(f64::NAN)
    }

    /// y + z, for another quantity at the same times.
    pub fn plus(mut self, other: &Self) -> Self {
        self.values.iter_mut().zip(&other.values).for_each(|(y, z)| *y += z);
        self
    }

    /// Append y at time t.
    pub fn push(&mut self, time: f64, value: f64) {
        self.times.push(time);
        self.values.push(value);
    }

    /// The pairs (t_k, y_k).
    pub fn points(&self) -> impl Iterator<Item = (f64, f64)> {
        self.times.iter().copied().zip(self.values.iter().copied())
    }

    /// Its points, or every second, third, …, so that there are no more than `most`.
    pub fn thinned(&self, most: usize) -> impl Iterator<Item = (f64, f64)> {
        let every = self.times.len().div_ceil(most).max(1);
        self.points().step_by(every)
    }

    /// y(t) by linear interpolation; `None` outside the times there are.
    pub fn at(&self, time: f64) -> Option<f64> {
        let after = self.times.partition_point(|&t| t < time);
        let (t1, y1) = (*self.times.get(after)?, *self.values.get(after)?);
        if t1 == time {
            return Some(y1);
        }
        let (t0, y0) = (*self.times.get(after.checked_sub(1)?)?, *self.values.get(after - 1)?);
        Some(y0 + (y1 - y0) * (time - t0) / (t1 - t0))
    }

    /// √(mean over k of (y_k − f(t_k))²) over the times up to `end`; NaN without any.
    pub fn rms_difference(&self, end: f64, f: impl Fn(f64) -> f64) -> f64 {
        let squares = self
            .points()
            .filter(|&(t, _)| t <= end)
            .map(|(t, y)| (y - f(t)).powi(2));
        let (count, sum) = squares.fold((0u32, 0.0), |(count, sum), square| (count + 1, sum + square));
        (sum / f64::from(count)).sqrt()
    }

    /// max_k |y_k|; 0 without any.
    pub fn peak(&self) -> f64 {
        self.values.iter().fold(0.0, |peak: f64, y| peak.max(y.abs()))
    }

    /// The times at which y passes `level`, by linear interpolation.
    pub fn crossings(&self, level: f64) -> Vec<f64> {
        let points: Vec<_> = self.points().collect();
        let pairs = points.windows(2).filter_map(|pair| match *pair {
            [(t0, y0), (t1, y1)] if (y0 < level) != (y1 < level) => Some(t0 + (t1 - t0) * (level - y0) / (y1 - y0)),
            _ => None,
        });
        pairs.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::Curve;

    fn sine() -> Curve {
        let mut series = Curve::default();
        for k in 0..=1000 {
            let t = 0.01 * f64::from(k);
            series.push(t, (2.0 * t).sin());
        }
        series
    }

    #[test]
    fn a_thinned_series_has_no_more_points_than_asked_for() {
        let thinned: Vec<_> = sine().thinned(400).collect();
        assert!(
            thinned.len() == 334 && thinned[1].0 == sine().times[3],
            "{}",
            thinned.len()
        );
        assert_eq!(sine().thinned(2000).count(), 1001);
        assert_eq!(Curve::default().thinned(2).count(), 0);
    }

    #[test]
    fn a_series_is_interpolated_within_its_times_only() {
        let series = sine();
        assert!((series.at(0.515).expect("inside") - 1.03f64.sin()).abs() < 1e-4);
        assert_eq!(series.at(0.0), Some(0.0));
        assert_eq!(series.at(-0.1), None);
        assert_eq!(series.at(10.1), None);
    }

    #[test]
    fn the_difference_to_zero_over_periods_is_the_amplitude_over_root_two() {
        let periods = 3.0 * std::f64::consts::PI;
        assert!((sine().rms_difference(periods, |_| 0.0) - 0.5f64.sqrt()).abs() < 1e-3);
        assert!(sine().rms_difference(-1.0, |_| 0.0).is_nan());
    }

    #[test]
    fn a_sine_crosses_zero_every_half_period() {
        let crossings = sine().crossings(0.0);
        assert_eq!(crossings.len(), 6);
        for (k, t) in crossings.iter().enumerate() {
            let expected = (k as f64 + 1.0) * std::f64::consts::FRAC_PI_2;
            assert!((t - expected).abs() < 1e-4, "{t}");
        }
    }
}
