//! Values as a TOML file has them, for messages.

use serde::Serialize;
use toml::Value;

/// The value on one line; `None` for what TOML has no word for, which is what is not there.
pub(crate) fn text(value: impl Serialize) -> Option<String> {
    Value::try_from(value).ok().map(|value| written(&value))
}

fn written(value: &Value) -> String {
    match value {
        // Two digits of an exponent rather than three hundred zeros.
        Value::Float(number) if number.is_finite() => format!("{number:?}"),
        Value::Array(entries) => {
            let entries: Vec<String> = entries.iter().map(written).collect();
            format!("[{}]", entries.join(", "))
        }
        Value::Table(table) => {
            // What a table is comes first.
            let (kind, rest): (Vec<_>, Vec<_>) = table.iter().partition(|(key, _)| *key == "kind");
            let pairs = kind.into_iter().chain(rest);
            let pairs: Vec<String> = pairs
                .map(|(key, value)| format!("{key} = {}", written(value)))
                .collect();
            format!("{{ {} }}", pairs.join(", "))
        }
        plain => plain.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::text;
    use crate::scene::ShapeTable;

    #[test]
    fn values_are_written_as_in_a_file() {
        assert_eq!(text(1e300).as_deref(), Some("1e300"));
        assert_eq!(text(f64::NAN).as_deref(), Some("nan"));
        assert_eq!(text(["a", "b\"c"]).as_deref(), Some("[\"a\", 'b\"c']"));
        assert_eq!(text(None::<f64>), None);
        let shape = ShapeTable::Sphere {
            centre: vec![0.0],
            radius: 1.5,
        };
        let expected = "{ kind = \"sphere\", centre = [0.0], radius = 1.5 }";
        assert_eq!(text(Some(&shape)).as_deref(), Some(expected));
    }
}
