//! Rows of one label, ordered for figures and judgements.

use crate::results::{Row, Rows};

/// The rows of one label.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeasuredSeries {
    /// The label.
    pub label: String,
    /// One point for each x, by x.
    pub points: Vec<Point>,
    /// The x of the runs that ended before their time; not a number where it is not known.
    pub failed: Vec<f64>,
}

/// What counts at one x: of several rows the one with the largest value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// x.
    pub x: f64,
    /// The value.
    pub value: f64,
    /// What the rows compare it with.
    pub reference: Option<f64>,
    /// How far from the reference it may be.
    pub tolerance: Option<f64>,
}

impl MeasuredSeries {
    /// A series without points.
    pub fn named(label: &str) -> Self {
        Self {
            label: label.to_owned(),
            ..Self::default()
        }
    }

    /// (x, value) of all points.
    pub fn pairs(&self) -> Vec<(f64, f64)> {
        self.points.iter().map(|point| (point.x, point.value)).collect()
    }

    /// The same with a value that is not finite at the x of runs that ended before their time, where no other has one.
    pub fn pairs_with_gaps(&self) -> Vec<(f64, f64)> {
        let mut pairs = self.pairs();
        for &x in &self.failed {
            if pairs.iter().all(|pair| pair.0 != x) {
                pairs.push((x, f64::NAN));
            }
        }
        pairs.sort_by(|left, right| left.0.total_cmp(&right.0));
        pairs
    }

    /// The label, or a word for the only one.
    pub fn name(&self) -> String {
        match self.label.as_str() {
            "" => "all".to_owned(),
            label => label.to_owned(),
        }
    }

    /// Whether the series is one of those named: all of them with an empty list, else those whose label, or a part of it, is in it.
    pub fn is_among(&self, names: &[String]) -> bool {
        let mut parts = self.label.split(", ").chain([self.label.as_str()]);
        names.is_empty() || parts.any(|part| names.iter().any(|name| name == part))
    }

    /// The series of rows by their `label`, in the order in which these come first: points are in `x` and `value`, beside `reference` and `tolerance`; a row without a value is
    /// a run that ended before its time.
    pub fn of(rows: &Rows<'_>) -> Vec<Self> {
        let of = |(label, here): (String, Rows<'_>)| {
            let mut series = Self::named(&label);
            here.iter().for_each(|row| add(&mut series, row));
            series.points.sort_by(|left, right| left.x.total_cmp(&right.x));
            series
        };
        rows.by("label").into_iter().map(of).collect()
    }
}

fn add(series: &mut MeasuredSeries, row: &Row) {
    let Some((x, value)) = row.number("x").zip(row.number("value")) else {
        series.failed.push(row.number("x").unwrap_or(f64::NAN));
        return;
    };
    let point = Point {
        x,
        value,
        reference: row.number("reference"),
        tolerance: row.number("tolerance"),
    };
    match series.points.iter_mut().find(|known| known.x == x) {
        Some(known) if known.value < value => *known = point,
        Some(_) => {}
        None => series.points.push(point),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(label: &str, x: f64, value: Option<f64>) -> Row {
        Row::default().with("label", label).with("x", x).with("value", value)
    }

    #[test]
    fn the_largest_of_one_x_counts() {
        let rows = [
            row("a, b", 2.0, Some(1.0)),
            row("a, b", 1.0, Some(5.0)),
            row("a, b", 1.0, Some(7.0)),
            row("c", 1.0, None),
            row("a, b", 1.5, None),
            row("a, b", 2.0, None),
        ];
        let rows: Rows<'_> = rows.iter().collect();
        let all = MeasuredSeries::of(&rows);
        assert_eq!(all[0].pairs(), [(1.0, 7.0), (2.0, 1.0)]);
        let gaps = all[0].pairs_with_gaps();
        assert!(gaps.len() == 3 && gaps[1].0 == 1.5 && gaps[1].1.is_nan(), "{gaps:?}");
        assert_eq!((all[1].points.len(), all[1].failed.as_slice()), (0, [1.0].as_slice()));
        let among = |names: &[&str]| all[0].is_among(&names.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>());
        assert!(among(&[]) && among(&["b"]) && among(&["a, b"]) && !among(&["c"]));
        assert!(MeasuredSeries::of(&Rows::default()).is_empty());
    }
}
