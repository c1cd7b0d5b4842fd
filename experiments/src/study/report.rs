//! What a study says of its rows.

use crate::plots::page::Page;

/// What a report says.
pub struct Report {
    /// The page with its figures.
    pub page: Page,
    /// The most important of it, as `key=value` lines for standard output.
    pub summary: Vec<(&'static str, String)>,
}

impl Report {
    /// A page, and nothing beside it.
    pub fn new(page: Page) -> Self {
        let summary = Vec::new();
        Self { page, summary }
    }

    /// The same with a line more.
    pub fn with(mut self, key: &'static str, value: impl ToString) -> Self {
        self.summary.push((key, value.to_string()));
        self
    }
}
