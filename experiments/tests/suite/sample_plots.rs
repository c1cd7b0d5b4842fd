//! `parvi sample --plots`: pictures of every method's particles.

use std::path::Path;

use crate::support::{files, parvi, stderr, value, write_responses};

fn drawn(root: &Path, flags: &str) -> (Vec<String>, String) {
    let output = parvi(root, &format!("sample {flags} --out x.csv --plots p"));
    assert!(output.status.success(), "{flags}: {}", stderr(&output));
    let names = files(&root.join("p"));
    let mut said: Vec<String> = value(&output, "plots").unwrap().split(',').map(str::to_owned).collect();
    said.sort();
    assert_eq!(said, names, "{flags}");
    for name in &names {
        let svg = std::fs::read_to_string(root.join("p").join(name)).unwrap();
        assert!(svg.starts_with("<svg") && svg.ends_with("</svg>\n"), "{flags}: {name}");
        assert!(!svg.contains("NaN") && !svg.contains("inf\""), "{flags}: {name}");
    }
    (names, stderr(&output))
}

fn text(root: &Path, name: &str) -> String {
    std::fs::read_to_string(root.join("p").join(name)).unwrap()
}

#[test]
fn every_method_has_its_pictures() {
    let root = tempfile::tempdir().unwrap();
    let all = ["corner.svg", "histogram.svg", "strip.svg", "trace.svg"];
    for method in ["mpm --survey off", "paper-pic", "paper-apic", "svgd"] {
        let flags = format!("--target banana --particles 80 --steps 30 --method {method}");
        assert_eq!(drawn(root.path(), &flags).0, all, "{method}");
        let strip = text(root.path(), "strip.svg");
        for title in ["step 0<", "step 1<", "step 5<", "step 11<", "step 19<", "returned<"] {
            assert!(strip.contains(title), "{method}: {title}");
        }
    }
    let flags = "--target banana --particles 80 --steps 30 --method support-points";
    let (names, said) = drawn(root.path(), flags);
    assert_eq!(names, ["corner.svg", "histogram.svg", "strip.svg"]);
    assert!(said.contains("no trace.svg: "), "{said}");
    // What an earlier run left under a name is gone.
    let (names, _) = drawn(root.path(), "--target banana --particles 80 --method ais");
    assert_eq!(names, ["corner.svg", "histogram.svg", "survey.svg"]);
    let mut still = vec!["smc", "iid", "sobol", "stein-thinning"];
    if cfg!(feature = "nuts") {
        still.push("nuts");
    }
    for method in still {
        let (names, said) = drawn(
            root.path(),
            &format!("--target banana --particles 80 --method {method}"),
        );
        assert_eq!(names, ["corner.svg", "histogram.svg"], "{method}");
        for word in ["no trace.svg: ", "no strip.svg: no particles have moved"] {
            assert!(said.contains(word), "{method}: {said}");
        }
    }
}

#[test]
fn pictures_change_no_particle() {
    let root = tempfile::tempdir().unwrap();
    for method in ["mpm --survey off", "mpm --rounds 2", "paper-apic", "svgd"] {
        let flags = format!("--target banana --particles 80 --steps 20 --seed 2 --method {method}");
        drawn(root.path(), &format!("{flags} --frames f"));
        let output = parvi(root.path(), &format!("sample {flags} --out alone.csv"));
        assert!(output.status.success());
        let read = |name: &str| std::fs::read(root.path().join(name)).unwrap();
        assert!(read("x.csv") == read("alone.csv"), "{method}");
    }
}

#[test]
fn what_is_known_of_a_marginal_is_beside_it() {
    let root = tempfile::tempdir().unwrap();
    write_responses(&root.path().join("two.csv"), "y,age,dose");
    write_responses(&root.path().join("one.csv"), "y,age");
    let curve = |name: &str| text(root.path(), name).contains(">target");

    drawn(root.path(), "--target gaussian --dim 1 --particles 80");
    assert_eq!(files(&root.path().join("p")), ["histogram.svg", "survey.svg"]);
    assert!(curve("histogram.svg"));
    drawn(root.path(), "--target logistic --data one.csv --particles 80");
    assert!(curve("histogram.svg") && curve("corner.svg"));
    assert!(text(root.path(), "corner.svg").contains("age"));
    drawn(root.path(), "--target mixture-3 --dim 3 --particles 80");
    assert!(text(root.path(), "corner.svg").contains("exact draws"));
    // Else what the run has weighed, and without that nothing.
    let (_, said) = drawn(root.path(), "--target logistic --data two.csv --particles 80");
    let pool = |name: &str| text(root.path(), name).contains("weighted pool");
    assert!(pool("histogram.svg") && pool("corner.svg") && !curve("corner.svg"));
    assert!(!said.contains("no exact marginals"), "{said}");
    let (_, said) = drawn(
        root.path(),
        "--target logistic --data two.csv --particles 80 --method svgd --steps 5",
    );
    assert!(!curve("histogram.svg") && !curve("corner.svg") && !pool("corner.svg"));
    assert!(said.contains("no exact marginals and no contours"), "{said}");
    let (_, said) = drawn(root.path(), "--target gaussian --dim 8 --particles 80 --method iid");
    assert!(said.contains("first 6 of 8"), "{said}");
}

#[test]
fn a_density_within_a_mesh_is_drawn_within_it() {
    let root = tempfile::tempdir().unwrap();
    let mesh = concat!(env!("CARGO_MANIFEST_DIR"), "/meshes/disk.msh");
    let flags = format!("--target gaussian --dim 2 --particles 80 --steps 30 --basis mesh --mesh {mesh}");
    let (names, _) = drawn(root.path(), &flags);
    assert_eq!(names, ["corner.svg", "histogram.svg", "strip.svg", "trace.svg"]);
    for name in ["corner.svg", "strip.svg"] {
        let figure = text(root.path(), name);
        assert!(figure.contains("target") && !figure.contains("exact draws"), "{name}");
    }
}

#[test]
fn a_run_with_a_checkpoint_has_no_trace_and_says_so() {
    let root = tempfile::tempdir().unwrap();
    let flags = "--target banana --particles 80 --survey off --steps 20 --checkpoint state";
    let (names, said) = drawn(root.path(), flags);
    assert_eq!(names, ["corner.svg", "histogram.svg", "strip.svg"]);
    assert!(
        said.contains("no trace.svg: a run with a checkpoint has none"),
        "{said}"
    );
}
