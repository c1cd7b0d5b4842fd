//! What `parvi sample` writes and says.

use crate::support::{files, numbers, parvi, sampled_regression, stderr, stdout, succeeds, value, write_responses};

fn keys(text: &str) -> Vec<&str> {
    text.lines().map(|line| line.split_once('=').unwrap().0).collect()
}

#[test]
fn particles_have_a_header_and_one_row_each() {
    let directory = tempfile::tempdir().unwrap();
    succeeds(
        directory.path(),
        "sample --target gaussian --dim 3 --particles 100 --method iid --out x.csv",
    );
    assert_eq!(files(directory.path()), ["x.csv"]);
    let (header, rows) = numbers(&directory.path().join("x.csv"));
    assert_eq!(header, "x1,x2,x3");
    assert_eq!(rows.len(), 100);
    assert!(
        rows.iter()
            .all(|row| row.len() == 3 && row.iter().all(|value| value.is_finite()))
    );
}

#[test]
fn a_density_on_a_mesh_stays_in_it() {
    let directory = tempfile::tempdir().unwrap();
    let mesh = concat!(env!("CARGO_MANIFEST_DIR"), "/meshes/disk.msh");
    let line =
        format!("sample --target gaussian --dim 2 --particles 300 --seed 1 --basis mesh --mesh {mesh} --out x.csv");
    succeeds(directory.path(), &line);
    let text = std::fs::read_to_string(directory.path().join("x.csv")).unwrap();
    let squares = text.lines().skip(1).map(|row| {
        let numbers = row.split(',').map(|cell| cell.parse::<f64>().unwrap());
        numbers.map(|c| c * c).sum::<f64>()
    });
    let squares: Vec<f64> = squares.collect();
    assert!(squares.iter().all(|&square| square < 1.0 + 1e-9));
    // E r² of N(0, I) within the unit disk is 2 − 1 / (√e − 1); the polygon of the mesh is a little smaller.
    let mean = squares.iter().sum::<f64>() / 300.0;
    let exact = 2.0 - 1.0 / (0.5f64.exp() - 1.0);
    assert!((mean / exact - 1.0).abs() < 0.03, "{mean}, {exact}");
}

#[test]
fn both_formats_hold_the_same_numbers() {
    let directory = tempfile::tempdir().unwrap();
    for name in ["x.csv", "x.npy"] {
        let line = format!("sample --target banana --particles 50 --method sobol --seed 7 --out {name}");
        succeeds(directory.path(), &line);
    }
    let text = std::fs::read_to_string(directory.path().join("x.csv")).unwrap();
    let from_text: Vec<f64> = text
        .lines()
        .skip(1)
        .flat_map(|line| line.split(','))
        .map(|cell| cell.parse().unwrap())
        .collect();
    let bytes = std::fs::read(directory.path().join("x.npy")).unwrap();
    let array = npyz::NpyFile::new(bytes.as_slice()).unwrap();
    assert_eq!(array.shape(), [50, 2]);
    assert_eq!(array.into_vec::<f64>().unwrap(), from_text);
}

// The peak of the memory is known on Linux only.
#[cfg(target_os = "linux")]
#[test]
fn standard_output_has_the_keys_of_the_contract() {
    let directory = tempfile::tempdir().unwrap();
    let output = succeeds(
        directory.path(),
        "sample --target gaussian --dim 2 --particles 200 --survey off --steps 5 --out x.csv",
    );
    insta::assert_snapshot!(keys(&stdout(&output)).join(" "), @"method steps score_evaluations density_evaluations wall_seconds residual spacing active_nodes bodies storage_bytes peak_memory_bytes outcome reason mean_error sd_error unexplained drift target dim particles seed");
    assert_eq!(value(&output, "method").unwrap(), "mpm");
    assert_eq!(value(&output, "steps").unwrap(), "5");
    assert!(value(&output, "spacing").unwrap().parse::<f64>().unwrap() > 0.0);

    let of = |method: &str| {
        let line = format!("sample --target gaussian --dim 2 --particles 200 --method {method} --out x.csv");
        parvi(directory.path(), &line)
    };
    insta::assert_snapshot!(keys(&stdout(&of("ais"))).join(" "), @"method steps score_evaluations density_evaluations log_evidence log_evidence_error pareto_k unseen wall_seconds peak_memory_bytes outcome mean_error sd_error unexplained relative_energy_distance drift target dim particles seed");
    insta::assert_snapshot!(keys(&stdout(&of("smc"))).join(" "), @"method steps score_evaluations density_evaluations log_evidence log_evidence_error wall_seconds peak_memory_bytes target dim particles seed");
    let output = of("iid");
    insta::assert_snapshot!(keys(&stdout(&output)).join(" "), @"method steps score_evaluations density_evaluations wall_seconds peak_memory_bytes target dim particles seed");
    assert_eq!(value(&output, "steps").unwrap(), "0");
    assert_eq!(value(&output, "score_evaluations").unwrap(), "0");
}

#[test]
fn the_same_seed_gives_the_same_file_on_any_number_of_threads() {
    let directory = tempfile::tempdir().unwrap();
    let mut methods = vec![
        "mpm",
        "ais",
        "smc",
        "paper-pic",
        "paper-apic",
        "svgd",
        "iid",
        "sobol",
        "stein-thinning",
        "support-points",
    ];
    if cfg!(feature = "nuts") {
        methods.push("nuts");
    }
    for method in methods {
        let steps = if matches!(method, "ais" | "smc" | "iid" | "sobol" | "nuts" | "stein-thinning") {
            ""
        } else {
            "--steps 8"
        };
        let file = |threads: &str, seed: u64| {
            let line =
                format!("sample --target banana --particles 300 --method {method} --seed {seed} {steps} --out x.csv");
            let mut command = crate::support::command();
            command
                .current_dir(directory.path())
                .env("RAYON_NUM_THREADS", threads)
                .args(line.split_whitespace());
            let output = command.output().unwrap();
            assert!(output.status.success(), "{method}: {}", stderr(&output));
            std::fs::read(directory.path().join("x.csv")).unwrap()
        };
        let one = file("1", 3);
        assert!(one == file("2", 3), "{method}: threads matter");
        assert!(one != file("2", 4), "{method}: the seed does not matter");
    }
}

#[test]
fn targets_are_listed() {
    let directory = tempfile::tempdir().unwrap();
    let output = succeeds(directory.path(), "targets");
    insta::assert_snapshot!(stdout(&output));
}

#[test]
fn columns_of_a_regression_have_the_names_of_its_data() {
    let directory = sampled_regression("y,age,dose", "");
    let text = std::fs::read_to_string(directory.path().join("x.csv")).unwrap();
    assert_eq!(text.lines().next(), Some("intercept,age,dose"));
}

#[test]
fn reasons_about_a_coordinate_of_a_regression_have_its_name() {
    let directory = tempfile::tempdir().unwrap();
    write_responses(&directory.path().join("d.csv"), "y,age,dose");
    let line = "sample --target logistic --data d.csv --survey off --particles 10 --out x.csv --diagnostics d.json";
    let output = succeeds(directory.path(), line);
    let reason = value(&output, "reason").unwrap();
    let named = ["intercept", "age", "dose"].map(|name| format!("of {name}:"));
    assert!(named.iter().any(|name| reason.contains(name.as_str())), "{reason}");
    assert!(stderr(&output).contains(&reason));
    let found = std::fs::read_to_string(directory.path().join("d.json")).unwrap();
    let found: serde_json::Value = serde_json::from_str(&found).unwrap();
    assert_eq!(found["reason"], reason);
}

#[test]
fn errors_of_coefficients_of_any_size_are_numbers() {
    let directory = tempfile::tempdir().unwrap();
    let rows: String = (0..40_i32)
        .map(|k| format!("{},{}e-100\n", u8::from(k % 3 == 0), k * 7 % 11))
        .collect();
    std::fs::write(directory.path().join("d.csv"), format!("y,dose\n{rows}")).unwrap();
    let line = "sample --target logistic --data d.csv --prior-sd inf --particles 200 --out x.csv";
    let output = succeeds(directory.path(), line);
    assert_eq!(value(&output, "outcome").unwrap(), "converged", "{}", stderr(&output));
    assert!(value(&output, "sd_error").unwrap().parse::<f64>().unwrap() < 0.09);
}

#[test]
fn options_of_a_body_that_has_not_moved_are_named() {
    let directory = tempfile::tempdir().unwrap();
    let said = |options: &str| {
        let line = format!("sample --target banana --particles 300 --out x.csv {options}");
        let output = succeeds(directory.path(), &line);
        (value(&output, "steps").unwrap(), stderr(&output))
    };
    let (steps, notice) = said("--spacing 0.5 --shifts off");
    assert_eq!(steps, "0");
    assert!(notice.starts_with("--spacing, --shifts: without effect"), "{notice}");
    let (steps, notice) = said("--spacing 0.5 --rounds 2");
    assert!(steps != "0" && !notice.contains("without effect"), "{steps}: {notice}");
    let (_, notice) = said("--rounds 0 --steps 50");
    assert!(
        notice.starts_with("--steps: without effect: none is moved with --rounds 0"),
        "{notice}"
    );
    for (options, why) in [("--weighted on", "weighted particles"), ("--rounds 0", "none is moved")] {
        let (_, notice) = said(&format!("{options} --moment-correction affine"));
        let expected = format!("--moment-correction: without effect: {why}");
        assert!(notice.starts_with(&expected), "{notice}");
    }
    let moving = |options: &str| said(&format!("--survey off --steps 5 {options}")).1;
    let notice = moving("--shifts off --spacing-range 2 --rotation on --settling-shifts on");
    let expected = "--rotation, --spacing-range, --settling-shifts: without effect: the basis keeps still";
    assert!(notice.contains(expected), "{notice}");
    assert!(moving("--basis quadratic --rotation on").contains("--rotation: without effect"));
    assert!(moving("--settling 0 --settling-shifts off").contains("--settling-shifts: without effect"));
    assert!(!moving("--rotation on --spacing-range 2").contains("without effect"));
    let (_, notice) = said("--moment-correction off");
    assert!(!notice.contains("without effect"), "{notice}");
}
