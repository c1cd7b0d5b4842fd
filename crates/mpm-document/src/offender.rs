//! Where the value is that a table was refused for: a table with a tag is read as a whole, and has forgotten where its values stand.

use std::ops::Range;

use serde::de::DeserializeOwned;
use toml::de::{DeTable, DeValue};
use toml::{Spanned, Value};

/// A step from a table or an array to what is in it.
enum Step {
    Key(String),
    Index(usize),
}

/// Where the refused value begins, or the unknown key, within the table or array at `span`; `None` where none is at fault, as with a missing key.
///
/// What can be left out while the message stays is not at fault.
pub(crate) fn offender<T: DeserializeOwned>(text: &str, span: &Range<usize>) -> Option<usize> {
    let document = DeTable::parse(text).ok()?;
    let mut path = Vec::new();
    if !find(document.get_ref(), span, &mut path) {
        return None;
    }
    // As a text again: `T` is then read in one way, and compiled once.
    let refusal = |value: &Value| {
        let error = toml::from_str::<T>(&toml::to_string(value).ok()?).err()?;
        Some(error.message().to_owned())
    };
    let values = Value::Table(text.parse().ok()?);
    let message = refusal(&values)?;
    if message.starts_with("missing field") {
        return None;
    }
    let outer = path.len();
    let mut search = Search {
        values,
        path,
        message,
        refusal: &refusal,
    };
    while search.descend() {}
    let found = search.path.len() > outer;
    let of_key = search.message.starts_with("unknown field");
    found.then(|| begin(document.get_ref(), &search.path, of_key)).flatten()
}

/// The part of a document that is refused with the message of the whole.
struct Search<'a> {
    values: Value,
    path: Vec<Step>,
    message: String,
    refusal: &'a dyn Fn(&Value) -> Option<String>,
}

impl Search<'_> {
    /// Goes to the entry at fault; whether there may be one within it.
    fn descend(&mut self) -> bool {
        let child = match inner(&mut self.values, &self.path) {
            Some(Value::Table(table)) => {
                let keys: Vec<String> = table.keys().rev().cloned().collect();
                self.in_table(keys).map(Step::Key)
            }
            Some(Value::Array(entries)) => {
                let count = entries.len();
                self.in_array(count).map(Step::Index)
            }
            _ => None,
        };
        let Some(child) = child else { return false };
        let is_unknown = matches!(&child, Step::Key(key) if self.names("unknown field", key));
        self.path.push(child);
        !is_unknown
    }

    /// Leaves out what the message does not need: the last entry of the shortest beginning is at fault.
    fn in_array(&mut self, count: usize) -> Option<usize> {
        let (mut sound, mut refused) = (0, count);
        if count == 0 || self.is_refused(&self.truncated(0)) {
            return None;
        }
        while refused - sound > 1 {
            let middle = sound.midpoint(refused);
            let shorter = self.truncated(middle);
            if self.is_refused(&shorter) {
                refused = middle;
            } else {
                sound = middle;
            }
        }
        self.values = self.truncated(refused);
        Some(refused - 1)
    }

    /// Leaves out what the message does not need: the tag stays, and the key at fault.
    fn in_table(&mut self, keys: Vec<String>) -> Option<String> {
        let mut kept = Vec::new();
        for key in keys {
            let without = self.changed(|own| {
                if let Value::Table(table) = own {
                    table.remove(&key);
                }
            });
            if self.is_refused(&without) {
                self.values = without;
            } else {
                kept.push(key);
            }
        }
        if kept.len() == 1 {
            return kept.pop();
        }
        let named = |key: &&String| self.names("unknown field", key) || self.is_unknown_variant(key);
        let named = kept.iter().find(named).cloned();
        named.or_else(|| kept.into_iter().find(|key| !self.is_tag(key)))
    }

    /// Whether the message begins with these words and a name.
    fn names(&self, words: &str, name: &str) -> bool {
        self.message.starts_with(&format!("{words} `{name}`"))
    }

    /// Whether it is the word in the place of this key that is none of those expected.
    fn is_unknown_variant(&self, key: &str) -> bool {
        let mut values = self.values.clone();
        let own = inner(&mut values, &self.path).and_then(|own| own.get(key)?.as_str());
        own.is_some_and(|word| self.names("unknown variant", word))
    }

    /// Whether the key says which keys there are.
    fn is_tag(&self, key: &str) -> bool {
        const WORD: &str = "?";
        let other = self.changed(|own| {
            if let Value::Table(table) = own {
                table.insert(key.to_owned(), Value::String(WORD.to_owned()));
            }
        });
        let message = (self.refusal)(&other).unwrap_or_default();
        message.starts_with(&format!("unknown variant `{WORD}`"))
    }

    fn is_refused(&self, values: &Value) -> bool {
        (self.refusal)(values).as_ref() == Some(&self.message)
    }

    fn truncated(&self, length: usize) -> Value {
        self.changed(|own| {
            if let Value::Array(entries) = own {
                entries.truncate(length);
            }
        })
    }

    /// The document with a change at the path.
    fn changed(&self, change: impl FnOnce(&mut Value)) -> Value {
        let mut values = self.values.clone();
        if let Some(own) = inner(&mut values, &self.path) {
            change(own);
        }
        values
    }
}

/// What is at a path.
fn inner<'a>(values: &'a mut Value, path: &[Step]) -> Option<&'a mut Value> {
    path.iter().try_fold(values, |own, step| match step {
        Step::Key(key) => own.get_mut(key.as_str()),
        Step::Index(index) => own.get_mut(*index),
    })
}

/// Extends the path to the table or array with this span; whether there is one.
fn find(table: &DeTable<'_>, span: &Range<usize>, path: &mut Vec<Step>) -> bool {
    table.iter().any(|(key, value)| {
        path.push(Step::Key(key.get_ref().to_string()));
        let found = find_in(value, span, path);
        if !found {
            path.pop();
        }
        found
    })
}

fn find_in(value: &Spanned<DeValue<'_>>, span: &Range<usize>, path: &mut Vec<Step>) -> bool {
    match value.get_ref() {
        DeValue::Table(table) => value.span() == *span || find(table, span, path),
        DeValue::Array(entries) => {
            let within = |(index, entry)| {
                path.push(Step::Index(index));
                let found = find_in(entry, span, path);
                if !found {
                    path.pop();
                }
                found
            };
            value.span() == *span || entries.iter().enumerate().any(within)
        }
        _ => false,
    }
}

/// The first byte of what a path leads to, or of the key before it.
fn begin(table: &DeTable<'_>, path: &[Step], of_key: bool) -> Option<usize> {
    let (Step::Key(first), rest) = path.split_first()? else {
        return None;
    };
    let (mut key, mut value) = entry(table, first)?;
    for step in rest {
        (key, value) = match (step, value.get_ref()) {
            (Step::Key(name), DeValue::Table(table)) => entry(table, name)?,
            (Step::Index(index), DeValue::Array(entries)) => {
                let entry = entries.get(*index)?;
                (entry.span(), entry)
            }
            _ => return None,
        };
    }
    Some(if of_key { key.start } else { value.span().start })
}

/// Where a key is, and its value.
fn entry<'a, 'i>(table: &'a DeTable<'i>, name: &str) -> Option<(Range<usize>, &'a Spanned<DeValue<'i>>)> {
    let (key, value) = table.iter().find(|(key, _)| key.get_ref() == name)?;
    Some((key.span(), value))
}
