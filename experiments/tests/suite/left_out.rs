//! The sampler alone: what it says of the commands that it lacks.

use crate::support::{assert_refused, parvi, stderr};

#[test]
fn commands_that_are_left_out_name_their_feature() {
    let root = tempfile::tempdir().unwrap();
    for (line, feature) in [
        ("simulate scene.toml --out out", "mechanics"),
        ("rom train rom.toml --out out", "rom"),
        ("sample --target gaussian --dim 2 --particles 10 --out out.npy", "npy"),
        (
            "sample --target gaussian --dim 2 --particles 10 --frames out --out out.csv",
            "npy",
        ),
    ] {
        let output = parvi(root.path(), line);
        assert_refused(
            &output,
            &["built without", &format!("cargo build --features {feature}")],
        );
    }
    std::fs::write(root.path().join("scenes.toml"), "kind = \"scenes\"\n").unwrap();
    let output = parvi(root.path(), "run scenes.toml --out out");
    assert!(
        stderr(&output).contains("a study of scenes: built without mechanics"),
        "{}",
        stderr(&output)
    );
    assert!(!root.path().join("out").exists());
}
