#![doc = include_str!("../README.md")]

mod appended;
mod collection;

pub use appended::Appended;
pub use collection::collection;

/// Text as the value of an attribute.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}
