//! Whether a checkpoint is of a scene, or of one that only ends earlier.

use toml::{Table, Value};

use super::Saved;
use crate::Scene;

/// What a run depends on, beside the contents of the mesh's file.
pub fn identity(scene: &Scene) -> String {
    format!("{}\n{}", version(), scene.text)
}

fn version() -> String {
    format!("mpm-scenes {}", env!("CARGO_PKG_VERSION"))
}

/// The end of the run that left a checkpoint, if a run of this scene, whose mesh's file has a fingerprint, may go on from there: title, comments and layout may differ, and the end may be later.
///
/// # Errors
/// What differs otherwise.
pub fn earlier_end(saved: &Saved, scene: &Scene, mesh_contents: Option<u64>) -> Result<f64, String> {
    let another = |what: &str| format!("it belongs to another scene: {what}; remove it or name another directory");
    let same_mesh = match saved.mesh_contents {
        Some(own) if mesh_contents.is_some_and(|contents| contents != own) => {
            Err(another("`mesh.file`: its contents are others than those of the run"))
        }
        _ => Ok(()),
    };
    let Some((program, text)) = saved.identity.split_once('\n') else {
        return Err(another("it does not say of which"));
    };
    if program != version() {
        return Err(another(&format!("it was written by {program}")));
    }
    if text == scene.text {
        return same_mesh.map(|()| scene.time.end);
    }
    let (Some((old, end)), Some((new, _))) = (comparable(text), comparable(&scene.text)) else {
        return Err(another("it cannot be read"));
    };
    if let Some(key) = first_difference(&Value::Table(old), &Value::Table(new)) {
        return Err(another(&format!("`{key}` differs")));
    }
    if scene.time.end < end {
        return Err(another(&format!("its time.end = {end:?} is later")));
    }
    same_mesh.map(|()| end)
}

/// The document without what may differ, and the end.
fn comparable(text: &str) -> Option<(Table, f64)> {
    let mut table: Table = text.parse().ok()?;
    table.remove("title");
    let end = table.get_mut("time")?.as_table_mut()?.remove("end")?;
    let end = end.as_float().or_else(|| end.as_integer().map(|end| end as f64))?;
    Some((table, end))
}

/// The first key, as in `bodies.0.velocity`, whose values differ; numbers are the same if their bits are.
fn first_difference(old: &Value, new: &Value) -> Option<String> {
    let joined = |key: &str, rest: String| match rest.as_str() {
        "" => key.to_owned(),
        rest => format!("{key}.{rest}"),
    };
    match (old, new) {
        (Value::Table(old), Value::Table(new)) => {
            let missing = |key: &&String| !old.contains_key(*key) || !new.contains_key(*key);
            let lone = old.keys().chain(new.keys()).find(missing).cloned();
            let of_both = || {
                let pairs = old.iter().filter_map(|(key, value)| Some((key, value, new.get(key)?)));
                let mut found = pairs.filter_map(|(key, old, new)| Some(joined(key, first_difference(old, new)?)));
                found.next()
            };
            of_both().or(lone)
        }
        (Value::Array(old), Value::Array(new)) if old.len() == new.len() => {
            let pairs = old.iter().zip(new).enumerate();
            let mut found =
                pairs.filter_map(|(place, (old, new))| Some(joined(&place.to_string(), first_difference(old, new)?)));
            found.next()
        }
        (Value::Float(old), Value::Float(new)) => (old.to_bits() != new.to_bits()).then(String::new),
        (old, new) => (old != new).then(String::new),
    }
}
