//! A run that was stopped goes on to the same bits.

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::path::Path;

use mpm_mesh::generate::{EdgeTarget, rectangle};
use mpm_mesh::{MshFormat, write_msh};
use mpm_scenes::{Outcome, Progress, Scene, simulate};

use super::nonlocal;
use super::scenes::{BAR, BLOCK, BLOCK_ON_MESH, CUBE, HEAPS, RUBBER_ON_MESH, scene};

/// All files of a directory.
fn files(directory: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = std::fs::read_dir(directory)
        .expect("there")
        .map(|entry| entry.expect("readable").path());
    let name = |path: &Path| path.file_name().expect("a name").to_string_lossy().into_owned();
    entries
        .map(|path| (name(&path), std::fs::read(&path).expect("readable")))
        .collect()
}

fn break_if(stop: bool) -> ControlFlow<()> {
    if stop {
        ControlFlow::Break(())
    } else {
        ControlFlow::Continue(())
    }
}

#[test]
fn a_stopped_run_ends_with_the_files_of_one_that_was_not() {
    let accounted = BLOCK.replace("[output]", "[output]\nenergy_budget = true");
    let accounted = accounted.replace("gap = 0.02", "gap = 0.02\nintegration = \"implicit\"");
    let nonlocal = nonlocal::BLOCK.replace("SPACING", "0.2");
    let nonlocal = nonlocal.replace("RADIUS", ", nonlocal_radius = 0.4");
    for text in [BAR, BLOCK, HEAPS, CUBE, BLOCK_ON_MESH, &accounted, &nonlocal] {
        let scene = scene(text);
        let (whole, parts) = (
            tempfile::tempdir().expect("a directory"),
            tempfile::tempdir().expect("a directory"),
        );
        let summary = simulate(&scene, whole.path(), &mut ()).expect("runs");
        // Stopped after every so many steps, wherever that is between two events.
        let every = summary.steps / 4 + 1;
        let mut stops = 0;
        let resumed = loop {
            let stop = &mut |progress: Progress| break_if(progress.step.is_multiple_of(every));
            let part = simulate(&scene, parts.path(), stop).expect("runs");
            if part.outcome == Outcome::Finished {
                break part;
            }
            stops += 1;
        };
        assert_eq!((stops, resumed.steps), ((summary.steps - 1) / every, summary.steps));
        assert!(resumed.resumed_at.is_some() && resumed.steps_here < summary.steps);
        let (whole, parts) = (files(whole.path()), files(parts.path()));
        assert!(whole.keys().eq(parts.keys()));
        for (name, content) in &whole {
            assert!(parts[name] == *content, "{}: {name} differs", scene.title);
        }
    }
}

#[test]
fn a_run_anew_leaves_nothing_of_a_longer_one() {
    let (long, short) = (scene(BLOCK), scene(&BLOCK.replace("end = 0.2", "end = 0.1")));
    let (used, fresh) = (
        tempfile::tempdir().expect("a directory"),
        tempfile::tempdir().expect("a directory"),
    );
    simulate(&long, used.path(), &mut ()).expect("runs");
    std::fs::remove_file(used.path().join("checkpoint.cbor")).expect("there");
    let own = used.path().join("notes.txt");
    std::fs::write(&own, "mine").expect("writable");
    simulate(&short, used.path(), &mut ()).expect("runs");
    simulate(&short, fresh.path(), &mut ()).expect("runs");
    assert_eq!(std::fs::read(&own).expect("still there"), b"mine");
    std::fs::remove_file(own).expect("there");
    assert!(files(used.path()).keys().eq(files(fresh.path()).keys()));
}

#[test]
#[cfg(unix)]
fn two_processes_do_not_write_into_one_directory() {
    let directory = tempfile::tempdir().expect("a directory");
    let other = mpm_document::claim(directory.path()).expect("free").expect("a lock");
    let error = simulate(&scene(BAR), directory.path(), &mut ()).expect_err("taken");
    assert!(
        error
            .to_string()
            .ends_with("another process writes into this directory"),
        "{error}"
    );
    assert!(files(directory.path()).is_empty());
    drop(other);
    simulate(&scene(BAR), directory.path(), &mut ()).expect("runs");
}

#[test]
fn a_run_that_was_killed_goes_on_from_its_last_checkpoint() {
    let scene = scene(BLOCK);
    let (whole, killed) = (
        tempfile::tempdir().expect("a directory"),
        tempfile::tempdir().expect("a directory"),
    );
    simulate(&scene, whole.path(), &mut ()).expect("runs");
    // What a process killed between two checkpoints leaves: a checkpoint older than series and frames.
    let mut old = None;
    let checkpoint = killed.path().join("checkpoint.cbor");
    let stop = &mut |progress: Progress| {
        if old.is_none() && progress.time > 0.05 {
            old = std::fs::read(&checkpoint).ok();
        }
        break_if(progress.time > 0.16)
    };
    simulate(&scene, killed.path(), stop).expect("runs");
    std::fs::write(&checkpoint, old.expect("one at t = 0.04")).expect("writable");
    let summary = simulate(&scene, killed.path(), &mut ()).expect("runs");
    assert_eq!(summary.resumed_at, Some(0.04));
    assert!(files(whole.path()) == files(killed.path()));
}

#[test]
fn a_row_that_is_cut_out_is_missed() {
    let scene = scene(BLOCK);
    let directory = tempfile::tempdir().expect("a directory");
    let stop = &mut |progress: Progress| break_if(progress.time > 0.1);
    simulate(&scene, directory.path(), stop).expect("runs");
    let path = directory.path().join("series.csv");
    let whole = std::fs::read_to_string(&path).expect("there");
    // A row that the process wrote after its last checkpoint does not make up for the one that is missing.
    let without: Vec<&str> = whole
        .lines()
        .enumerate()
        .filter(|(index, _)| *index != 4)
        .map(|(_, line)| line)
        .collect();
    let cut = without.join("\n") + "\n" + whole.lines().last().expect("a row") + "\n";
    std::fs::write(&path, &cut).expect("writable");
    let message = simulate(&scene, directory.path(), &mut ())
        .expect_err("a gap")
        .to_string();
    let expected = format!("{}, line 5: time = 0.04 is not that of row 3", path.display());
    assert!(message.starts_with(&expected), "{message}");
    assert_eq!(std::fs::read_to_string(&path).expect("there"), cut);
    std::fs::write(&path, &whole).expect("writable");
    simulate(&scene, directory.path(), &mut ()).expect("goes on");
}

/// Up to one end and on to a later one, which is another title's: the files of a run to the later end at once, but for the scene's.
#[test]
fn a_run_goes_on_to_a_later_end() {
    for (text, first, last) in [(BLOCK, "end = 0.1", "end = 0.2"), (BLOCK_ON_MESH, "", "")] {
        let (first, last) = match first {
            "" => (end_of(text, 0.5), end_of(text, 1.0)),
            first => (text.replace(last, first), text.to_owned()),
        };
        let (whole, parts) = (
            tempfile::tempdir().expect("a directory"),
            tempfile::tempdir().expect("a directory"),
        );
        let summary = simulate(&scene(&last), whole.path(), &mut ()).expect("runs");
        let renamed = first.replacen("title = \"", "title = \"earlier, ", 1) + "\n# and a word\n";
        let earlier = simulate(&scene(&renamed), parts.path(), &mut ()).expect("runs");
        std::fs::write(parts.path().join("validation.csv"), "of the earlier end").expect("writable");
        let later = simulate(&scene(&last), parts.path(), &mut ()).expect("goes on");
        assert_eq!((later.steps, later.resumed_at), (summary.steps, Some(earlier.time)));
        let (whole, parts) = (files(whole.path()), files(parts.path()));
        assert!(whole.keys().eq(parts.keys()), "{:?}", parts.keys());
        for (name, content) in &whole {
            assert!(parts[name] == *content, "{name} differs");
        }
    }
}

/// A scene with a share of its end.
fn end_of(text: &str, share: f64) -> String {
    let end = scene(text).time.end;
    let line = text.lines().find(|line| line.starts_with("end = ")).expect("an end");
    text.replace(line, &format!("end = {:?}", share * end))
}

/// An end that no output is at leaves no row and no frame of its own behind.
#[test]
fn an_end_between_outputs_is_forgotten() {
    let directory = tempfile::tempdir().expect("a directory");
    simulate(
        &scene(&BLOCK.replace("end = 0.2", "end = 0.103")),
        directory.path(),
        &mut (),
    )
    .expect("runs");
    let later = simulate(&scene(BLOCK), directory.path(), &mut ()).expect("goes on");
    assert_eq!((later.resumed_at, later.time), (Some(0.103), 0.2));
    let series = mpm_scenes::output::read_series(directory.path()).expect("written");
    let times = series.column("time").expect("a column");
    assert_eq!(times.len(), 21);
    assert!(
        times
            .iter()
            .enumerate()
            .all(|(k, t)| (t - 0.01 * k as f64).abs() < 1e-12),
        "{times:?}"
    );
    let whole = tempfile::tempdir().expect("a directory");
    simulate(&scene(BLOCK), whole.path(), &mut ()).expect("runs");
    assert!(files(directory.path()).keys().eq(files(whole.path()).keys()));
}

#[test]
fn what_a_later_end_may_not_come_with_is_named() {
    let directory = tempfile::tempdir().expect("a directory");
    simulate(&scene(BLOCK), directory.path(), &mut ()).expect("runs");
    for (from, to, expected) in [
        ("end = 0.2", "end = 0.3\ncourant = 0.2", "`time.courant` differs"),
        (
            "velocity = [1.0, 0.0]",
            "velocity = [1.5, 0.0]",
            "`bodies.0.velocity.0` differs",
        ),
        ("interval = 0.05", "interval = 0.1", "`output.interval` differs"),
        ("end = 0.2", "end = 0.1", "its time.end = 0.2 is later"),
    ] {
        assert!(BLOCK.contains(from), "{from}");
        let other = scene(&BLOCK.replacen(from, to, 1));
        let message = simulate(&other, directory.path(), &mut ()).expect_err(to).to_string();
        assert!(message.contains(expected), "{message}");
        assert!(message.contains("it belongs to another scene"), "{message}");
    }
}

/// The mesh of a scene is in a file of its own.
#[test]
fn another_mesh_under_the_same_name_is_refused() {
    let directory = tempfile::tempdir().expect("a directory");
    let (file, out) = (directory.path().join("square.msh"), directory.path().join("out"));
    let made = "generate = { kind = \"rectangle\", lower = [0.0, 0.0], upper = [1.0, 1.0], size = 0.2 }";
    let text = RUBBER_ON_MESH.replace(made, "file = \"square.msh\"");
    assert_ne!(text, RUBBER_ON_MESH);
    let write = |length: f64| {
        let target = EdgeTarget { length, angle: 0.0 };
        let mesh = rectangle([0.0; 2], [1.0; 2], &target).expect("a mesh");
        std::fs::write(&file, write_msh(&mesh, MshFormat::Text22)).expect("writable");
    };
    write(0.2);
    let scene = |end: f64| {
        let text = text.replace("end = 0.1", &format!("end = {end:?}"));
        Scene::parse(&text, &directory.path().join("scene.toml")).expect("sound")
    };
    simulate(&scene(0.1), &out, &mut ()).expect("runs");
    simulate(&scene(0.1), &out, &mut ()).expect("is finished");
    write(0.25);
    for end in [0.1, 0.15] {
        let message = simulate(&scene(end), &out, &mut ())
            .expect_err("another mesh")
            .to_string();
        let expected = "it belongs to another scene: `mesh.file`: its contents are others than those of the run";
        assert!(message.contains(expected), "{message}");
    }
    write(0.2);
    simulate(&scene(0.15), &out, &mut ()).expect("goes on");
}

#[test]
fn checkpoints_of_other_scenes_and_damaged_ones_are_refused() {
    let directory = tempfile::tempdir().expect("a directory");
    simulate(&scene(BAR), directory.path(), &mut ()).expect("runs");
    let other = BAR.replace("courant = 0.2", "courant = 0.25");
    let message = simulate(&scene(&other), directory.path(), &mut ())
        .expect_err("another scene")
        .to_string();
    assert!(message.contains("another scene"), "{message}");
    let path = directory.path().join("checkpoint.cbor");
    let mut bytes = std::fs::read(&path).expect("there");
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    std::fs::write(&path, bytes).expect("writable");
    let message = simulate(&scene(BAR), directory.path(), &mut ())
        .expect_err("damaged")
        .to_string();
    assert!(message.contains("damaged"), "{message}");
}
