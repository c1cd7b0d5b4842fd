//! Frames of an earlier run.

use mpm_scenes::output::{names, remove_frames};

#[test]
fn frames_go_and_all_else_stays() {
    let directory = tempfile::tempdir().expect("a directory");
    let kept = [
        "particles_7.vtu",
        "particles_+00007.vtu",
        "particles_000007.vtu.bak",
        "particles_mine.vtu",
        "other_000007.vtu",
        "mesh.pvd",
    ];
    let gone = ["particles_000007.vtu", "particles_1234567.vtu", names::INDEX];
    for name in kept.iter().chain(&gone) {
        std::fs::write(directory.path().join(name), name).expect("writable");
    }
    remove_frames(directory.path()).expect("removable");
    assert!(kept.iter().all(|name| directory.path().join(name).exists()));
    assert!(!gone.iter().any(|name| directory.path().join(name).exists()));
    assert!(remove_frames(&directory.path().join("none")).is_ok());
}
