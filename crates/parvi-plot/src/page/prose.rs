//! The Markdown text that a page is made from.

use std::fmt::Display;

use super::cell::{COUNTED, escaped};

/// A text whose sections, captions and tables are written where they are asked for.
#[derive(Clone, Debug, Default)]
pub(super) struct Prose(String);

impl Prose {
    /// The text with values in its places but for those of tables, which are filled line by line.
    pub fn new(text: &str, values: &[(&str, &dyn Display)]) -> Self {
        let line = |line: &str| {
            if is_table(line) {
                line.to_owned()
            } else {
                filled(line, values)
            }
        };
        Self(text.lines().map(line).collect::<Vec<_>>().join("\n"))
    }

    pub fn title(&self) -> &str {
        let title = self.0.lines().find_map(|line| line.strip_prefix("# "));
        title.unwrap_or_default()
    }

    /// Whether a section is one with a heading.
    pub fn has_heading(&self, name: &str) -> bool {
        self.0.lines().any(|line| line.strip_prefix("## ") == Some(name))
    }

    /// The lines of a section, without a name of what stands below the title.
    fn section(&self, name: &str) -> Option<impl Iterator<Item = &str>> {
        let is_head = |line: &str| match name {
            "" => line.starts_with("# "),
            name => line.strip_prefix("## ").or(line.strip_prefix("### ")) == Some(name),
        };
        let mut lines = self.0.lines();
        lines.find(|line| is_head(line))?;
        Some(lines.take_while(|line| !line.starts_with('#')))
    }

    /// The paragraphs of a section.
    pub fn paragraphs(&self, name: &str) -> Option<Vec<String>> {
        let text = self.section(name)?.collect::<Vec<_>>().join("\n");
        let paragraphs = text.split("\n\n").map(str::trim);
        let written = paragraphs.filter(|text| !text.is_empty() && !text.starts_with("![") && !is_table(text));
        Some(written.map(|text| text.replace('\n', " ")).collect())
    }

    /// The caption of a figure.
    pub fn caption(&self, name: &str) -> Option<String> {
        let end = format!("]({name})");
        let caption = |line: &str| Some(line.strip_prefix("![")?.strip_suffix(&end)?.to_owned());
        self.0.lines().find_map(caption)
    }

    /// Header and lines of the table of a section, repeated columns once for each of their values.
    pub fn table(&self, name: &str, repeated: &[(&str, Vec<String>)]) -> Option<(Vec<String>, Vec<Vec<String>>)> {
        let lines = self.section(name)?.filter(|line| is_table(line));
        let mut lines: Vec<Vec<String>> = lines.map(cells_of).collect();
        // Below the header is a rule.
        (lines.len() > 2).then(|| lines.remove(1))?;
        let cell = |line: &Vec<String>, column: usize| line.get(column).cloned().unwrap_or_default();
        let column = |column: usize| lines.iter().map(|line| cell(line, column)).collect();
        let mut columns: Vec<Vec<String>> = (0..lines[0].len()).map(column).collect();
        for (name, values) in repeated {
            let place = format!("{{{name}}}");
            let is_of = |column: &Vec<String>| column.iter().any(|cell| cell.contains(&place));
            let first = columns.iter().position(is_of)?;
            let end = columns.iter().rposition(is_of)? + 1;
            let group: Vec<Vec<String>> = columns.drain(first..end).collect();
            let of = |value: &String| {
                let shown = escaped(value);
                let filled = |column: &Vec<String>| {
                    let values = std::iter::once(&shown).chain(std::iter::repeat(value));
                    let cells = column.iter().zip(values);
                    cells.map(|(cell, value)| cell.replace(&place, value)).collect()
                };
                group.iter().map(filled).collect::<Vec<_>>()
            };
            columns.splice(first..first, values.iter().flat_map(of));
        }
        let mut lines = (0..lines.len()).map(|line| columns.iter().map(|column| column[line].clone()).collect());
        Some((lines.next()?, lines.collect()))
    }
}

fn is_table(line: &str) -> bool {
    line.starts_with("| ")
}

fn cells_of(line: &str) -> Vec<String> {
    let inner = line.trim().trim_start_matches("| ").trim_end_matches(" |");
    inner.split(" | ").map(str::to_owned).collect()
}

/// A text with values in the places that are called by their names; a word for several behind a 1 becomes that for one.
pub(super) fn filled(text: &str, values: &[(&str, &dyn Display)]) -> String {
    let fill = |text: String, (name, value): &(&str, &dyn Display)| {
        let (place, value) = (format!("{{{name}}}"), value.to_string());
        let several = COUNTED.iter().filter(|_| value == "1");
        let text = several.fold(text, |text, (many, one)| {
            text.replace(&format!("{place} {many}"), &format!("{place} {one}"))
        });
        text.replace(&place, &value)
    };
    values.iter().fold(text.to_owned(), fill)
}
