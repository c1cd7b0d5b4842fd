//! Values at dotted keys.

use toml::{Table, Value};

/// Puts a value where a dotted key says; what was there is replaced, tables as a whole. Tables on the way that do not exist are made, elements of
/// arrays have to be there.
///
/// # Errors
/// What is in the way, in words.
pub fn put(scene: &mut Table, key: &str, value: Value) -> Result<(), String> {
    let (first, rest) = split(key);
    match rest {
        None => {
            scene.insert(first.to_owned(), value);
            Ok(())
        }
        Some(rest) => {
            let inner = scene.entry(first).or_insert_with(|| Value::Table(Table::new()));
            put_within(inner, first, rest, value)
        }
    }
}

fn put_within(place: &mut Value, name: &str, key: &str, value: Value) -> Result<(), String> {
    match place {
        Value::Table(table) => put(table, key, value),
        Value::Array(elements) => {
            let (first, rest) = split(key);
            let count = elements.len();
            let index = first.parse::<usize>().ok();
            let element = index.and_then(|index| elements.get_mut(index));
            let element =
                element.ok_or_else(|| format!("`{name}` has elements 0 to {}, not `{first}`", count as i64 - 1))?;
            match rest {
                None => {
                    *element = value;
                    Ok(())
                }
                Some(rest) => put_within(element, first, rest, value),
            }
        }
        _ => Err(format!("`{name}` is neither a table nor an array")),
    }
}

/// Removes what is at a dotted key, of tables in arrays, too; nothing where there is nothing, and no element of an array, whose others would have other numbers.
pub fn remove(scene: &mut Table, key: &str) {
    match split(key) {
        (name, None) => drop(scene.remove(name)),
        (first, Some(rest)) => {
            if let Some(inner) = scene.get_mut(first) {
                remove_within(inner, rest);
            }
        }
    }
}

fn remove_within(place: &mut Value, key: &str) {
    match place {
        Value::Table(table) => remove(table, key),
        Value::Array(elements) => {
            let (first, rest) = split(key);
            let element = first.parse::<usize>().ok().and_then(|index| elements.get_mut(index));
            if let (Some(element), Some(rest)) = (element, rest) {
                remove_within(element, rest);
            }
        }
        _ => {}
    }
}

/// The number at a dotted key.
pub fn number(scene: &Table, key: &str) -> Option<f64> {
    let mut names = key.split('.');
    let first = scene.get(names.next()?)?;
    match names.try_fold(first, |place, name| match place.as_array() {
        Some(elements) => elements.get(name.parse::<usize>().ok()?),
        None => place.get(name),
    })? {
        Value::Float(value) => Some(*value),
        Value::Integer(value) => Some(*value as f64),
        _ => None,
    }
}

/// Puts a value in the place of one at a dotted key.
///
/// # Errors
/// What there is not, in words.
pub fn exchange(scene: &mut Table, key: &str, value: Value) -> Result<(), String> {
    let missing = |holder: &str, name: &str| format!("{holder} has no `{name}`");
    let (mut holder, rest) = split(key);
    let first = scene.get_mut(holder).ok_or_else(|| missing("the scene", holder))?;
    let names = rest.into_iter().flat_map(|rest| rest.split('.'));
    let mut place = first;
    for name in names {
        let found = match place {
            Value::Array(elements) => name.parse::<usize>().ok().and_then(|index| elements.get_mut(index)),
            other => other.get_mut(name),
        };
        place = found.ok_or_else(|| missing(holder, name))?;
        holder = name;
    }
    *place = value;
    Ok(())
}

/// The first part of a key, and what follows its dot.
fn split(key: &str) -> (&str, Option<&str>) {
    match key.split_once('.') {
        Some((first, rest)) => (first, Some(rest)),
        None => (key, None),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene() -> Table {
        "grid = { spacing = 1.0 }\nbodies = [{ shape = { upper = [1, 2.0] } }]"
            .parse()
            .expect("TOML")
    }

    #[test]
    fn what_was_put_is_found() {
        let mut scene = scene();
        for (key, value) in [
            ("grid.spacing", 0.5),
            ("bodies.0.shape.upper.1", 7.0),
            ("time.end", 3.0),
        ] {
            put(&mut scene, key, Value::Float(value)).expect("a place");
            assert_eq!(number(&scene, key), Some(value), "{key}");
        }
        assert_eq!(number(&scene, "bodies.0.shape.upper.0"), Some(1.0));
        put(
            &mut scene,
            "grid",
            Value::Table("basis = \"cubic\"".parse().expect("TOML")),
        )
        .expect("a place");
        assert_eq!(number(&scene, "grid.spacing"), None);
        assert_eq!(number(&scene, "bodies.0.shape.upper.9"), None);
        assert_eq!(number(&scene, "bodies.0.shape"), None);
    }

    #[test]
    fn what_was_removed_is_gone() {
        let mut scene = scene();
        for key in ["grid.basis", "walls.0", "bodies.0", "time.end"] {
            remove(&mut scene, key);
        }
        assert_eq!(number(&scene, "grid.spacing"), Some(1.0));
        assert_eq!(number(&scene, "bodies.0.shape.upper.0"), Some(1.0));
        remove(&mut scene, "grid.spacing");
        assert_eq!(number(&scene, "grid.spacing"), None);
        remove(&mut scene, "bodies.0.shape.upper");
        assert_eq!(number(&scene, "bodies.0.shape.upper.0"), None);
        remove(&mut scene, "bodies");
        assert!(!scene.contains_key("bodies"));
    }

    #[test]
    fn what_is_in_the_way_is_named() {
        let mut scene = scene();
        let mut message = |key: &str| put(&mut scene, key, Value::Float(0.0)).expect_err("in the way");
        assert_eq!(message("bodies.1.shape"), "`bodies` has elements 0 to 0, not `1`");
        assert_eq!(message("bodies.first"), "`bodies` has elements 0 to 0, not `first`");
        assert_eq!(message("grid.spacing.x"), "`spacing` is neither a table nor an array");
    }
}
