//! Rows by their cases, and what is said of several of them.

use std::collections::HashMap;

use super::row::Row;
use super::{Case, Paper};
use crate::CommandError;
use crate::plots::page::{Cell, MISSING, Page, number};
use crate::statistics::weighted_quantile;
use crate::study::attempt::Status;
use crate::study::definition;

/// Two ED² are equal for the report if neither is more than so many times the other.
pub const TIE: f64 = 1.1;

/// A quantity of a run.
pub type Quantity = fn(&Row) -> Option<f64>;

/// A case and its row.
pub type Finding<'a> = (Case, &'a Row);

/// All rows by the names of their cases.
pub struct Findings<'a> {
    /// The study.
    pub study: &'a Paper,
    rows: HashMap<&'a str, &'a Row>,
}

impl<'a> Findings<'a> {
    /// Looks rows up.
    pub fn new(study: &'a Paper, rows: &'a [Row]) -> Self {
        let rows = rows.iter().map(|row| (row.case.as_str(), row)).collect();
        Self { study, rows }
    }

    /// Those of the cases that have rows.
    pub fn of(&self, cases: Vec<Case>) -> Vec<Finding<'a>> {
        let found = |case: Case| Some((self.rows.get(definition::Case::id(&case).as_str()).copied(), case));
        cases
            .into_iter()
            .filter_map(found)
            .filter_map(|(row, case)| Some((case, row?)))
            .collect()
    }

    /// The findings of a case of the configuration; none if it has no such case.
    pub fn sweep(&self, name: &str) -> Result<Vec<Finding<'a>>, CommandError> {
        let sweep = self
            .study
            .sweeps
            .iter()
            .find(|sweep| sweep.name.as_deref() == Some(name));
        Ok(self.of(sweep.map_or(Ok(Vec::new()), |sweep| self.study.cases_of(sweep))?))
    }
}

/// The median; a run without the quantity counts as infinitely far. `None` without runs.
pub fn median<'a>(rows: impl IntoIterator<Item = &'a Row>, quantity: Quantity) -> Option<f64> {
    let mut values: Vec<f64> = rows
        .into_iter()
        .map(|row| quantity(row).unwrap_or(f64::INFINITY))
        .collect();
    values.sort_by(f64::total_cmp);
    let middle = values.len().checked_sub(1)? / 2;
    let upper = values[values.len() / 2];
    Some(0.5 * (values[middle] + upper))
}

/// The median of those that have the quantity.
fn known_median(rows: &[&Row], quantity: Quantity) -> Option<f64> {
    let values: Vec<f64> = rows.iter().filter_map(|row| quantity(row)).collect();
    weighted_quantile(&values, None, &[0.5]).ok()?.first().copied()
}

/// A median for a table.
pub fn cell(value: Option<f64>) -> String {
    match value {
        None => MISSING.to_owned(),
        Some(value) if value.is_infinite() => "∞".to_owned(),
        Some(value) => number(value),
    }
}

/// The rows by what differs among their settings, target and seed apart, in the order of the cases.
pub fn groups<'a>(findings: &[Finding<'a>]) -> Vec<(String, Vec<&'a Row>)> {
    let parts: Vec<Vec<(&str, String)>> = findings.iter().map(|(case, _)| case.parts()).collect();
    // The methods are named even where there is only one.
    let named = ["algorithm", "variant", "method"];
    let differs = |index: &usize| {
        let named = parts
            .iter()
            .any(|part| part.get(*index).is_some_and(|(name, _)| named.contains(name)));
        named || parts.iter().any(|part| part.get(*index) != parts[0].get(*index))
    };
    let longest = parts.iter().map(Vec::len).max().unwrap_or(0);
    let chosen: Vec<usize> = (0..longest).filter(differs).collect();
    let mut groups: Vec<(String, Vec<&Row>)> = Vec::new();
    for ((_, row), part) in findings.iter().zip(&parts) {
        let text = |index: &usize| match part.get(*index)? {
            (name, text) if ["variant", "material", "method"].contains(name) => Some(text.clone()),
            (name, text) => Some(format!("{name} {text}")),
        };
        let label = chosen.iter().filter_map(text).collect::<Vec<_>>().join(", ");
        match groups.iter_mut().find(|(known, _)| *known == label) {
            Some((_, rows)) => rows.push(row),
            None => groups.push((label, vec![row])),
        }
    }
    groups
}

/// A line per setting, over targets and seeds.
pub fn settings(findings: &[Finding], page: &mut Page) {
    let line = |(label, rows): &(String, Vec<&Row>)| {
        let all = || rows.iter().copied();
        let ended = all().filter(|row| row.status == Status::Finished).count();
        let good = all()
            .filter(|row| row.ratio().is_some_and(|ratio| ratio <= 1.0))
            .count();
        // Rivals are not looked at on their way.
        let seen = all().any(|row| !row.variant.is_empty());
        let on_the_way = if seen {
            cell(median(all(), Row::best_ratio))
        } else {
            MISSING.to_owned()
        };
        let least = all().filter_map(Row::ratio).min_by(f64::total_cmp);
        let mut line = vec![
            label.clone(),
            format!("{ended}/{}", rows.len()),
            cell(median(all(), Row::ratio)),
        ];
        line.extend([least.cell(), on_the_way, good.to_string()]);
        let ends: [Quantity; 3] = [|row| row.final_sliced, |row| row.final_mean, |row| row.final_deviation];
        line.extend(ends.map(|quantity| cell(median(all(), quantity))));
        let costs: [Quantity; 2] = [|row| row.evaluations.map(|count| count as f64), |row| row.wall_seconds];
        line.extend(costs.map(|quantity| known_median(rows, quantity).cell()));
        line
    };
    let header = "setting | ended | ED² | least | on the way | ≤ 1 | sliced W2 | mean | sd | evaluations | time (s)";
    page.table(header, groups(findings).iter().map(line));
}

/// How many runs are better than, as good as and worse than their counterparts, and of how many pairs both gave nothing; a run without particles is worse than any other.
pub fn against<'a>(pairs: impl IntoIterator<Item = (&'a Row, &'a Row)>) -> [usize; 4] {
    let mut counts = [0; 4];
    for (row, other) in pairs {
        let place = match (row.ratio(), other.ratio()) {
            (None, None) => 3,
            (None, Some(_)) => 2,
            (Some(_), None) => 0,
            (Some(own), Some(theirs)) if own * TIE < theirs => 0,
            (Some(own), Some(theirs)) if own <= theirs * TIE => 1,
            (Some(_), Some(_)) => 2,
        };
        counts[place] += 1;
    }
    counts
}
