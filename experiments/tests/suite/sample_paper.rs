//! `parvi sample` with the paper's algorithms: as written, every law, every input, and what is refused of them.

use std::collections::HashMap;
use std::path::Path;

use crate::support::{assert_refused, files, for_each_line, parvi, stderr, stdout};

/// Runs `sample` and returns what it printed and the particles.
fn sampled(directory: &Path, flags: &str) -> (HashMap<String, String>, String) {
    let output = parvi(directory, &format!("sample {flags} --out x.csv"));
    assert!(output.status.success(), "{flags}: {}", stderr(&output));
    let particles = std::fs::read_to_string(directory.join("x.csv")).unwrap();
    let pair = |line: &str| {
        line.split_once('=')
            .map(|(key, value)| (key.to_owned(), value.to_owned()))
    };
    (stdout(&output).lines().filter_map(pair).collect(), particles)
}

/// Runs `sample` beside the given files and asserts that it is refused and leaves nothing else.
fn refused_beside(contents: &[(&str, &str)], flags: &str, parts: &[&str]) {
    let directory = tempfile::tempdir().unwrap();
    for (name, text) in contents {
        std::fs::write(directory.path().join(name), text).unwrap();
    }
    let output = parvi(directory.path(), &format!("sample {flags} --out x.csv"));
    assert_refused(&output, parts);
    let mut expected: Vec<&str> = contents.iter().map(|(name, _)| *name).collect();
    expected.sort_unstable();
    assert_eq!(files(directory.path()), expected, "{flags}");
}

fn refused(flags: &str, parts: &[&str]) {
    refused_beside(&[], flags, parts);
}

const GENTLE: &str =
    "--target gaussian --dim 2 --correlation 0.5 --particles 60 --steps 5 --time-step 0.02 --alpha 1e-3";

#[test]
fn as_written_is_the_identity_frame_without_guards() {
    let directory = tempfile::tempdir().unwrap();
    for method in ["paper-pic", "paper-apic"] {
        let (said, written) = sampled(directory.path(), &format!("{GENTLE} --method {method} --as-written"));
        assert_eq!(said["steps"], "5");
        let flags = format!("{GENTLE} --method {method} --frame identity --guards off");
        assert_eq!(sampled(directory.path(), &flags).1, written);
        let (_, framed) = sampled(directory.path(), &format!("{GENTLE} --method {method} --guards off"));
        assert_ne!(framed, written, "the frame is a departure");
        let flags = format!("{GENTLE} --method {method} --as-written --mass-weighted-force on");
        assert_ne!(
            sampled(directory.path(), &flags).1,
            written,
            "each departure stands beside it"
        );
    }
}

#[test]
fn ten_thousand_particles_cost_some_hundred_scores() {
    let directory = tempfile::tempdir().unwrap();
    let flags = "--target banana --particles 10000 --method paper-pic --steps 200";
    let (said, _) = sampled(directory.path(), flags);
    let evaluations: u64 = said["score_evaluations"].parse().unwrap();
    assert!(evaluations <= 1_000, "{evaluations}");
    assert_eq!(said["judging_evaluations"], "10000");
    let flags = flags.replace("10000", "100");
    let (said, _) = sampled(directory.path(), &format!("{flags} --certificate off"));
    assert!(!said.contains_key("outcome"));
}

#[test]
fn every_material_by_its_name() {
    let directory = tempfile::tempdir().unwrap();
    let materials = [
        "neo-hookean --youngs-modulus 2 --poisson-ratio 0.1",
        "linear-cauchy",
        "linear-elastic --young-modulus 2",
        "fixed-corotated",
        "hencky --poissons-ratio -0.2",
        "snow --youngs-modulus 2",
        "kelvin-voigt --viscosity 0.2",
        "softening-hencky --peak-yield-stress 0.2 --residual-yield-stress 0.1 --softening-rate 2",
        "drucker-prager --friction-angle 35 --cohesion 0.01",
        "tait-fluid --density 1 --sound-speed 1 --viscosity 0.05 --forgets-expansion on",
        "isothermal-gas --pressure-per-density 1",
    ];
    let mut ends: Vec<String> = Vec::new();
    for material in materials {
        let flags = format!("--target banana --particles 100 --steps 30 --method paper-apic --material {material}");
        let (_, particles) = sampled(directory.path(), &flags);
        assert!(!ends.contains(&particles), "{material}");
        ends.push(particles);
    }
}

#[test]
fn parameters_that_a_law_does_not_have_or_refuses_are_named() {
    let with = |flags: &str, parts: &[&str]| {
        refused(
            &format!("--target banana --particles 64 --method paper-pic --material {flags}"),
            parts,
        );
    };
    for_each_line(
        r#"
        rubber | --material | rubber | neo-hookean
        hencky --viscosity 1 | --viscosity | 1 | `hencky`
        isothermal-gas --youngs-modulus 1 | --youngs-modulus | 1 | `isothermal-gas`
        kelvin-voigt --viscosity -1 | --viscosity | -1 | at least 0
        tait-fluid --density 0 | --density | 0 | positive
        tait-fluid --sound-speed -1 | --sound-speed | -1 | positive
        drucker-prager --friction-angle 90 | --friction-angle | 90 | degrees
        drucker-prager --cohesion -1 | --cohesion | -1
        softening-hencky --peak-yield-stress 0 | --peak-yield-stress | 0
        softening-hencky --peak-yield-stress 1 --residual-yield-stress 2 | --residual-yield-stress | 2 | peak 1
        softening-hencky --softening-rate -1 | --softening-rate | -1
        isothermal-gas --pressure-per-density 0 | --pressure-per-density | 0
        neo-hookean --poissons-ratio 0.5 | --poissons-ratio | 0.5
        neo-hookean --stretch-limit 1 | --stretch-limit | 1 | above 1
        "#,
        |line| with(line[0], &line[1..]),
    );
}

#[test]
fn alpha_of_either_sign_with_a_schedule() {
    let directory = tempfile::tempdir().unwrap();
    let base = "--target gaussian --dim 2 --particles 60 --steps 8 --method paper-pic";
    let mut ends: Vec<String> = Vec::new();
    for alpha in [
        "--alpha 1",
        "--alpha -1",
        "--alpha-from 0.1 --alpha-to 1",
        "--alpha-from -0.1 --alpha-to -1",
        "--alpha-from -0.5 --alpha-to 1 --alpha-schedule linear",
        "--alpha-from 0 --alpha-to 1 --alpha-schedule cyclic",
        "--alpha-from 0 --alpha-to 1 --alpha-schedule cyclic --alpha-cycles 2",
        "--alpha 1 --grid-renewal 3",
        "--alpha 1 --friction 2",
    ] {
        let (_, particles) = sampled(directory.path(), &format!("{base} {alpha}"));
        assert!(!ends.contains(&particles), "{alpha}");
        ends.push(particles);
    }
    let with = |flags: &str, parts: &[&str]| refused(&format!("{base} {flags}"), parts);
    for_each_line(
        r#"
        --alpha nan | --alpha | NaN | finite
        --alpha-from -1 --alpha-to 1 | --alpha-to | 1 | sign
        --alpha-schedule linear | --alpha-schedule | linear | alpha-from
        --alpha-from 1 --alpha-to 2 --alpha-cycles 2 | --alpha-cycles | 2 | cyclic
        --grid-renewal 0 | --grid-renewal | 0
        "#,
        |line| with(line[0], &line[1..]),
    );
    refused(
        "--target banana --particles 64 --alpha -1",
        &["--alpha", "-1", "above 0"],
    );
}

#[test]
fn a_start_from_a_file_is_where_the_particles_begin() {
    let directory = tempfile::tempdir().unwrap();
    let points = "x1,x2\n0.5,-0.25\n1,0\n-0.5,0.75\n";
    std::fs::write(directory.path().join("start.csv"), points).unwrap();
    let still = "--target gaussian --dim 2 --start start.csv --steps 1";
    for method in [
        "--method paper-pic --time-step 1e-12",
        "--method paper-apic --as-written --time-step 1e-12",
        "--method svgd --step-size 1e-12",
        "--survey off --time-step 1e-12 --moment-correction off",
    ] {
        let (said, particles) = sampled(directory.path(), &format!("{still} {method}"));
        assert_eq!(said["particles"], "3");
        for (row, expected) in particles.lines().zip(points.lines()).skip(1) {
            for (cell, expected) in row.split(',').zip(expected.split(',')) {
                let (x, expected): (f64, f64) = (cell.parse().unwrap(), expected.parse().unwrap());
                assert!((x - expected).abs() < 1e-6, "{method}: {row}");
            }
        }
    }
    // The particles of a run are a start for the next, as .npy too.
    let first = parvi(directory.path(), "sample --target banana --particles 50 --out a.npy");
    assert!(first.status.success());
    sampled(
        directory.path(),
        "--target banana --start a.npy --method paper-pic --steps 3",
    );
}

#[test]
fn masses_volumes_and_velocities_are_those_of_the_files() {
    let directory = tempfile::tempdir().unwrap();
    let write = |name: &str, row: &dyn Fn(usize) -> String| {
        let rows: Vec<String> = (0..60).map(row).collect();
        std::fs::write(directory.path().join(name), rows.join("\n")).unwrap();
    };
    write("same.csv", &|_| (1.0f64 / 60.0).to_string());
    write("zero.csv", &|_| "0,0".to_owned());
    write("masses.csv", &|p| (0.01 + 0.0003 * p as f64).to_string());
    write("velocities.csv", &|p| format!("{},0.1", 0.01 * p as f64));
    let base = format!("{GENTLE} --method paper-pic --as-written");
    let (_, default) = sampled(directory.path(), &base);
    for same in [
        "--masses equal --volumes uniform --velocities zero",
        "--masses same.csv --volumes same.csv --velocities zero.csv",
    ] {
        assert_eq!(
            sampled(directory.path(), &format!("{base} {same}")).1,
            default,
            "{same}"
        );
    }
    let mut ends = vec![default];
    for other in [
        "--masses masses.csv",
        "--volumes masses.csv",
        "--velocities velocities.csv",
        "--volumes start-density --alpha 1e-5 --time-step 1e-3",
        "--volumes grid --alpha 1e-5 --time-step 1e-3",
        "--start-law gaussian",
        "--start-centre -0.5,1",
        "--start-centre 0.5,1 --start-covariance 0.5,0.1;0.1,0.3",
    ] {
        // The last of two equal flags would be refused: those of the base make room.
        let base = if other.contains("--alpha") {
            "--target gaussian --dim 2 --correlation 0.5 --particles 60 --steps 5 --method paper-pic --as-written"
        } else {
            &base
        };
        let (_, particles) = sampled(directory.path(), &format!("{base} {other}"));
        assert!(!ends.contains(&particles), "{other}");
        ends.push(particles);
    }
}

#[test]
fn files_of_particles_that_make_no_sense_are_named() {
    let two = "0,0\n1,1\n";
    let with = |name: &str, text: &str, flags: &str, parts: &[&str]| {
        let flags = format!("--target gaussian --dim 2 --method paper-pic {flags}");
        refused_beside(&[("start.csv", two), (name, text)], &flags, parts);
    };
    for_each_line(
        r#"
        s.csv | 0,0,0\n1,1,1\n | --start s.csv | --start | s.csv | 3 columns | 2
        s.csv | 0,0\nnan,1\n | --start s.csv | --start | row 2, column 1 | NaN
        s.csv | x,y\n0,0\none,1\n | --start s.csv | --start | line 3 | one
        s.csv | x2,x1\n0,0\n1,1\n | --start s.csv | --start | s.csv | columns are x2, x1 | must be x1, x2
        s.txt | 0,0\n1,1\n | --start s.txt | --start | s.txt | .csv or .npy
        s.csv | 0,0\n | --start s.csv | particles | 1
        s.csv | 0,0\n1,1\n | --start none.csv | --start | none.csv
        s.csv | 0,0\n1,1\n | --start s.csv --particles 5 | --start | 2 rows | 5
        m.csv | 1\n-1\n | --start start.csv --masses m.csv | --masses | particle 1 | -1
        m.csv | 1\n0\n | --start start.csv --volumes m.csv | --volumes | particle 1 | 0
        m.csv | 1\n1\n1\n | --start start.csv --masses m.csv | --masses | 3 rows | 2
        v.csv | 1\n1\n | --start start.csv --velocities v.csv | --velocities | 1 column, | 2
        v.csv | 0,0\ninf,0\n | --start start.csv --velocities v.csv | --velocities | inf
        s.csv | 0,0\n1,1\n | --start start.csv --volumes start-density | --volumes | start-density
        s.csv | 0,0\n1,1\n | --start start.csv --start-law gaussian | --start-law | --start
        s.csv | 0,0\n1,1\n | --start start.csv --start-mean 1 | --start-mean | 1 | --start
        "#,
        |line| with(line[0], line[1], line[2], &line[3..]),
    );
    let law = |flags: &str, parts: &[&str]| {
        refused(
            &format!("--target gaussian --dim 3 --particles 20 --method paper-pic {flags}"),
            parts,
        );
    };
    law("--start-law banana", &["--start-law", "banana", "3"]);
    law("--start-law doughnut", &["--start-law", "doughnut"]);
    law("--start-centre 1,2", &["--start-centre", "1,2", "dimension 3"]);
    law("--start-centre 1,2,x", &["--start-centre", "x"]);
    law("--start-covariance 1", &["--start-covariance", "--start-centre"]);
    law(
        "--start-centre 0,0,0 --start-covariance 1,0,0;0,1,0",
        &["--start-covariance", "rows is 2"],
    );
    law(
        "--start-centre 0,0,0 --start-covariance 1,0,0;0,1,0;0,0,-1",
        &["--start-covariance", "positive"],
    );
    refused_beside(
        &[("start.csv", two)],
        "--target gaussian --dim 2 --start start.csv",
        &["--start: start positions have no spread"],
    );
    // So far from the origin that rounding leaves no spread.
    refused(
        "--target gaussian --dim 2 --particles 10 --start-centre 1e20,0",
        &["--start-centre: start positions have no spread"],
    );
    refused_beside(
        &[("start.csv", two)],
        "--target gaussian --dim 2 --start start.csv --method iid",
        &["--start", "iid"],
    );
    refused_beside(
        &[("x.csv", two)],
        "--target gaussian --dim 2 --start x.csv --method paper-pic",
        &["--start", "x.csv", "--out"],
    );
}

#[test]
fn the_best_configuration_has_a_file_and_patience_ends_a_run() {
    let directory = tempfile::tempdir().unwrap();
    let run =
        "--target gaussian --dim 2 --particles 100 --method paper-apic --friction 2 --steps 400 --certificate off";
    let (said, last) = sampled(directory.path(), &format!("{run} --best best.csv --monitor-every 20"));
    assert_eq!((said["steps"].as_str(), said["ended_early"].as_str()), ("400", "false"));
    let best = std::fs::read_to_string(directory.path().join("best.csv")).unwrap();
    assert_eq!(best.lines().count(), 101);
    let number = |key: &str| said[key].parse::<f64>().unwrap();
    assert!(number("best_monitor") <= number("last_monitor"));
    assert_eq!(best == last, number("best_step") == 400.0);
    let (said, ended) = sampled(directory.path(), &format!("{run} --monitor log-density --patience 2"));
    assert_eq!(said["ended_early"], "true");
    let steps: usize = said["steps"].parse().unwrap();
    assert!(steps < 400, "{steps}");
    let told = run.replace("400", &said["steps"]);
    let (hybrid_off, same) = sampled(directory.path(), &format!("{told} --flip-share 0"));
    assert_eq!(same, ended);
    assert!(!hybrid_off.contains_key("best_step"));
    assert_ne!(sampled(directory.path(), &format!("{told} --flip-share 0.9")).1, ended);
}

#[test]
fn watches_that_make_no_sense_are_refused() {
    let run = "--target gaussian --dim 2 --particles 20 --method paper-pic";
    refused(&format!("{run} --monitor size"), &["--monitor", "size"]);
    refused(&format!("{run} --patience 0"), &["--patience", "0"]);
    refused(&format!("{run} --monitor-every 0"), &["--monitor-every", "0"]);
    refused(&format!("{run} --best best.txt"), &["--best", "best.txt"]);
    refused(&format!("{run} --best x.csv"), &["--out", "x.csv"]);
    refused(&format!("{run} --flip-share 1.5"), &["--flip-share", "1.5"]);
    let other = "--target gaussian --dim 2 --particles 20 --method svgd";
    refused(&format!("{other} --monitor stein"), &["--monitor", "svgd"]);
}
