//! The weighted pool as a file.

use crate::support::{assert_refused, files, for_each_line, numbers, parvi, succeeds, value, write_responses};

#[test]
fn the_pool_has_rows_with_weights() {
    let directory = tempfile::tempdir().unwrap();
    let line = "sample --target banana --particles 60 --method ais --evaluations 4000 --out x.csv --pool p.csv";
    let output = succeeds(directory.path(), line);
    assert_eq!(files(directory.path()), ["p.csv", "x.csv"]);
    let (header, rows) = numbers(&directory.path().join("p.csv"));
    assert_eq!(header, "x1,x2,weight,log_density");
    let evaluations: usize = value(&output, "density_evaluations").unwrap().parse().unwrap();
    assert!(rows.len() <= evaluations, "{}", rows.len());
    assert!(rows.len() <= 4000, "{}", rows.len());
    let sum: f64 = rows.iter().map(|row| row[2]).sum();
    assert!((sum - 1.0).abs() < 1e-9, "{sum}");
    let log_evidence: f64 = value(&output, "log_evidence").unwrap().parse().unwrap();
    assert!(log_evidence.abs() < 0.3, "{log_evidence}");

    // Without condensation the particles are the points that weigh anything.
    succeeds(directory.path(), &format!("{line} --condense off"));
    let (header, points) = numbers(&directory.path().join("x.csv"));
    assert_eq!(header, "x1,x2,weight");
    let weighing = rows.iter().filter(|row| row[2] > 0.0).map(|row| &row[..3]);
    assert!(points.iter().map(Vec::as_slice).eq(weighing));

    // Or these together with free draws.
    succeeds(directory.path(), &format!("{line} --condense controlled"));
    let (header, controlled) = numbers(&directory.path().join("x.csv"));
    assert_eq!(header, "x1,x2,weight");
    let sum: f64 = controlled.iter().map(|row| row[2]).sum();
    assert!(controlled.len() > points.len() && (sum - 1.0).abs() < 1e-9);
    assert!(controlled.iter().all(|row| row[2] > 0.0));

    let array_line = line.replace("p.csv", "p.npy");
    succeeds(directory.path(), &array_line);
    let bytes = std::fs::read(directory.path().join("p.npy")).unwrap();
    let array = npyz::NpyFile::new(bytes.as_slice()).unwrap();
    assert_eq!(array.shape(), [rows.len() as u64, 4]);
    assert_eq!(array.into_vec::<f64>().unwrap(), rows.concat());
}

#[test]
fn columns_of_a_pool_have_the_names_of_its_data() {
    let directory = tempfile::tempdir().unwrap();
    write_responses(&directory.path().join("d.csv"), "y,age,dose");
    let line = "sample --target logistic --data d.csv --particles 20 --rounds 0 --out x.csv --pool p.csv";
    let output = succeeds(directory.path(), line);
    assert_eq!(value(&output, "steps").unwrap(), "0");
    let text = std::fs::read_to_string(directory.path().join("p.csv")).unwrap();
    assert_eq!(text.lines().next(), Some("intercept,age,dose,weight,log_density"));
}

#[test]
fn pools_that_cannot_be() {
    let directory = tempfile::tempdir().unwrap();
    let refused = |flags: &str, parts: &[&str]| {
        let line = format!("sample --target banana --particles 60 --out x.csv {flags}");
        let output = parvi(directory.path(), &line);
        assert_refused(&output, parts);
        assert_eq!(files(directory.path()), [""; 0], "{flags}");
    };
    for_each_line(
        r#"
        --pool p.csv --survey off | --pool | p.csv | needs a survey
        --pool p.csv --alpha 0.5 | --pool | p.csv | needs a survey
        --pool p.txt | --pool p.txt | .csv | .npy
        --pool nuts | --pool nuts | .csv | .npy
        --pool ./x.csv | --pool | the file of --out
        --pool missing/p.csv | missing/p.csv
        --pool p.csv --method svgd | --pool | p.csv | svgd
        --pool p.csv --method stein-thinning | --pool | p.csv | `exact` or `nuts`
        "#,
        |line| refused(line[0], &line[1..]),
    );
}

#[test]
fn options_of_a_survey() {
    let directory = tempfile::tempdir().unwrap();
    let refused = |flags: &str, parts: &[&str]| {
        let line = format!("sample --target banana --particles 60 --out x.csv {flags}");
        assert_refused(&parvi(directory.path(), &line), parts);
    };
    for_each_line(
        r#"
        --evaluations 0 | --evaluations | 0 | from 1
        --evaluations -5 | --evaluations | -5
        --search-effort 3 --score cached | --search-effort | 3 | needs a survey
        --evaluations 500 --survey off | --evaluations | 500 | needs a survey
        --evaluations 500 --method svgd | --evaluations | 500 | svgd
        --rounds 0 --survey off | --rounds | 0 | needs a survey
        --method smc --pool p.csv | --pool | p.csv | smc
        --method smc --pool-size 20 | --pool-size | 20 | particles
        --method ais --steps 5 | --steps | 5 | ais
        --method ais --survey on | --survey | on | ais
        --method ais --checkpoint state | --checkpoint | state | ais
        "#,
        |line| refused(line[0], &line[1..]),
    );
}
