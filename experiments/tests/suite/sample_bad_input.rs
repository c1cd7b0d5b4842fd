//! What `parvi sample` refuses: one message with the flag or line and the value, a non-zero exit code, no file.

use std::path::Path;

use crate::support::{assert_refused, files, for_each_line, parvi};

/// Runs `sample` with the given flags into x.csv of a fresh directory and asserts that it was refused without a trace.
fn refused(flags: &str, parts: &[&str]) {
    let directory = tempfile::tempdir().unwrap();
    let output = parvi(directory.path(), &format!("sample {flags} --out x.csv"));
    assert_refused(&output, parts);
    assert_eq!(files(directory.path()), [""; 0], "{flags}");
}

#[test]
fn dimensions_out_of_range() {
    for_each_line(
        r#"
        --target gaussian --dim 0 --particles 64 | --dim | 0 | from 1 to 8
        --target gaussian --dim 9 --particles 64 | --dim | 9 | from 1 to 8
        --target gaussian --dim -3 --particles 64 | --dim | -3 | from 1 to 8
        --target gaussian --dim two --particles 64 | --dim | two
        --target gaussian --particles 64 | gaussian | dimension
        --target program --program cat --particles 64 | program | dimension
        --target banana --dim 3 --particles 64 | banana | 3
        --target wells --dim 7 --particles 64 | wells | 7
        "#,
        |line| refused(line[0], &line[1..]),
    );
}

#[test]
fn sizes_out_of_range() {
    for_each_line(
        r#"
        --target gaussian --dim 2 --particles -5 | --particles | -5 | from 2
        --target gaussian --dim 2 --particles 0 | --particles | 0
        --target gaussian --dim 2 --particles 1 | --particles | 1
        --target gaussian --dim 2 --particles 64 --steps 0 | --steps | 0 | from 1
        --target gaussian --dim 2 --particles 64 --steps -1 | --steps | -1
        --target gaussian --dim 2 --particles 64 --seed -1 | --seed | -1 | seeds are whole numbers from 0
        --target random --dim 2 --particles 64 --target-seed -1 | --target-seed | -1 | seeds are whole numbers from 0
        "#,
        |line| refused(line[0], &line[1..]),
    );
}

#[test]
fn a_flag_of_other_methods_is_answered_with_those_of_the_method() {
    for_each_line(
        r#"
        --method svgd --friction 1 | --friction: 1 does not fit method `svgd`, which has --steps, | --bandwidth
        --method iid --steps 3 | --steps: 3 does not fit method `iid`, which has no options of its own
        "#,
        |line| {
            refused(
                &format!("--target gaussian --dim 2 --particles 64 {}", line[0]),
                &line[1..],
            )
        },
    );
}

#[test]
fn meshes_that_do_not_fit() {
    let mesh = concat!(env!("CARGO_MANIFEST_DIR"), "/meshes/disk.msh");
    let on = |flags: &str, parts: &[&str]| refused(&format!("--particles 64 --mesh {mesh} {flags}"), parts);
    on("--target gaussian --dim 2", &["--mesh", "needs the basis `mesh`"]);
    on("--target gaussian --dim 3 --basis mesh", &["disk.msh"]);
    on(
        "--target gaussian --dim 2 --basis mesh --checkpoint state",
        &["--checkpoint: state: sampling on a mesh has no checkpoint"],
    );
    on(
        "--target gaussian --dim 5 --basis mesh",
        &["disk.msh", "2 or 3 dimensions", "5"],
    );
    on("--target ring --basis mesh --spacing 0.3", &["--spacing", "0.3"]);
    on("--target ring --basis mesh --method paper-pic", &["--mesh"]);
    for_each_line(
        r#"
        --target ring --particles 64 --basis mesh | --basis | --mesh
        --target ring --particles 64 --basis mesh --mesh none.msh | none.msh
        "#,
        |line| refused(line[0], &line[1..]),
    );
}

#[test]
fn unknown_names() {
    for_each_line(
        r#"
        --target doughnut --particles 64 | doughnut | ring
        --target banana --particles 64 --method annealing | --method | annealing | mpm
        --target banana --particles 64 --basis lattice-of-boxes | --basis | lattice-of-boxes
        --target banana --particles 64 --sede 3 | --sede
        "#,
        |line| refused(line[0], &line[1..]),
    );
}

#[test]
fn flags_that_do_not_fit_the_method() {
    for_each_line(
        r#"
        --target banana --particles 64 --method svgd --spacing 0.5 | --spacing | 0.5 | svgd
        --target banana --particles 64 --method iid --steps 10 | --steps | 10 | iid
        --target banana --particles 64 --youngs-modulus 2 | --youngs-modulus | 2 | mpm
        --target banana --particles 64 --method paper-pic --friction -1 | --friction | -1 | at least 0
        --target banana --particles 64 --flip-share 0.9 | --flip-share | 0.9 | flip
        --target banana --particles 64 --survey on --score cached | --survey | on contradicts --score cached
        --target banana --particles 64 --survey on --alpha 0.5 | --survey | on needs a last alpha of 1
        --target banana --particles 64 --method paper-pic --alpha-from 2 | --alpha-from | 2 | alpha-to
        "#,
        |line| refused(line[0], &line[1..]),
    );
}

#[test]
fn flags_that_do_not_fit_the_baselines() {
    let refused = |method: &str, parts: &[&str]| {
        refused(&format!("--target banana --particles 64 --method {method}"), parts);
    };
    for_each_line(
        r#"
        iid --chains 2 | --chains | 2 | iid
        nuts --steps 100 | --steps | 100 | nuts
        nuts --pool-size 100 | --pool-size | 100 | nuts
        nuts --target-acceptance 1 | --target-acceptance | 1 | below 1
        nuts --thinning 0 | --thinning | 0 | from 1
        nuts --warm-up -1 | --warm-up | -1 | from 0
        support-points --pool exact | --pool | exact | support-points
        support-points --tolerance -1 | --tolerance | -1 | at least 0
        support-points --start-mean 1 | --start-mean | 1 | support-points
        stein-thinning --pool-size 63 | --pool-size | 63 | particles
        stein-thinning --warm-up 50 | --warm-up | 50 | pool `nuts`
        stein-thinning --pool exact --start-sd 2 | --start-sd | 2 | pool `nuts`
        "#,
        |line| refused(line[0], &line[1..]),
    );
}

#[test]
fn a_method_that_the_build_lacks() {
    let message = "built without nuts: rebuild with --features nuts";
    if cfg!(not(feature = "nuts")) {
        refused("--target banana --particles 64 --method nuts", &[message]);
        refused(
            "--target banana --particles 64 --method stein-thinning --pool nuts",
            &[message],
        );
    }
}

#[test]
fn flags_that_do_not_fit_the_target() {
    for_each_line(
        r#"
        --target banana --particles 64 --radius 2 | radius | 2 | banana
        --target ring --particles 64 --prior-sd 2 | prior-sd | 2 | ring
        --target gaussian --dim 2 --particles 64 --data wells.csv | data | wells.csv | gaussian
        --target gaussian --dim 2 --particles 64 --correlation 1.5 | correlation | 1.5
        --target ring --particles 64 --width -1 | width | -1
        --target student-t --dim 2 --particles 64 --degrees-of-freedom NaN | degrees | NaN
        "#,
        |line| refused(line[0], &line[1..]),
    );
}

#[test]
fn targets_that_there_are_not_are_mistakes_of_the_command_line() {
    for (flags, message) in [
        ("--target rong", "error: --target: unknown target 'rong'"),
        (
            "--target ring --width -1",
            "error: --width: -1 must be a number above 0",
        ),
        (
            "--target gaussian --dim 2 --correlation 1.5",
            "error: --correlation: 1.5 must be a number between",
        ),
        (
            "--target gaussian --dim 2 --correlation NaN",
            "error: --correlation: correlation is NaN",
        ),
        (
            "--target student-t --dim 2 --degrees-of-freedom -2",
            "error: --degrees-of-freedom: -2 must be",
        ),
        ("--target wells --dim 2 --prior-sd 0", "error: --prior-sd: "),
        ("--target banana --radius 2", "error: --radius: "),
        ("--target banana --dim 3", "error: --dim: "),
        ("--target logistic", "error: --data: "),
    ] {
        let directory = tempfile::tempdir().unwrap();
        let output = parvi(directory.path(), &format!("sample {flags} --particles 64 --out x.csv"));
        assert_refused(&output, &[message]);
        assert_eq!(output.status.code(), Some(2), "{flags}");
        assert_eq!(files(directory.path()), [""; 0], "{flags}");
    }
}

#[test]
fn values_out_of_range() {
    for_each_line(
        r#"
        --target banana --particles 64 --spacing 0 | --spacing | 0 | above 0
        --target banana --particles 64 --spacing NaN | --spacing | NaN
        --target banana --particles 64 --time-step -0.1 | --time-step | -0.1
        --target banana --particles 64 --friction inf | --friction | inf
        --target banana --particles 64 --start-sd 0 | --start-sd | 0
        --target banana --particles 64 --method paper-apic --poissons-ratio 0.5 | --poissons-ratio | 0.5 | below 0.5
        --target banana --particles 64 --transfer flip --flip-share 1.2 | --flip-share | 1.2
        "#,
        |line| refused(line[0], &line[1..]),
    );
}

#[test]
fn methods_that_need_more_than_the_target_has() {
    for_each_line(
        r#"
        --target wells --dim 3 --particles 64 --method iid | iid | wells
        --target wells --dim 3 --particles 64 --method sobol | sobol | wells
        "#,
        |line| refused(line[0], &line[1..]),
    );
    let directory = tempfile::tempdir().unwrap();
    let line = "sample --target wells --dim 3 --particles 64 --method iid --out x.csv";
    assert_eq!(parvi(directory.path(), line).status.code(), Some(2));
}

#[test]
fn a_start_that_is_not_finite_has_its_row() {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("start.csv"), "x1,x2\n0,1\n2,NaN\n").unwrap();
    let line = "sample --target banana --method svgd --start start.csv --out x.csv";
    let output = parvi(directory.path(), line);
    assert_refused(&output, &["--start", "start.csv", "row 2, column 2", "NaN"]);
    assert_eq!(output.status.code(), Some(1));
}

#[test]
fn a_file_that_cannot_be_read_is_no_wrong_flag_whatever_it_is_for() {
    let directory = tempfile::tempdir().unwrap();
    for (flags, code) in [
        ("--target banana --start none.csv", 1),
        ("--target banana --start none.npy", 1),
        ("--target banana --start none.txt", 2),
        ("--target logistic --data none.csv", 1),
    ] {
        let output = parvi(directory.path(), &format!("sample {flags} --particles 64 --out x.csv"));
        assert_refused(&output, &["none."]);
        assert_eq!(output.status.code(), Some(code), "{flags}");
    }
}

#[test]
fn a_mesh_is_not_written_over() {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("disk.msh"), "mine").unwrap();
    let line = "sample --target gaussian --dim 2 --particles 64 --basis mesh --mesh disk.msh --out x.csv";
    let output = parvi(directory.path(), &format!("{line} --diagnostics ./disk.msh"));
    assert_refused(&output, &["disk.msh is the file of --"]);
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(
        std::fs::read_to_string(directory.path().join("disk.msh")).unwrap(),
        "mine"
    );
}

#[test]
fn output_files_that_cannot_be() {
    let directory = tempfile::tempdir().unwrap();
    let sample = |out: &str| {
        parvi(
            directory.path(),
            &format!("sample --target banana --particles 64 --out {out}"),
        )
    };
    assert_refused(&sample("x.txt"), &["--out", "x.txt", ".csv", ".npy"]);
    assert_refused(&sample("x"), &["--out", "x", ".csv"]);
    assert_refused(&sample("missing/x.csv"), &["missing/x.csv"]);
    std::fs::create_dir(directory.path().join("d.csv")).unwrap();
    assert_refused(&sample("d.csv"), &["d.csv", "directory"]);
    std::fs::write(directory.path().join("file"), "").unwrap();
    assert_refused(&sample("file/x.csv"), &["file/x.csv"]);
    assert_eq!(files(directory.path()), ["d.csv", "file"]);
}

/// Runs a regression on a file with the given text.
fn refused_data(text: &str, flags: &str, parts: &[&str]) {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("data.csv"), text).unwrap();
    let line = format!("sample --target logistic --data data.csv --particles 64 {flags} --out x.csv");
    assert_refused(&parvi(directory.path(), &line), parts);
    assert_eq!(files(directory.path()), ["data.csv"]);
}

#[test]
fn data_that_cannot_be_used() {
    refused_data("y,a\n1,0.5\n0,\n1,2\n", "", &["data.csv", "line 3", "'a'"]);
    refused_data("y,a\n1,0.5\n0,many\n", "", &["data.csv", "line 3", "'a'", "many"]);
    refused_data("y,a\n1,0.5\n2,0.1\n", "", &["data.csv", "line 3", "2", "0 or 1"]);
    refused_data("y,a\n", "", &["data.csv", "no rows"]);
    refused_data("", "", &["data.csv is empty"]);
    refused_data("y,a\n1,0.5\n0,0.1,7\n", "", &["data.csv", "line 3"]);
    refused_data("y,a\n1,nan\n0,0.1\n", "", &["data.csv", "line 2", "nan"]);
    let collinear = "y,a,b\n1,1,2\n0,2,4\n1,3,6\n0,4,8\n1,5,10\n0,1,2\n";
    refused_data(collinear, "--prior-sd inf", &["data.csv"]);
}

#[test]
fn data_that_does_not_exist() {
    for_each_line(
        r#"
        --target logistic --particles 64 | logistic | data
        --target logistic --data nowhere.csv --particles 64 | nowhere.csv
        "#,
        |line| refused(line[0], &line[1..]),
    );
    let missing = Path::new("nowhere.csv");
    assert!(!missing.exists());
}
