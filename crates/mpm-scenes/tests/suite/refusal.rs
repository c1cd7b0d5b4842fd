//! What `parvi simulate` says of a scene that it refuses.

use std::ops::ControlFlow;
use std::path::Path;

use mpm_scenes::{Scene, simulate};

/// The error of a good scene, read from `file`, with one text replaced.
pub fn refusal(scene: &str, file: &str, from: &str, to: &str) -> String {
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
