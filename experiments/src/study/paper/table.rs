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

/// The rows by what they are of.
pub struct Findings<'a> {
    /// All bodies.
    pub bodies: Rows<'a>,
    /// The rows of each table of the configuration; some may be missing.
    pub tables: Vec<(&'a str, Rows<'a>)>,
}

impl<'a> Findings<'a> {
    /// Looks for the rows of all tables.
    pub fn new(study: &'a Paper, rows: &Rows<'a>) -> Result<Self, CommandError> {
        let known: HashMap<&str, &Row> = rows.iter().map(|row| (row.case(), row)).collect();
        let found = |case: &Setting| known.get(case.id().as_str()).copied();
        let of = |(name, cases): (&'a str, Vec<Setting>)| (name, cases.iter().filter_map(found).collect());
        Ok(Self {
            bodies: rows.having(|row| !is_rival(row)),
            tables: study.tables()?.into_iter().map(of).collect(),
        })
    }

    /// The rows of a table; none if there is no such one.
    pub fn of(&self, table: &str) -> Rows<'a> {
        let found = self.tables.iter().find(|(known, _)| *known == table);
        found.map(|(_, rows)| rows.clone()).unwrap_or_default()
    }
}

/// The rows by what differs among their settings, target and seed apart, in the order of the cases.
pub fn groups<'a>(rows: &Rows<'a>) -> Vec<(String, Rows<'a>)> {
    // The methods are named even where there is only one.
    let is_told = |(column, _): &(&str, &str)| match *column {
        "method" => true,
        "variant" => !rows.iter().all(is_rival),
        column => rows.words(column).len() > 1,
    };
    let told: Vec<(&str, &str)> = PARTS.into_iter().filter(is_told).collect();
    let named = |row: &Row, (column, symbol): &(&str, &str)| format!("{symbol}{}", part(row, column));
    rows.by_name(|row| told.iter().map(|told| named(row, told)).collect::<Vec<_>>().join(", "))
}

/// A line per setting, over targets and seeds.
pub fn settings<'a>(rows: &Rows<'a>) -> Vec<Line<'a>> {
    let line = |(label, here)| Line::from(here).with("setting", label);
    groups(rows).into_iter().map(line).collect()
}
