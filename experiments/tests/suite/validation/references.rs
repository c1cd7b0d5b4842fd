//! What the committed scenes are held against.

use std::path::Path;

use mpm_scenes::Scene;
use mpm_scenes::reference::references;

/// The committed scenes with their references.
fn with_references() -> Vec<(Scene, String)> {
    let directory = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let files = std::fs::read_dir(directory)
        .expect("there")
        .map(|entry| entry.expect("readable").path());
    let scenes = files
        .filter(|file| file.extension().is_some_and(|extension| extension == "toml"))
        .map(|file| Scene::read(file).expect("a scene with a reference that fits"));
    scenes
        .filter_map(|scene| Some((scene.clone(), scene.validation?.reference)))
        .collect()
}

#[test]
fn a_reference_is_for_scenes_of_its_own_problem() {
    let kind = |name: &str| match name {
        "umls-disks" => "two-disks".to_owned(),
        "umls-square" => "conservation".to_owned(),
        "umls-bar" => "vibrating-bar".to_owned(),
        name if name.contains("cantilever") => "cantilever".to_owned(),
        name => name.to_owned(),
    };
    let scenes = with_references();
    assert_eq!(scenes.len(), 23);
    for (scene, own) in &scenes {
        for other in references().iter().filter(|other| kind(other) != kind(own)) {
            // Momenta are kept in every plane scene that nothing pulls.
            if kind(other) == "conservation" {
                continue;
            }
            let text = scene
                .text
                .replace(&format!("reference = \"{own}\""), &format!("reference = \"{other}\""));
            let error = Scene::parse(&text, &scene.file)
                .map(drop)
                .expect_err(&format!("{own} by {other}"));
            let expected = format!("validation.reference = \"{other}\": must be one for this scene: {other} is for ");
            assert!(error.to_string().contains(&expected), "{error}");
        }
    }
}
