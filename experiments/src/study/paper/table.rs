//! Rows by their cases, and what is said of several of them.

use std::collections::HashMap;

use super::body::{PARTS, is_rival, part};
use super::{Paper, Setting};
use crate::study::prelude::*;

/// Two ED² are equal for the report if neither is more than so many times the other.
pub const TIE: f64 = 1.1;

/// ED² at the end, relative to independent draws.
pub const RATIO: &str = "final_ratio";

/// Whether a run is at least as good as independent draws.
pub fn is_good(row: &Row) -> bool {
    row.is_within(RATIO, 1.0)
}

/// All rows by the names of their cases.
pub struct Findings<'a> {
    /// The study.
    pub study: &'a Paper,
    rows: HashMap<&'a str, &'a Row>,
}

impl<'a> Findings<'a> {
    /// Looks rows up.
    pub fn new(study: &'a Paper, rows: &Rows<'a>) -> Self {
        let rows = rows.iter().map(|row| (row.case(), row)).collect();
        Self { study, rows }
    }

    /// Those of the cases that have rows.
    pub fn of(&self, cases: Vec<Setting>) -> Rows<'a> {
        let found = |case: &Setting| self.rows.get(case.id().as_str()).copied();
        cases.iter().filter_map(found).collect()
    }

    /// The base.
    pub fn base(&self) -> Result<Rows<'a>, CommandError> {
        Ok(self.of(self.study.base_cases()?))
    }

    /// The rivals.
    pub fn rivals(&self) -> Result<Rows<'a>, CommandError> {
        Ok(self.of(self.study.rival_cases()?))
    }

    /// The rows of a case of the configuration; none if it has no such case.
    pub fn sweep(&self, name: &str) -> Result<Rows<'a>, CommandError> {
        let mut sweeps = self.study.sweeps.iter();
        let sweep = sweeps.find(|sweep| sweep.name.as_deref() == Some(name));
        Ok(self.of(sweep.map_or(Ok(Vec::new()), |sweep| self.study.cases_of(sweep))?))
    }
}

/// The rows by what differs among their settings, target and seed apart, in the order of the cases.
pub fn groups<'a>(rows: &Rows<'a>) -> Vec<(String, Rows<'a>)> {
    let of_rivals = rows.first().is_some_and(is_rival);
    // The methods are named even where there is only one.
    let is_told = |(column, _): &(&str, &str)| match *column {
        "method" => true,
        "variant" => !of_rivals,
        "particles" => rows.words("particles").len() > 1,
        column => !of_rivals && rows.words(column).len() > 1,
    };
    let told: Vec<(&str, &str)> = PARTS.into_iter().filter(is_told).collect();
    let label = |row: &Row| {
        let named = |(column, symbol): &(&str, &str)| format!("{symbol}{}", part(row, column));
        told.iter().map(named).collect::<Vec<_>>().join(", ")
    };
    rows.by_name(label)
}

/// A line per setting, over targets and seeds.
pub fn settings(rows: &Rows<'_>, page: &mut Page) {
    let ends = "median of all final_sliced | median of all final_mean | median of all final_deviation | quantile 0.5 evaluations | quantile 0.5 wall_seconds";
    let line = |(label, here): (String, Rows<'_>)| {
        let mut cells = vec![label, here.finished()];
        cells.extend(here.cells("median of all final_ratio | least final_ratio"));
        // Rivals are not looked at on their way.
        cells.extend(match here.iter().all(is_rival) {
            true => vec![MISSING.to_owned()],
            false => here.cells("median of all best_ratio"),
        });
        cells.push(here.count(is_good).to_string());
        cells.extend(here.cells(ends));
        cells
    };
    let header = "setting | ended | ED² | least | on the way | ≤ 1 | sliced W2 | mean | sd | evaluations | time (s)";
    page.table(header, groups(rows).into_iter().map(line));
}

/// How many runs are better than, as good as and worse than those of others that are alike in some columns, and of how many pairs both gave nothing; a run without
/// particles is worse than any other.
pub fn against(rows: &Rows<'_>, others: &Rows<'_>, columns: &[&str]) -> [usize; 4] {
    let mut counts = [0; 4];
    for row in rows.iter() {
        let alike = |other: &Row| columns.iter().all(|column| row.value(column) == other.value(column));
        let Some(other) = others.iter().find(|other| alike(other)) else {
            continue;
        };
        let place = match (row.number(RATIO), other.number(RATIO)) {
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
