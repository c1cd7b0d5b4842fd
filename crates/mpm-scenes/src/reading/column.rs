//! Numbers of the columns of a series.

use serde::Deserialize;

use crate::Series;
use crate::reference::curve::Curve;

/// What of a column.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Take {
    /// Its last value.
    #[default]
    Last,
    /// Its largest value.
    Largest,
    /// Its least value.
    Least,
    /// Its last value minus the first.
    Change,
    /// The root mean square difference to the other run's over time, over the largest change of the other run's from its start.
    Difference,
    /// The largest difference to the other run's, over the same.
    LargestDifference,
}

impl Take {
    /// Whether it needs another run.
    pub fn compares(self) -> bool {
        matches!(self, Self::Difference | Self::LargestDifference)
    }

    /// The number; NaN without rows, or where the other run has no column.
    pub fn of(self, own: &Curve, other: Option<&Curve>) -> f64 {
        let values = || own.values.iter().copied();
        let value = match self {
            Self::Last => values().last(),
            Self::Largest => values().reduce(f64::max),
            Self::Least => values().reduce(f64::min),
            Self::Change => values().next().zip(values().last()).map(|(first, last)| last - first),
            Self::Difference => other.map(|other| {
                let there = |t: f64| other.at(t).unwrap_or(f64::NAN);
                own.rms_difference(other.times.last().copied().unwrap_or(f64::NAN), there) / largest_change(other)
            }),
            Self::LargestDifference => other.map(|other| {
                let pairs = own.points().filter_map(|(t, y)| Some((y, other.at(t)?)));
                let largest = pairs.map(|(y, there)| (y - there).abs()).reduce(f64::max);
                largest.unwrap_or(f64::NAN) / largest_change(other)
            }),
        };
        value.unwrap_or(f64::NAN)
    }
}

/// max_k |y_k − y_0|.
fn largest_change(curve: &Curve) -> f64 {
    curve
        .values
        .iter()
        .map(|y| (y - curve.first()).abs())
        .fold(0.0, f64::max)
}

/// A column over time, or the sum of several: `kinetic_energy + strain_energy`; an error says which there is none of, and which there are.
pub fn curve(series: &Series, columns: &str) -> Result<Curve, String> {
    let mut sum = Curve {
        times: series.column("time").unwrap_or_default(),
        values: vec![0.0; series.rows().len()],
    };
    for name in columns.split(" + ") {
        let missing = || format!("`{name}` is none of `{}`", series.columns().join("`, `"));
        let column = series.column(name).ok_or_else(missing)?;
        for (sum, value) in sum.values.iter_mut().zip(column) {
            *sum += value;
        }
    }
    Ok(sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(slope: f64) -> Curve {
        let mut curve = Curve::default();
        (0..=4).for_each(|k| curve.push(f64::from(k), 1.0 + slope * f64::from(k)));
        curve
    }

    #[test]
    fn differences_are_relative_to_the_change_of_the_other() {
        let (own, other) = (line(1.5), line(1.0));
        // 0.5 t beside a change of 4: largest 2, mean square 0.25 · (0 + 1 + 4 + 9 + 16) / 5.
        assert_eq!(Take::LargestDifference.of(&own, Some(&other)), 0.5);
        assert!((Take::Difference.of(&own, Some(&other)) - 1.5f64.sqrt() / 4.0).abs() < 1e-15);
        assert!(Take::Difference.of(&own, None).is_nan());
        assert_eq!(Take::Change.of(&own, None), 6.0);
    }

    #[test]
    fn only_common_times_are_compared() {
        let mut longer = line(1.0);
        longer.push(5.0, 100.0);
        assert_eq!(Take::LargestDifference.of(&longer, Some(&line(1.0))), 0.0);
        assert_eq!(Take::Difference.of(&longer, Some(&line(1.0))), 0.0);
    }

    #[test]
    fn columns_are_added() {
        let mut series = Series::new(["time", "a", "b"].map(str::to_owned).to_vec());
        series.push(vec![0.5, 1.0, 10.0]);
        assert_eq!(curve(&series, "a + b").unwrap().values, [11.0]);
        assert_eq!(curve(&series, "a + c").unwrap_err(), "`c` is none of `time`, `a`, `b`");
    }
}
