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
    let lines = groups(rows).into_iter().map(|(label, here)| {
        // Rivals are not looked at on their way.
        let is_body = !here.iter().all(is_rival);
        let best = is_body.then(|| here.cell("median of all best_ratio"));
        Line::from(here).with("setting", label).with("best", best)
    });
    page.lines("settings", lines);
}
