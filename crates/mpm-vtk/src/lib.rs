#![doc = include_str!("../README.md")]

mod appended;
mod collection;

pub use appended::Appended;
pub use collection::collection;

/// Text as the value of an attribute. Line ends and tabs stay what they are; control characters that no XML holds are replaced.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '"' => escaped.push_str("&quot;"),
            '\t' => escaped.push_str("&#9;"),
            '\n' => escaped.push_str("&#10;"),
            '\r' => escaped.push_str("&#13;"),
            '\u{0}'..'\u{20}' | '\u{fffe}' | '\u{ffff}' => escaped.push(char::REPLACEMENT_CHARACTER),
            other => escaped.push(other),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_name_is_an_attribute_of_xml() {
        assert_eq!(escaped("a<b>&\"é\" 漢"), "a&lt;b>&amp;&quot;é&quot; 漢");
        assert_eq!(escaped("1\n2\t3\r"), "1&#10;2&#9;3&#13;");
        assert_eq!(escaped("\u{0}\u{1f}\u{ffff}"), "\u{fffd}\u{fffd}\u{fffd}");
        assert_eq!(escaped("\u{20}\u{7f}"), "\u{20}\u{7f}");
    }
}
