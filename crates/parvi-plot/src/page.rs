//! A page of Markdown with figures beside it.

use std::fmt::Display;

use crate::statistics::fit_power_law;
use crate::{PlotError, exponent_text};

/// A page that grows by paragraphs, tables and figures.
#[derive(Clone, Debug, Default)]
pub struct Page {
    /// The page as text.
    pub text: String,
    /// The figures on the page with the names of their files, which it expects beside it in `figures/`.
    pub figures: Vec<(String, String)>,
    /// The most important of the page, by name; it is no part of the text.
    pub summary: Vec<(&'static str, String)>,
}

impl Page {
    /// A page with a title.
    pub fn new(title: &str) -> Self {
        Self {
            text: format!("# {title}\n"),
            ..Self::default()
        }
    }

    /// A heading below the title.
    pub fn heading(&mut self, text: &str) {
        self.text.push_str(&format!("\n## {text}\n"));
    }

    /// A paragraph.
    pub fn paragraph(&mut self, text: impl Display) {
        self.text.push_str(&format!("\n{text}\n"));
    }

    /// A table; columns whose cells are numbers are aligned to the right.
    pub fn table(&mut self, header: &(impl Header + ?Sized), rows: impl IntoIterator<Item: AsRef<[String]>>) {
        let rows: Vec<Vec<String>> = rows.into_iter().map(|row| row.as_ref().to_vec()).collect();
        self.aligned_table(&header.names(), &rows);
    }

    fn aligned_table(&mut self, header: &[String], rows: &[Vec<String>]) {
        let numeric = |column: usize| {
            let mut cells = rows
                .iter()
                .filter_map(|row| row.get(column))
                .filter(|cell| cell.as_str() != MISSING);
            cells.all(|cell| cell.starts_with(|c: char| c.is_ascii_digit() || "-−+±<>".contains(c)))
        };
        let rule: Vec<&str> = (0..header.len())
            .map(|column| if numeric(column) { "---:" } else { "---" })
            .collect();
        self.text
            .push_str(&format!("\n| {} |\n| {} |\n", header.join(" | "), rule.join(" | ")));
        for row in rows {
            let cells: Vec<String> = row.iter().map(|cell| cell.replace('|', "\\|")).collect();
            self.text.push_str(&format!("| {} |\n", cells.join(" | ")));
        }
    }

    /// Lines below a heading; without any, what is to be said instead, or not even the heading.
    pub fn list(&mut self, heading: &str, lines: &[String], otherwise: Option<&str>) {
        if lines.is_empty() && otherwise.is_none() {
            return;
        }
        self.heading(heading);
        match otherwise.filter(|_| lines.is_empty()) {
            Some(text) => self.paragraph(text),
            None => self.paragraph(lines.join("\n")),
        }
    }

    /// A figure with its caption; where nothing can be drawn, e.g. because there are no data yet, the page says so.
    pub fn figure(&mut self, name: &str, caption: &str, drawing: Result<String, PlotError>) {
        match drawing {
            Ok(svg) => {
                let alternative = caption.replace(['[', ']'], "");
                self.text
                    .push_str(&format!("\n![{alternative}](figures/{name})\n\n*{caption}*\n"));
                self.figures.push((name.to_owned(), svg));
            }
            Err(error) => self.paragraph(format!("*{caption}* The figure was not drawn: {error}.")),
        }
    }

    /// The same with a line more in its summary.
    pub fn with(mut self, key: &'static str, value: impl ToString) -> Self {
        self.summary.push((key, value.to_string()));
        self
    }
}

/// The names of a table's columns: a list, or a text with ` | ` between them.
pub trait Header {
    /// The names.
    fn names(&self) -> Vec<String>;
}

impl Header for str {
    fn names(&self) -> Vec<String> {
        self.split(" | ").map(str::to_owned).collect()
    }
}

impl<T: AsRef<str>> Header for [T] {
    fn names(&self) -> Vec<String> {
        self.iter().map(|name| name.as_ref().to_owned()).collect()
    }
}

impl<T: AsRef<str>, const N: usize> Header for [T; N] {
    fn names(&self) -> Vec<String> {
        self.as_slice().names()
    }
}

impl<T: AsRef<str>> Header for Vec<T> {
    fn names(&self) -> Vec<String> {
        self.as_slice().names()
    }
}

/// What can stand in a table.
pub trait Cell {
    /// As it stands there: numbers with three digits, counts whole, [`MISSING`] for what there is not.
    fn cell(&self) -> String;
}

impl Cell for f64 {
    fn cell(&self) -> String {
        number(*self)
    }
}

macro_rules! as_displayed {
    ($($type:ty),*) => {$(
        impl Cell for $type {
            fn cell(&self) -> String {
                self.to_string()
            }
        }
    )*};
}

as_displayed!(str, String, usize, u64);

impl<T: Cell + ?Sized> Cell for &T {
    fn cell(&self) -> String {
        (**self).cell()
    }
}

impl<T: Cell> Cell for Option<T> {
    fn cell(&self) -> String {
        self.as_ref().map_or(MISSING.to_owned(), T::cell)
    }
}

/// A line of a table.
pub fn line(cells: &[&dyn Cell]) -> Vec<String> {
    cells.iter().map(|cell| cell.cell()).collect()
}

/// The exponent of the power law through points (x, y), with its 95 % interval.
pub fn exponent(points: impl Iterator<Item = (f64, f64)>) -> String {
    let (x, y): (Vec<f64>, Vec<f64>) = points.unzip();
    let law = fit_power_law(&x, &y);
    law.map_or(MISSING.to_owned(), |law| exponent_text(&law, 0))
}

/// A part of a whole in percent.
pub fn percent(part: usize, whole: usize) -> Option<String> {
    (whole > 0).then(|| format!("{:.0} %", 100.0 * part as f64 / whole as f64))
}

/// What stands in a table for a value that does not exist.
pub const MISSING: &str = "–";

/// A number with three significant digits, in scientific notation where that is shorter to read.
pub fn number(value: f64) -> String {
    if !value.is_finite() {
        return MISSING.to_owned();
    }
    let size = value.abs();
    if value == 0.0 {
        "0".to_owned()
    } else if (1e-3..1e5).contains(&size) {
        let decimals = (2.0 - size.log10().floor()).clamp(0.0, 6.0) as usize;
        format!("{value:.decimals$}")
    } else {
        format!("{value:.2e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_three_digits() {
        let texts: Vec<String> = [0.0, 1.0, -0.012345, 12345.6, 1e-5, 2.5e7, f64::NAN]
            .into_iter()
            .map(number)
            .collect();
        assert_eq!(texts, ["0", "1.00", "-0.0123", "12346", "1.00e-5", "2.50e7", MISSING]);
    }

    #[test]
    fn a_page_is_markdown() {
        let mut page = Page::new("Title");
        page.heading("Part");
        page.table("name | value", [line(&[&"a|b", &1_usize]), line(&[&"c", &None::<f64>])]);
        assert_eq!(
            page.text,
            "# Title\n\n## Part\n\n| name | value |\n| --- | ---: |\n| a\\|b | 1 |\n| c | – |\n"
        );
        let mut other = Page::new("Title");
        other.heading("Part");
        other.table(&["name", "value"], [line(&[&"a|b", &1.0]), line(&[&"c", &f64::NAN])]);
        assert_eq!(other.text, page.text.replace("| 1 |", "| 1.00 |"));
    }

    #[test]
    fn a_list_without_lines_says_so_or_nothing() {
        let mut page = Page::default();
        page.list("Misses", &[], None);
        page.list("Misses", &[], Some("None."));
        page.list("Misses", &["- a".to_owned(), "- b".to_owned()], None);
        assert_eq!(page.text, "\n## Misses\n\nNone.\n\n## Misses\n\n- a\n- b\n");
    }
}
