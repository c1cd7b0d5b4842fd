//! A page of Markdown with figures beside it.

mod cell;
mod line;
mod prose;

use std::fmt::Display;

use crate::PlotError;
use prose::{Prose, filled};

pub(crate) use cell::exponent;
pub use cell::{Cell, MISSING, counted, escaped, number, number_beside, number_of, percent, telling_digits};
pub use line::{Line, each};

/// A page that grows by paragraphs, tables and figures.
#[derive(Clone, Debug, Default)]
pub struct Page {
    /// The page as text.
    pub text: String,
    /// The figures on the page with the names of their files, which it expects beside it in `figures/`.
    pub figures: Vec<(String, String)>,
    /// The most important of the page, by name; it is no part of the text.
    pub summary: Vec<(String, String)>,
    /// What [`part`](Self::part), [`part_of`](Self::part_of), [`list_of`](Self::list_of) and [`drawing`](Self::drawing) choose from.
    prose: Prose,
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
    /// [`part`](Self::part) or [`part_of`](Self::part_of) asks for it, a line `![caption](name.svg)` is the caption of a figure, and a table is that of [`lines`](Self::lines).
    pub fn of(prose: &str, values: &[(&str, &dyn Display)]) -> Self {
        let prose = Prose::new(prose, values);
        let mut page = Self {
            text: format!("# {}\n", prose.title()),
            prose,
            ..Self::default()
        };
        page.paragraphs("", str::to_owned);
        page
    }

    /// A section of the prose: `## name` with its heading, `### name` without.
    pub fn part(&mut self, name: &str, values: &[(&str, &dyn Display)]) {
        self.written(name, |text| filled(text, values));
    }

    /// The same with places that are filled as those of a table are: with what a line names, or a statistic of its rows.
    pub fn part_of<'a>(&mut self, name: &str, line: impl Into<Line<'a>>) {
        let line = line.into();
        self.written(name, |text| line.filled(text));
    }

    fn written(&mut self, name: &str, fill: impl Fn(&str) -> String) {
        if self.prose.has_heading(name) {
            self.heading(&fill(name));
        }
        self.paragraphs(name, fill);
    }

    fn paragraphs(&mut self, name: &str, fill: impl Fn(&str) -> String) {
        match self.prose.paragraphs(name) {
            Some(paragraphs) => paragraphs.iter().for_each(|text| self.paragraph(fill(text))),
            None => self.paragraph(absent(name)),
        }
    }

    /// The table of a section of the prose, whose one line says what stands in every line: text, and in braces what a [`Line`] names or a
    /// statistic of its rows; several lines are written for each. Without lines it is a header. A cell of which no place has a value is [`MISSING`]; a place in brackets that has none
    /// falls away with them.
    pub fn lines<'a>(&mut self, part: &str, lines: impl IntoIterator<Item = impl Into<Line<'a>>>) {
        self.lines_over(part, &[], lines);
    }

    /// The same for a table with columns that are repeated: those in which a name stands in braces, once for each value of that name, which is put into its places.
    pub fn lines_over<'a>(
        &mut self,
        part: &str,
        repeated: &[(&str, Vec<String>)],
        lines: impl IntoIterator<Item = impl Into<Line<'a>>>,
    ) {
        let Some((header, texts)) = self.prose.table(part, repeated) else {
            return self.paragraph(absent(part));
        };
        let mut rows = Vec::new();
        for line in lines {
            let line = line.into();
            rows.extend(texts.iter().map(|cells| line.cells(cells)));
        }
        self.table(&header, &rows);
    }

    /// A section of the prose with its table, some columns of which are repeated.
    pub fn section<'a>(
        &mut self,
        name: &str,
        repeated: &[(&str, Vec<String>)],
        lines: impl IntoIterator<Item = impl Into<Line<'a>>>,
    ) {
        self.part(name, &[]);
        self.lines_over(name, repeated, lines);
    }

    /// A section of the prose that is a list: its items say what stands in every line, of several the first for whose places there is something, else the last.
    /// What stands before the items is written above the lines, and what stands behind them in their place where there are none; without that not even the heading is.
    pub fn list_of<'a>(&mut self, name: &str, lines: impl IntoIterator<Item = impl Into<Line<'a>>>) {
        let Some(paragraphs) = self.prose.paragraphs(name) else {
            return self.paragraph(absent(name));
        };
        let is_item = |text: &String| text.starts_with("- ");
        let first = paragraphs.iter().position(is_item).unwrap_or(paragraphs.len());
        let (above, below) = paragraphs.split_at(first);
        let (items, otherwise): (Vec<String>, Vec<String>) = below.iter().cloned().partition(is_item);
        let lines: Vec<String> = lines.into_iter().map(|line| line.into().item(&items)).collect();
        let written = if lines.is_empty() { &otherwise[..] } else { above };
        if self.prose.has_heading(name) && !(lines.is_empty() && otherwise.is_empty()) {
            self.heading(name);
        }
        written.iter().for_each(|text| self.paragraph(text));
        self.items(&lines);
    }

    /// A figure whose caption is in the prose.
    pub fn drawing(&mut self, name: &str, drawing: Result<String, PlotError>) {
        let caption = self.prose.caption(name);
        self.figure(name, &caption.unwrap_or_else(|| absent(name)), drawing);
    }

    /// A heading below the title.
    pub fn heading(&mut self, text: &str) {
        self.text.push_str(&format!("\n## {text}\n"));
    }

    /// A paragraph.
    pub fn paragraph(&mut self, text: impl Display) {
        self.text.push_str(&format!("\n{text}\n"));
    }

    /// Columns whose cells are numbers are aligned to the right.
    fn table(&mut self, header: &[String], rows: &[Vec<String>]) {
        let numeric = |column: usize| {
            let mut cells = rows
                .iter()
                .filter_map(|row| row.get(column))
                .filter(|cell| cell.as_str() != MISSING);
            cells.all(|cell| {
                cell.starts_with(|c: char| c.is_ascii_digit() || "-−+±<>".contains(c)) || cell.starts_with("&lt;")
            })
        };
        let rule: Vec<&str> = (0..header.len())
            .map(|column| if numeric(column) { "---:" } else { "---" })
            .collect();
        let line = |cells: &[String]| {
            let cells: Vec<String> = cells.iter().map(|cell| cell.replace('|', "\\|")).collect();
            format!("| {} |\n", cells.join(" | "))
        };
        let rule = format!("| {} |\n", rule.join(" | "));
        self.text.push_str(&format!("\n{}{rule}", line(header)));
        for row in rows {
            self.text.push_str(&line(row));
        }
    }

    /// Lines of one paragraph, if there are any.
    pub fn items(&mut self, lines: &[String]) {
        if !lines.is_empty() {
            self.paragraph(lines.join("\n"));
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
            None => self.items(lines),
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
    pub fn with(mut self, key: impl Into<String>, value: impl ToString) -> Self {
        self.summary.push((key.into(), value.to_string()));
        self
    }
}

/// What a page says where its prose lacks what was asked for.
fn absent(name: &str) -> String {
    format!("The prose has no `{name}`.")
}
