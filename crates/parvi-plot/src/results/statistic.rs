//! What is said of rows, by name.

use super::{Row, Rows, Value};
use crate::page::{Cell, MISSING, exponent, percent};

impl Rows<'_> {
    /// A statistic as it stands in a table: `rows`, their number; a column by its name, that of the first row; of a column `first`, `text` (the first that there is, with all its digits),
    /// `each` (those of all rows), `median`, `median of all` (the rows without it infinitely large, ∞), `quantile 0.95`, `percent` (of a share, the mean), `least`, `largest`, `farthest` (the
    /// largest distance from zero), `worst` (the case with the largest), `middle` and `last` of those in order of size, as they stand (of an even number the larger in the middle); `fixed 4`, `signed 2` and `scientific 1`, the first with so many decimals; and `exponent of size in column`, of the power law through its medians.
    ///
    /// With ` where ` and a condition behind it, it is that of the rows that fulfil it: `outcome = converged`, `outcome ≠ converged`, `error ≤ 3`, `error > 3` (also where there is none), `size ≥ 64` (where a column may stand for the number: `error ≤ bound`), a
    /// column that has to hold something, or `no` and one that must not. `share where a where b` is the share of the rows that fulfil the last condition among those that fulfil the others, `part where a where b` is how many of how many: 3/7.
    pub fn cell(&self, statistic: &str) -> String {
        let Some((earlier, condition)) = statistic.rsplit_once(" where ") else {
            return self.plain(statistic);
        };
        let fulfil = |rows: &Self| rows.having(|row| fulfils(row, condition));
        let mut parts = earlier.split(" where ");
        let name = parts.next().unwrap_or_default();
        let here = parts.fold(self.clone(), |rows, part| rows.having(|row| fulfils(row, part)));
        match name {
            "share" => percent(fulfil(&here).len(), here.len()).cell(),
            "part" => (!here.is_empty())
                .then(|| format!("{}/{}", fulfil(&here).len(), here.len()))
                .cell(),
            name => fulfil(&here).plain(name),
        }
    }

    fn plain(&self, statistic: &str) -> String {
        let (name, column) = statistic.rsplit_once(' ').unwrap_or(("first", statistic));
        match name {
            "first" if column == "rows" => self.len().to_string(),
            "first" => self.first().map(|row| row.value(column)).cell(),
            "text" => self
                .having(|row| fulfils(row, column))
                .first()
                .map(|row| row.value(column).to_string())
                .cell(),
            "each" => {
                let texts: Vec<String> = self.iter().map(|row| row.value(column).cell()).collect();
                (!texts.is_empty()).then(|| texts.join(", ")).cell()
            }
            "median" => self.median(column).cell(),
            "median of all" => match self.median_of_all(column) {
                Some(f64::INFINITY) => "∞".to_owned(),
                median => median.cell(),
            },
            "middle" => self.in_order(column, |count| count / 2).cell(),
            "last" => self.in_order(column, |count| count.saturating_sub(1)).cell(),
            "percent" => (!self.is_empty())
                .then(|| format!("{:.1}", 100.0 * self.mean(column)))
                .cell(),
            "least" => self.least(column).cell(),
            "largest" => self.largest(column).cell(),
            "farthest" => self.farthest(column).cell(),
            "worst" => self.worst(column).map(|row| format!("`{}`", row.case())).cell(),
            name => match name.split(' ').collect::<Vec<_>>()[..] {
                [format, decimals] if FORMATS.contains(&format) => self.formatted(column, (format, decimals)).cell(),
                ["quantile", level] => level.parse().ok().and_then(|level| self.quantile(column, level)).cell(),
                ["exponent", "of", size, "in"] => exponent(self.curve("", size, column).points()),
                _ => MISSING.to_owned(),
            },
        }
    }

    /// The value at a place among those of a column in order of size.
    fn in_order(&self, column: &str, place: impl Fn(usize) -> usize) -> Option<&Value> {
        let known = self.iter().map(|row| row.value(column));
        let mut known: Vec<(f64, &Value)> = known.filter_map(|value| Some((value.number()?, value))).collect();
        known.sort_by(|left, right| left.0.total_cmp(&right.0));
        known.get(place(known.len())).map(|(_, value)| *value)
    }

    /// The number of the first row in one of the [`FORMATS`].
    fn formatted(&self, column: &str, (format, decimals): (&str, &str)) -> Option<String> {
        let (number, decimals) = (self.first()?.number(column)?, decimals.parse::<usize>().ok()?);
        Some(match format {
            "fixed" => format!("{number:.decimals$}"),
            "signed" => format!("{number:+.decimals$}"),
            _ => format!("{number:.decimals$e}"),
        })
    }
}

/// How a number can be written with so many decimals.
const FORMATS: [&str; 3] = ["fixed", "signed", "scientific"];

/// Whether a row fulfils a condition.
fn fulfils(row: &Row, condition: &str) -> bool {
    let bound = |text: &str| text.parse().ok().or_else(|| row.number(text)).unwrap_or(f64::NAN);
    match condition.splitn(3, ' ').collect::<Vec<_>>()[..] {
        [column] => *row.value(column) != Value::Empty,
        ["no", column] => *row.value(column) == Value::Empty,
        [column, "=", value] => row.value(column).to_string() == value,
        [column, "≠", value] => row.value(column).to_string() != value,
        [column, "≤", most] => row.is_within(column, bound(most)),
        [column, ">", most] => !row.is_within(column, bound(most)),
        [column, "≥", least] => row.number(column).is_some_and(|number| number >= bound(least)),
        _ => false,
    }
}
