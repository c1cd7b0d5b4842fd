//! Reading a study's configuration: every mistake is reported with file, line, column and the text of the line.

use std::collections::BTreeMap;
use std::fs;
use std::ops::Range;
use std::path::Path;

use mpm_document::{DocumentError, Place};
use parvi_options::Bounded;
use serde::Deserialize;
use serde::de::DeserializeOwned;
use toml::{Spanned, Table, Value};

use crate::CommandError;

/// The text of a configuration and what can be said about it before its kind is known.
#[derive(Clone, Debug)]
pub struct Configuration {
    /// The file it came from.
    pub file: String,
    /// The text, as read.
    pub text: String,
    /// A fingerprint of all keys and values; comments, spaces and the order of keys do not matter.
    pub hash: String,
    /// The seeds in `seed` or `seeds`, if it has one of both.
    pub seeds: Vec<u64>,
    head: Head,
}

/// What every configuration has, or may have.
#[derive(Clone, Debug, Deserialize)]
struct Head {
    kind: Spanned<String>,
    threads: Option<Spanned<Bounded<1, 1024>>>,
}

impl Configuration {
    /// Reads the file and its `kind`.
    ///
    /// # Errors
    /// [`CommandError::Files`] if it cannot be read, [`CommandError::Config`] if it is no TOML or has no `kind`.
    pub fn read(path: &Path) -> Result<Self, CommandError> {
        let bytes = fs::read(path).map_err(|source| CommandError::file("read", path, source))?;
        let text = mpm_document::text(bytes, path)?;
        Self::from_text(path.display().to_string(), text)
    }

    fn from_text(file: String, text: String) -> Result<Self, CommandError> {
        let head: Head = mpm_document::parse(&text, Path::new(&file))?;
        let table: Table = mpm_document::parse(&text, Path::new(&file))?;
        Ok(Self {
            // A TOML table has string keys and plain values only, all of which JSON can hold.
            hash: fingerprint(&serde_json::to_string(&table).unwrap_or_default()),
            seeds: whole_numbers(["seed", "seeds"].iter().find_map(|key| table.get(*key))),
            head,
            file,
            text,
        })
    }

    /// The study's kind, as written.
    pub fn kind(&self) -> &str {
        self.head.kind.get_ref()
    }

    /// The number in `threads`, if it has one.
    pub fn threads(&self) -> Option<usize> {
        self.head.threads.as_ref().map(|threads| threads.get_ref().get())
    }

    /// What the prose of reports may name: plain values by their dotted keys, of a list its length, of a method its label.
    pub fn values(&self) -> Vec<(String, String)> {
        let mut values = Vec::new();
        collect(&self.text.parse().unwrap_or_default(), "", &mut values);
        values
    }

    /// Fingerprints of the files that parameters of targets name as their `data` or in the command line of their `program`, by these names.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub fn target_fingerprints(&self) -> Result<BTreeMap<String, String>, CommandError> {
        let mut files = Vec::new();
        target_files(&Value::Table(self.text.parse().unwrap_or_default()), &mut files);
        let of = |file: String| {
            let bytes = fs::read(&file).map_err(|source| CommandError::file("read", &file, source))?;
            Ok((file, of_bytes(&bytes)))
        };
        files.into_iter().map(of).collect()
    }

    /// The configuration as its kind understands it, without the keys of the head. Unknown keys are errors.
    pub fn parse<T: DeserializeOwned>(&self) -> Result<T, CommandError> {
        let mut text = without_key(&self.text, &self.head.kind.span());
        if let Some(threads) = &self.head.threads {
            text = without_key(&text, &threads.span());
        }
        let parsed = mpm_document::parse(&text, Path::new(&self.file));
        parsed.map_err(|mut error| {
            let field = error.place.as_ref().map(Place::field).unwrap_or_default();
            if error.message.starts_with(&format!("unknown field `{field}`, expected")) {
                // A key of the document: what may stand there is what the kind knows, and the keys of the head.
                error.message += ", `kind`, `threads`";
            }
            error.into()
        })
    }

    /// The error for a kind that does not exist.
    pub fn unknown_kind(&self, known: &[&str]) -> CommandError {
        let message = format!("unknown kind `{}`, expected one of {}", self.kind(), known.join(", "));
        DocumentError::at(Path::new(&self.file), &self.text, self.head.kind.span().start, message).into()
    }
}

/// The text without the key whose value is there: a comment of the same length, so that all else keeps its place.
fn without_key(text: &str, value: &Range<usize>) -> String {
    let start = text[..value.start].rfind('\n').map_or(0, |end| end + 1);
    let covered = text[start..value.end].bytes().enumerate();
    let covered: String = covered
        .map(|(place, byte)| match (place, byte) {
            (0, _) => '#',
            (_, b'\n') => '\n',
            _ => ' ',
        })
        .collect();
    format!("{}{covered}{}", &text[..start], &text[value.end..])
}

fn collect(table: &Table, place: &str, values: &mut Vec<(String, String)>) {
    for (key, value) in table {
        let key = format!("{place}{key}");
        let value = match value {
            Value::Table(table) => {
                collect(table, &format!("{key}."), values);
                let name = table.get("label").or(table.get("name"));
                name.and_then(Value::as_str).unwrap_or_default().to_owned()
            }
            Value::Array(list) => list.len().to_string(),
            Value::Float(number) => number.to_string(),
            Value::String(text) => text.clone(),
            other => other.to_string(),
        };
        values.push((key, value));
    }
}

/// Adds what stands at `parameters.data` of any table, and the files in `parameters.program`.
fn target_files(value: &Value, files: &mut Vec<String>) {
    match value {
        Value::Table(table) => {
            let parameters = table.get("parameters");
            let text = |key: &str| parameters.and_then(|parameters| parameters.get(key)?.as_str());
            files.extend(text("data").map(str::to_owned));
            files.extend(text("program").map(files_in).unwrap_or_default());
            table.values().for_each(|value| target_files(value, files));
        }
        Value::Array(list) => list.iter().for_each(|value| target_files(value, files)),
        _ => {}
    }
}

/// The words of a command line that are files, whether the shell would part it there or at its quotes alone.
fn files_in(command: &str) -> Vec<String> {
    let quotes = ['\'', '"'];
    let parts = |letter: char| letter.is_whitespace() || quotes.contains(&letter) || ";|&<>()=".contains(letter);
    let words = command.split(quotes).chain(command.split(parts));
    let is_file = |word: &&str| Path::new(word).is_file();
    words.map(str::trim).filter(is_file).map(str::to_owned).collect()
}

/// A number or a list of them; what is neither is for the kind to refuse.
fn whole_numbers(value: Option<&Value>) -> Vec<u64> {
    let list = value.map_or(&[][..], |value| {
        value.as_array().map_or(std::slice::from_ref(value), Vec::as_slice)
    });
    let numbers = list.iter().filter_map(Value::as_integer);
    numbers.filter_map(|number| u64::try_from(number).ok()).collect()
}

/// The fingerprint of a text in hexadecimal digits.
pub fn fingerprint(text: &str) -> String {
    of_bytes(text.as_bytes())
}

fn of_bytes(bytes: &[u8]) -> String {
    format!("{:016x}", mpm_document::fingerprint(bytes))
}

#[cfg(test)]
mod tests {
    use super::*;
    use parvi_options::ParticleCount;

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Example {
        #[serde(rename = "particles")]
        _particles: ParticleCount,
    }

    fn message(text: &str) -> String {
        Configuration::from_text("c.toml".to_owned(), text.to_owned())
            .and_then(|configuration| configuration.parse::<Example>())
            .unwrap_err()
            .to_string()
    }

    #[test]
    fn bytes_that_are_no_text_are_reported_where_they_are() {
        let directory = tempfile::tempdir().unwrap();
        let file = directory.path().join("c.toml");
        fs::write(&file, b"kind = \"\xff\"\n").unwrap();
        let message = Configuration::read(&file).unwrap_err().to_string();
        assert!(
            message.contains("c.toml, line 1, column 9: what follows is not UTF-8"),
            "{message}"
        );
    }

    #[test]
    fn mistakes_are_reported_where_they_are() {
        let unknown = message("kind = \"a\"\nparticles = 5\n  particle = 3\n");
        assert_eq!(
            unknown,
            "c.toml, line 3, column 3: unknown field `particle`, expected `particles`, `kind`, `threads` (in `particle = 3`)"
        );
        let negative = message("kind = \"a\"\nparticles = -5\n");
        assert_eq!(
            negative,
            "c.toml, line 2, column 13: -5 is out of range: must be from 2 to 100000000 (in `particles = -5`)"
        );
        let broken = message("kind = \"a\"\nparticles = \n");
        assert!(broken.starts_with("c.toml, line 2, "), "{broken}");
        let with_threads = message("particles = -5\nthreads = 2 # two\nkind = 'ä' # kind\n");
        assert!(
            with_threads.starts_with("c.toml, line 1, column 13: -5 is"),
            "{with_threads}"
        );
        let after = message("threads = 2\nkind = 'ä'\nparticles = -5\n");
        assert!(after.starts_with("c.toml, line 3, column 13: -5 is"), "{after}");
        let none = message("threads = 0\nkind = 'ä'\nparticles = 5\n");
        assert!(none.starts_with("c.toml, line 1, column 11: 0 is"), "{none}");
        assert!(message("kind = \"a\"").contains("missing field `particles`"));
        let missing = message("particles = 3");
        assert!(missing.contains("missing field `kind`"), "{missing}");
    }

    #[test]
    fn seeds_and_threads_are_those_of_the_file() {
        let read = |text: &str| Configuration::from_text(String::new(), text.to_owned()).unwrap();
        let one = read("kind = \"a\"\nseed = 3\nthreads = 2");
        assert_eq!((one.threads(), one.seeds), (Some(2), vec![3]));
        let many = read("kind = \"a\"\nseeds = [1, 2]\n[part]\nthreads = 4");
        assert_eq!((many.threads(), many.seeds), (None, vec![1, 2]));
    }

    #[test]
    fn files_of_a_command_are_found_between_quotes_and_signs() {
        let directory = tempfile::tempdir().unwrap();
        let file = |name: &str| {
            let path = directory.path().join(name);
            fs::write(&path, "x").unwrap();
            path.display().to_string()
        };
        let [plain, spaced, given] = ["a.py", "b c.py", "d.csv"].map(file);
        let found = files_in(&format!(
            "python3 {plain} '{spaced}' --data={given}; cat <{given} no-such-file"
        ));
        assert_eq!(found, [&spaced, &plain, &given, &given].map(String::clone));
    }

    #[test]
    fn the_hash_sees_values_and_not_their_looks() {
        let hash = |text: &str| Configuration::from_text(String::new(), text.to_owned()).unwrap().hash;
        assert_eq!(hash("kind = \"a\"\nx = 1 # one"), hash("x=1\nkind = 'a'"));
        assert_ne!(hash("kind = \"a\"\nx = 1"), hash("kind = \"a\"\nx = 2"));
    }
}
