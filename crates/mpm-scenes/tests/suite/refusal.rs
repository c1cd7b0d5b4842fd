//! What `parvi simulate` says of a scene that it refuses.

use std::ops::ControlFlow;
use std::path::Path;

use mpm_scenes::{Scene, simulate};

/// Asserts what is said of a good scene, read from `file`, with one text replaced: each row of the table `refused` has the text, what stands in its place and
/// the parts of the error, which begins with the file unless a step has failed.
pub fn assert_refused(scene: &str, file: &str, table: &str) {
    let table: toml::Table = table.parse().expect("TOML");
    let rows: Vec<Vec<String>> = table["refused"].clone().try_into().expect("rows of texts");
    for row in &rows {
        let [from, to, expected @ ..] = row.as_slice() else {
            panic!("{row:?}");
        };
        let message = refusal(scene, file, from, to);
        for part in expected {
            assert!(message.contains(part), "{to}: {message}\nlacks {part}");
        }
        let after = message.strip_prefix(file);
        let begins = after.is_some_and(|rest| rest.starts_with([':', ',']));
        assert!(begins || message.contains("step 1"), "{message}");
    }
}

fn refusal(scene: &str, file: &str, from: &str, to: &str) -> String {
    assert!(scene.contains(from), "{from}");
    let text = scene.replacen(from, to, 1);
    match Scene::parse(&text, Path::new(file)) {
        Err(error) => error.to_string(),
        Ok(scene) => {
            let directory = tempfile::tempdir().expect("a directory");
            let stop = &mut |_| ControlFlow::Break(());
            match simulate(&scene, directory.path(), stop) {
                Err(error) => error.to_string(),
                Ok(_) => panic!("{to}: accepted"),
            }
        }
    }
}
