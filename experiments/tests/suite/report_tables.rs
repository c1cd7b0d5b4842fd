//! The tables of report.md ask for nothing that no study has: a column that is misspelt would be a dash in every line.

use std::path::Path;

/// What stands in the places of a text, those within others as `_`, after these.
fn places(text: &str) -> Vec<String> {
    let mut open: Vec<String> = Vec::new();
    let mut closed = Vec::new();
    for c in text.chars() {
        match (c, open.last_mut()) {
            ('{', outer) => {
                outer.into_iter().for_each(|outer| outer.push('_'));
                open.push(String::new());
            }
            ('}', _) => closed.extend(open.pop()),
            (c, Some(place)) => place.push(c),
            (_, None) => {}
        }
    }
    closed
}

/// The columns that a statistic is of and under which conditions.
fn columns(statistic: &str) -> Vec<&str> {
    let mut parts = statistic.split(" where ");
    let first = parts.next().unwrap_or_default();
    let own = first
        .rsplit(' ')
        .next()
        .filter(|name| !["rows", "share"].contains(name));
    let conditions = parts.flat_map(|part| {
        let words: Vec<&str> = part.strip_prefix("no ").unwrap_or(part).split(' ').collect();
        // What is compared by size is a number or another column.
        let other = match words[..] {
            [_, "≤" | ">" | "≥", other] if other.parse::<f64>().is_err() => Some(other),
            _ => None,
        };
        [words.first().copied(), other]
    });
    let named = own.into_iter().chain(conditions.flatten());
    named.filter(|name| *name != "_").collect()
}

fn sources(directory: &Path) -> String {
    let files = std::fs::read_dir(directory).unwrap().map(|entry| entry.unwrap().path());
    let sources = files.filter(|path| path.extension().is_some_and(|extension| extension == "rs"));
    sources.map(|path| std::fs::read_to_string(path).unwrap()).collect()
}

#[test]
fn tables_ask_for_what_there_is() {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let studies = here.join("src/study");
    let of_all = sources(&studies)
        + &["page", "judgement"]
            .map(|part| sources(&here.join("../crates/parvi-plot/src").join(part)))
            .concat();
    let mut tables = 0;
    for directory in std::fs::read_dir(&studies).unwrap().map(|entry| entry.unwrap().path()) {
        let Ok(prose) = std::fs::read_to_string(directory.join("report.md")) else {
            continue;
        };
        let source = sources(&directory) + &of_all;
        let is_known = |name: &str| {
            source
                .split(|c: char| !c.is_alphanumeric() && c != '_')
                .any(|word| word == name)
        };
        for line in prose.lines() {
            let is_table = line.starts_with("| ");
            tables += usize::from(is_table);
            // Prose has values of the configuration as well, whose keys are single words.
            for place in places(line).into_iter().filter(|place| is_table || place.contains(' ')) {
                let is_named = source.contains(&format!("\"{}", place.replace('_', "{")))
                    || source.contains(&format!("\"{place}\""));
                let unknown = columns(&place).into_iter().find(|column| !is_known(column));
                assert!(
                    is_named || unknown.is_none(),
                    "{}: {place}: {unknown:?}",
                    directory.display()
                );
            }
        }
    }
    assert!(tables > 50, "{tables}");
    assert_eq!(places("{a} of {b where c = {d}}"), ["a", "d", "b where c = _"]);
    assert_eq!(columns("median b where no c where d ≤ _"), ["b", "c", "d"]);
    assert_eq!(
        columns("b where c > d where e = f where g ≤ 1"),
        ["b", "c", "d", "e", "g"]
    );
}
