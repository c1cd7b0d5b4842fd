#![doc = include_str!("../README.md")]

mod claim;
mod fingerprint;
mod offender;

use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;

pub use claim::claim;
pub use fingerprint::fingerprint;

/// A text that is no TOML, or not the document that was asked for: an unknown or missing key, a value of the wrong type.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}{}", file.display(), described(place.as_ref(), message))]
pub struct DocumentError {
    /// The file.
    pub file: PathBuf,
    /// Where in it; `None` where the fault is of the whole document, as a missing key outside of all tables is.
    pub place: Option<Place>,
    /// What is wrong; it names unknown and missing keys.
    pub message: String,
}

/// A place in a document.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The line, counted from 1.
    pub line: usize,
    /// The column, counted from 1.
    pub column: usize,
    /// The text of the line.
    pub text: String,
    /// The table it stands in, as in `materials.steel`; empty outside of all tables.
    pub table: String,
}

/// The document in a text; `file` is what errors call it.
///
/// # Errors
/// [`DocumentError`].
pub fn parse<T: DeserializeOwned>(text: &str, file: &Path) -> Result<T, DocumentError> {
    if text.trim().is_empty() {
        return Err(DocumentError {
            file: file.to_owned(),
            place: None,
            message: "the file is empty".to_owned(),
        });
    }
    toml::from_str(text).map_err(|error| {
        let message = error.message().trim().replace('\n', ", ");
        // The parser's span of the document itself is empty.
        let span = error.span().filter(|span| span.end > 0);
        DocumentError {
            file: file.to_owned(),
            place: span.map(|span| {
                let byte = offender::offender::<T>(text, &span).unwrap_or(span.start);
                Place::at(text, byte)
            }),
            message: in_words(&message),
        }
    })
}

/// The bytes of a file as a text; `file` is what errors call it.
///
/// # Errors
/// [`DocumentError`] where they stop being UTF-8.
pub fn text(bytes: Vec<u8>, file: &Path) -> Result<String, DocumentError> {
    String::from_utf8(bytes).map_err(|error| {
        let end = error.utf8_error().valid_up_to();
        let before = String::from_utf8_lossy(&error.as_bytes()[..end]).into_owned();
        let message = "what follows is not UTF-8, as TOML has to be".to_owned();
        DocumentError::at(file, &before, end, message)
    })
}

impl DocumentError {
    /// An error at a byte of the text.
    pub fn at(file: &Path, text: &str, byte: usize, message: String) -> Self {
        Self {
            file: file.to_owned(),
            place: Some(Place::at(text, byte)),
            message,
        }
    }
}

impl Place {
    fn at(text: &str, byte: usize) -> Self {
        let before = text.get(..byte).unwrap_or(text);
        let start = before.rfind('\n').map_or(0, |position| position + 1);
        let line = before.matches('\n').count() + 1;
        Self {
            line,
            column: before[start..].chars().count() + 1,
            text: text[start..].lines().next().unwrap_or_default().trim().to_owned(),
            table: table_of(text, line).to_owned(),
        }
    }

    /// The key in the line with the table it stands in, as in `materials.steel.density`; empty where there is none.
    pub fn field(&self) -> String {
        let key = self.text.split_once('=').filter(|_| header(&self.text).is_none());
        let key = key.map_or("", |(key, _)| key.trim());
        let parts = [self.table.as_str(), key].into_iter().filter(|part| !part.is_empty());
        parts.collect::<Vec<_>>().join(".")
    }
}

/// What follows the file's name in a message.
fn described(place: Option<&Place>, message: &str) -> String {
    let Some(place) = place else {
        return format!(": {message}");
    };
    let Place {
        line,
        column,
        text,
        table,
    } = place;
    let quoted = match (text.as_str(), table.as_str()) {
        ("", _) => String::new(),
        (text, "") => format!(" (in `{text}`)"),
        (text, _) if header(text).is_some() => format!(" (in `{text}`)"),
        (text, table) => format!(" (in `{text}` of [{table}])"),
    };
    format!(", line {line}, column {column}: {message}{quoted}")
}

/// The parser's message without the names that types have in the code: a `struct OutputTable` is a table.
fn in_words(message: &str) -> String {
    let mut words = Vec::new();
    let mut rest = message.split(' ').peekable();
    while let Some(word) = rest.next() {
        let of_type = matches!(word, "struct" | "enum");
        let named = |next: &&str| next.starts_with(|c: char| c.is_ascii_uppercase());
        if of_type && rest.peek().is_some_and(named) {
            while words.last().is_some_and(|last| ["tagged", "internally"].contains(last)) {
                words.pop();
            }
            let tail = rest.next().and_then(|name| name.strip_suffix(','));
            words.push(if tail.is_some() { "a table," } else { "a table" });
        } else {
            words.push(word);
        }
    }
    words.join(" ")
}

/// The table that a line stands in; empty for that of the document. A bracket within an array of several lines is no header: what stands before a header is TOML of its own.
fn table_of(text: &str, line: usize) -> &str {
    let (mut table, mut start) = ("", 0);
    for own in text.split_inclusive('\n').take(line) {
        if let Some(name) = header(own)
            && text[..start].parse::<toml::Table>().is_ok()
        {
            table = name;
        }
        start += own.len();
    }
    table
}

/// The name in the header of a table.
fn header(line: &str) -> Option<&str> {
    let name = line.trim().strip_prefix('[')?.trim_start_matches('[');
    name.split(']').next().map(str::trim)
}

#[cfg(test)]
mod tests {
    use serde::Deserialize;

    use super::*;

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    #[expect(dead_code, reason = "only read")]
    struct Example {
        title: String,
        part: Option<Part>,
        #[serde(default)]
        shapes: Vec<Shape>,
    }

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    #[expect(dead_code, reason = "only read")]
    struct Part {
        size: f64,
    }

    #[derive(Debug, Deserialize)]
    #[serde(tag = "kind", rename_all = "kebab-case")]
    #[expect(dead_code, reason = "only read")]
    enum Shape {
        Ball,
        Disk(Disk),
        Hull { of: Vec<Shape> },
    }

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    #[expect(dead_code, reason = "only read")]
    struct Disk {
        centre: Vec<f64>,
        radius: f64,
    }

    fn message(text: &str) -> String {
        parse::<Example>(text, Path::new("a.toml"))
            .expect_err("refused")
            .to_string()
    }

    #[test]
    fn mistakes_are_reported_where_they_are() {
        for (text, expected) in [
            (
                "# about\ntitle = \"a\"\n  sizes = 3\n",
                "a.toml, line 3, column 3: unknown field `sizes`, expected one of `title`, `part`, `shapes` (in `sizes = 3`)",
            ),
            (
                "title = 3",
                "a.toml, line 1, column 9: invalid type: integer `3`, expected a string (in `title = 3`)",
            ),
            ("# about\n[part]\nsize = 1.0\n", "a.toml: missing field `title`"),
            (
                "title = \"a\"\n[part]\n",
                "a.toml, line 2, column 1: missing field `size` (in `[part]`)",
            ),
            (" \n", "a.toml: the file is empty"),
        ] {
            assert_eq!(message(text), expected);
        }
        assert!(message("title = ").starts_with("a.toml, line 1, column 9: "));
    }

    #[test]
    fn bytes_that_are_no_text_are_reported_where_they_are() {
        let text = |bytes: &[u8]| text(bytes.to_vec(), Path::new("a.toml"));
        assert_eq!(text("é = 3".as_bytes()).as_deref(), Ok("é = 3"));
        let error = text(b"# about\ntitle = \"caf\xe9\"\n").expect_err("Latin-1");
        assert_eq!(
            error.to_string(),
            "a.toml, line 2, column 13: what follows is not UTF-8, as TOML has to be (in `title = \"caf`)"
        );
    }

    #[test]
    fn types_have_the_names_of_the_format() {
        assert_eq!(
            message("title = \"a\"\npart = 3"),
            "a.toml, line 2, column 8: invalid type: integer `3`, expected a table (in `part = 3`)"
        );
        let shape = message("title = \"a\"\nshapes = [\"ball\"]");
        assert!(
            shape.contains("expected a table") && !shape.contains("Shape"),
            "{shape}"
        );
        assert!(parse::<Example>("title = \"a\"\nshapes = [{ kind = \"ball\" }]", Path::new("")).is_ok());
    }

    /// Tables with a tag are read as a whole, and their errors alone would be at the header.
    #[test]
    fn mistakes_in_tables_with_a_tag_are_reported_where_they_are() {
        let disk = "title = \"a\"\n[[shapes]]\nkind = \"disk\"\ncentre = [1.0,\n 2]\nradius = 1\n";
        for (from, to, line, column) in [
            ("radius = 1", "radius = \"1 m\"", 6, 10),
            ("radius = 1", "radius = 1\nsize = 3", 7, 1),
            (" 2]", " \"2 m\"]", 5, 2),
            ("[1.0,\n 2]", "3", 4, 10),
            ("\"disk\"", "\"disc\"", 3, 8),
            ("\"disk\"", "3", 3, 8),
            ("radius = 1", "", 2, 1),
            (
                "radius = 1",
                "radius = \"1 m\"\n[[shapes]]\nkind = \"disk\"\nradius = \"1 m\"",
                6,
                10,
            ),
            (
                "radius = 1",
                "radius = 1\n[[shapes]]\nkind = \"hull\"\nof = [\n{ kind = \"ball\" },\n{ kind = \"disk\", radius = true } ]",
                11,
                27,
            ),
        ] {
            assert!(disk.contains(from), "{from}");
            let text = disk.replacen(from, to, 1);
            let error = parse::<Example>(&text, Path::new("a.toml")).expect_err("refused");
            let place = error.place.as_ref().map(|place| (place.line, place.column));
            assert_eq!(place, Some((line, column)), "{error}");
        }
        let error = message(&disk.replace("radius = 1", "radius = \"1 m\""));
        assert_eq!(
            error,
            "a.toml, line 6, column 10: invalid type: string \"1 m\", expected f64 (in `radius = \"1 m\"` of [shapes])"
        );
    }

    #[test]
    fn a_place_knows_its_key_and_table() {
        let error = DocumentError::at(
            Path::new("a.toml"),
            "title = 1\n[part]\nsize = 2\n",
            22,
            "odd".to_owned(),
        );
        assert_eq!(
            error.to_string(),
            "a.toml, line 3, column 6: odd (in `size = 2` of [part])"
        );
        assert_eq!(error.place.map(|place| place.field()).as_deref(), Some("part.size"));
    }

    #[test]
    fn rows_of_an_array_are_no_headers() {
        let field = |text: &str, key: &str| {
            let byte = text.find(key).expect("there");
            let error = DocumentError::at(Path::new("a.toml"), text, byte, "odd".to_owned());
            error.place.map(|place| place.field())
        };
        let text = "[part]\nrows = [\n  [1.0],\n  [2.0],\n]\nsize = 2\n[[other]]\nlength = 1\n";
        assert_eq!(field(text, "size").as_deref(), Some("part.size"));
        assert_eq!(field(text, "length").as_deref(), Some("other.length"));
    }
}
