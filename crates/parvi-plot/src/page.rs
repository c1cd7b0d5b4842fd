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
    /// What [`part`](Self::part) and [`drawing`](Self::drawing) choose from.
    prose: String,
}

impl Page {
    /// A page with a title.
    pub fn new(title: &str) -> Self {
        Self {
            text: format!("# {title}\n"),
            ..Self::default()
        }
    }

    /// A page whose prose is a Markdown text with `{name}` where values go. The title and what stands below it are written; of the rest a section is written when
    /// [`part`](Self::part) asks for it, and a line `![caption](name.svg)` is the caption of a figure.
    pub fn of(prose: &str, values: &[(&str, &dyn Display)]) -> Self {
        let prose = filled(prose, values);
        let title = prose.lines().find_map(|line| line.strip_prefix("# "));
        let title = title.unwrap_or_default().to_owned();
        let mut page = Self {
            prose,
            ..Self::new(&title)
        };
        page.paragraphs("# ", &title, &[]);
        page
    }

    /// A section of the prose: `## name` with its heading, `### name` without.
    pub fn part(&mut self, name: &str, values: &[(&str, &dyn Display)]) {
        if self.prose.lines().any(|line| line.strip_prefix("## ") == Some(name)) {
            self.heading(&filled(name, values));
            self.paragraphs("## ", name, values);
        } else {
            self.paragraphs("### ", name, values);
        }
    }

    fn paragraphs(&mut self, mark: &str, name: &str, values: &[(&str, &dyn Display)]) {
        let lines = self
            .prose
            .lines()
            .skip_while(|line| line.strip_prefix(mark) != Some(name));
        let lines: Vec<&str> = lines.skip(1).take_while(|line| !line.starts_with('#')).collect();
        for paragraph in lines.join("\n").split("\n\n").map(str::trim) {
            if !paragraph.is_empty() && !paragraph.starts_with("![") {
                self.paragraph(filled(&paragraph.replace('\n', " "), values));
            }
        }
    }

    /// A figure whose caption is in the prose.
    pub fn drawing(&mut self, name: &str, drawing: Result<String, PlotError>) {
        let end = format!("]({name})");
        let caption = |line: &str| Some(line.strip_prefix("![")?.strip_suffix(&end)?.to_owned());
        let caption = self.prose.lines().find_map(caption).unwrap_or_default();
        self.figure(name, &caption, drawing);
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

/// A text with values in the places that are called by their names.
fn filled(text: &str, values: &[(&str, &dyn Display)]) -> String {
    let fill =
        |text: String, (name, value): &(&str, &dyn Display)| text.replace(&format!("{{{name}}}"), &value.to_string());
    values.iter().fold(text.to_owned(), fill)
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
    fn prose_is_a_text_with_places() {
        let prose = "# Of {dim}\n\nM = {particles},\nexact.\n\n## To {end}\n\nFirst.\n\nSecond, {end}.\n\n![Error, d = {dim}.](a.svg)\n\n### aside\n\nThird.\n";
        let mut page = Page::of(prose, &[("dim", &2), ("particles", &64)]);
        page.part("aside", &[]);
        page.part("To {end}", &[("end", &"Z")]);
        page.drawing("a.svg", Ok(String::new()));
        let figure = "![Error, d = 2.](figures/a.svg)\n\n*Error, d = 2.*";
        assert_eq!(
            page.text,
            format!("# Of 2\n\nM = 64, exact.\n\nThird.\n\n## To Z\n\nFirst.\n\nSecond, Z.\n\n{figure}\n")
        );
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
