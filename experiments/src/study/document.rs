//! A page of Markdown with figures beside it.

use std::fmt::Display;

use super::directory::StudyDirectory;
use crate::CommandError;
use crate::output::AtomicFile;
use crate::plots::PlotError;

/// A page that grows by paragraphs, tables and figures.
#[derive(Clone, Debug, Default)]
pub struct Document {
    text: String,
}

impl Document {
    /// A page with a title.
    pub fn new(title: &str) -> Self {
        Self {
            text: format!("# {title}\n"),
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
    pub fn table(&mut self, header: &[&str], rows: &[Vec<String>]) {
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

    /// A figure with its caption; where nothing can be drawn, e.g. because no case of it has finished, the page says so.
    pub fn figure(
        &mut self,
        directory: &StudyDirectory,
        name: &str,
        caption: &str,
        drawing: Result<String, PlotError>,
    ) -> Result<(), CommandError> {
        match drawing {
            Ok(svg) => {
                AtomicFile::write(directory.figure(name), svg)?;
                let alternative = caption.replace(['[', ']'], "");
                self.text
                    .push_str(&format!("\n![{alternative}](figures/{name})\n\n*{caption}*\n"));
            }
            Err(error) => self.paragraph(format!("*{caption}* The figure was not drawn: {error}.")),
        }
        Ok(())
    }

    /// The page as text.
    pub fn as_str(&self) -> &str {
        &self.text
    }
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

/// As [`number`], or [`MISSING`].
pub fn optional_number(value: Option<f64>) -> String {
    value.map_or(MISSING.to_owned(), number)
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
        let mut page = Document::new("Title");
        page.heading("Part");
        page.table(
            &["name", "value"],
            &[vec!["a|b".into(), "1".into()], vec!["c".into(), MISSING.into()]],
        );
        assert_eq!(
            page.as_str(),
            "# Title\n\n## Part\n\n| name | value |\n| --- | ---: |\n| a\\|b | 1 |\n| c | – |\n"
        );
    }
}
