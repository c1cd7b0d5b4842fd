//! Every way in which the data of a regression can be wrong, and what the error says.

use std::fs;
use std::path::PathBuf;

use parvi_targets::{
    CountData, LogisticRegression, Parameters, PoissonRegression, ProbitRegression, RegressionData, TargetError, build,
    dimension_of,
};
use tempfile::TempDir;

use crate::support::with;

fn read(text: &str) -> Result<RegressionData, TargetError> {
    RegressionData::from_csv_reader(text.as_bytes(), "some.csv")
}

fn message(text: &str) -> String {
    read(text).unwrap_err().to_string()
}

#[test]
fn a_good_file_is_read_as_it_is() {
    let data = read("\u{feff}y, age ,dose\n1,30,0.5\n\n 0 ,-2e1,7\n1.0,3,4\n  \t\r\n \n").unwrap();
    assert_eq!(data.names(), ["intercept", "age", "dose"]);
    assert_eq!(data.responses(), [true, false, true]);
    assert_eq!(data.covariates(1).unwrap(), [1.0, -20.0, 7.0]);
    assert_eq!(data.covariates(3), None);
    // Only a response: the model of an intercept alone.
    assert_eq!(read("y\n1\n0\n").unwrap().dimension(), 1);
}

#[test]
fn bad_cells_are_named() {
    assert_eq!(message("y,age\n1,2\n0,\n"), "some.csv, line 3: column 'age' is empty");
    assert_eq!(message("y,age\n,2\n"), "some.csv, line 2: column 'y' is empty");
    assert_eq!(
        message("y,age\n1,old\n"),
        "some.csv, line 2: column 'age' holds 'old', which is not a number"
    );
    assert_eq!(
        message("y,age\nNA,2\n"),
        "some.csv, line 2: column 'y' holds 'NA', which is not a number"
    );
    for text in ["NaN", "inf", "-inf", "1e999"] {
        let expected = format!("some.csv, line 3: column 'age' holds '{text}', which is not finite");
        assert_eq!(message(&format!("y,age\n1,2\n0,{text}\n")), expected);
    }
    assert_eq!(
        message("y,age\n1,3\n2,3\n"),
        "some.csv, line 3: the response 'y' is '2', it must be 0 or 1"
    );
    assert_eq!(
        message("y,age\n0.5,3\n"),
        "some.csv, line 2: the response 'y' is '0.5', it must be 0 or 1"
    );
}

/// Else the first row of data would be taken for names, and be lost.
#[test]
fn a_file_without_a_header_is_refused() {
    let expected = "some.csv, line 1: only numbers, where a header is expected: the names of the columns, that of the response first";
    for text in ["1,2.5,-3e1\n0,1,2\n", "1,1\n0,2\n", "1\n0\n"] {
        assert_eq!(message(text), expected);
        let counts = CountData::from_csv_reader(text.as_bytes(), "some.csv");
        assert_eq!(counts.unwrap_err().to_string(), expected);
    }
    assert_eq!(read("y,1\n1,2\n").unwrap().names(), ["intercept", "1"]);
}

#[test]
fn bad_shapes_are_named() {
    assert_eq!(message("y,age\n"), "some.csv has no rows of data");
    assert_eq!(message("y,age\n\n\n"), "some.csv has no rows of data");
    for nothing in ["", "\n\n"] {
        assert_eq!(
            message(nothing),
            "some.csv is empty: a header and rows of data are expected"
        );
    }
    assert_eq!(
        message("y,,dose\n1,2,3\n"),
        "some.csv, line 1: column 2 of the header is empty"
    );
    assert_eq!(
        message("y,age,age\n1,2,3\n"),
        "some.csv, line 1: the column name 'age' appears twice"
    );
    assert_eq!(
        message("y,age\n1,2\n1,2,3\n"),
        "some.csv, line 3: the number of cells is 3, that of columns in the header 2"
    );
    assert_eq!(
        message("y,age\n1\n"),
        "some.csv, line 2: the number of cells is 1, that of columns in the header 2"
    );
    let wide = "y,a,b,c,d,e,f,g,h\n1,1,2,3,4,5,6,7,8\n";
    assert_eq!(
        message(wide),
        "some.csv has 8 covariates; with the intercept at most 7 are possible"
    );
    assert!(read("y,a,b,c,d,e,f,g\n1,1,2,3,4,5,6,7\n").is_ok());
}

#[test]
fn unreadable_files_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let missing = folder.path().join("missing.csv");
    let error = RegressionData::from_csv_file(&missing).unwrap_err();
    assert!(
        matches!(&error, TargetError::DataUnreadable { file, .. } if file.ends_with("missing.csv")),
        "{error}"
    );
    // A folder is not a file.
    assert!(matches!(
        RegressionData::from_csv_file(folder.path()),
        Err(TargetError::DataUnreadable { .. })
    ));
    let latin = folder.path().join("latin.csv");
    fs::write(&latin, b"y,age\n1,\xe9\n").unwrap();
    assert!(matches!(
        RegressionData::from_csv_file(&latin),
        Err(TargetError::DataUnreadable { .. })
    ));
}

fn posterior<const D: usize>(text: &str, prior: [f64; D]) -> Result<LogisticRegression<D>, TargetError> {
    LogisticRegression::new("logistic", read(text)?, prior)
}

const FLAT: f64 = f64::INFINITY;

#[test]
fn collinear_columns_need_a_proper_prior() {
    // b = 3 − 2a; three points appear with both responses, so that nothing is separated.
    let text = "y,a,b,c\n1,1,1,5\n0,2,-1,2\n1,3,-3,9\n0,5,-7,3\n1,0,3,2\n0,1,1,4\n0,1,1,5\n1,2,-1,2\n1,5,-7,3\n";
    let error = posterior(text, [FLAT; 4]).unwrap_err();
    let columns = "intercept, a, b".to_owned();
    assert_eq!(
        error,
        TargetError::DataCollinear {
            file: "some.csv".to_owned(),
            columns
        }
    );
    assert!(posterior(text, [10.0; 4]).is_ok());
    // A prior on one of the three is enough, on the fourth it is not.
    assert!(posterior(text, [FLAT, 10.0, FLAT, FLAT]).is_ok());
    assert!(matches!(
        posterior(text, [FLAT, FLAT, FLAT, 10.0]),
        Err(TargetError::DataCollinear { .. })
    ));
    // A constant column repeats the intercept, a column of zeros says nothing; the scale does not matter.
    for constant in ["7", "0", "1e-200", "1e150"] {
        let text = format!("y,a,b\n1,1,{constant}\n0,2,{constant}\n1,3,{constant}\n0,4,{constant}\n");
        assert!(
            matches!(posterior(&text, [FLAT; 3]), Err(TargetError::DataCollinear { .. })),
            "{constant}"
        );
    }
    // Nearly, but not quite: ages as years since 1900.
    assert!(posterior("y,year\n1,1950\n0,1951\n1,1952\n0,1953\n", [FLAT; 2]).is_ok());
}

#[test]
fn separated_responses_need_a_proper_prior() {
    let separated = "y,a,b\n0,1,3\n0,2,1\n0,2.5,4\n1,3,1\n1,4,4\n1,7,2\n";
    let error = posterior(separated, [FLAT; 3]).unwrap_err();
    assert!(
        matches!(&error, TargetError::DataSeparated { columns, .. } if columns.contains("a")),
        "{error}"
    );
    let told = |columns: &str| TargetError::DataSeparated {
        file: "some.csv".to_owned(),
        columns: columns.to_owned(),
    };
    let [one, two] = ["a", "a, b"].map(|columns| told(columns).to_string());
    assert!(
        one.contains(" by the column a,") && two.contains(" by the columns a, b,"),
        "{one}; {two}"
    );
    assert!(posterior(separated, [10.0; 3]).is_ok());
    // A tie on the boundary: separated all the same, the other coefficient settles.
    let touching = "y,a,b\n0,1,3\n0,2,1\n0,3,4\n1,3,1\n1,4,4\n1,7,2\n1,3,3\n0,3,2\n";
    assert!(matches!(
        posterior(touching, [FLAT; 3]),
        Err(TargetError::DataSeparated { .. })
    ));
    // One class only: the intercept separates.
    let error = posterior("y,a\n1,1\n1,2\n1,5\n", [FLAT; 2]).unwrap_err();
    assert!(
        matches!(&error, TargetError::DataSeparated { columns, .. } if columns.contains("intercept")),
        "{error}"
    );
    assert!(matches!(
        posterior("y\n0\n0\n", [FLAT; 1]),
        Err(TargetError::DataSeparated { .. })
    ));
    // A rare category in which every response is 1.
    let rare = "y,a\n1,1\n1,1\n0,0\n1,0\n0,0\n1,0\n0,0\n";
    assert!(matches!(
        posterior(rare, [FLAT; 2]),
        Err(TargetError::DataSeparated { .. })
    ));
    assert!(posterior(rare, [FLAT, 10.0]).is_ok());
    // Overlapping responses, with an outlier of great leverage.
    assert!(posterior("y,a\n0,1\n1,2\n0,3\n1,4\n1,4000\n", [FLAT; 2]).is_ok());
    // The outlier in a separated set.
    let far = "y,a\n0,1\n0,2\n1,3\n1,4\n1,4000\n";
    assert!(matches!(
        posterior(far, [FLAT; 2]),
        Err(TargetError::DataSeparated { .. })
    ));
}

#[test]
fn counts_are_read_and_checked() {
    let counts = |text: &str| CountData::from_csv_reader(text.as_bytes(), "some.csv");
    let data = counts("events,age\n0,2\n 17,3\n1e3,4\n4294967295,1\n").unwrap();
    assert_eq!(data.responses(), [0, 17, 1000, u32::MAX]);
    for bad in ["-1", "0.5", "4294967296", "-0.5", "1e300"] {
        let expected = format!(
            "some.csv, line 3: the response 'events' is '{bad}', it must be a whole number from 0 to 4294967295"
        );
        let error = counts(&format!("events,age\n1,2\n{bad},3\n")).unwrap_err();
        assert_eq!(error.to_string(), expected);
    }
    assert!(matches!(
        counts("events\nnan\n"),
        Err(TargetError::DataNotFinite { line: 2, .. })
    ));
}

#[test]
fn covariates_whose_squares_are_infinite_are_refused() {
    let read = |text: &str| RegressionData::from_csv_reader(text.as_bytes(), "some.csv");
    assert!(read("y,a\n0,1e150\n1,-1e150\n").is_ok());
    for bad in ["1e151", "-1e300"] {
        let error = read(&format!("y,a\n0,1\n1,{bad}\n")).unwrap_err().to_string();
        assert!(
            error.starts_with(&format!("some.csv, line 3: column 'a' holds '{bad}'")),
            "{error}"
        );
    }
    let error = RegressionData::new("rows", &["a"], &[(true, vec![1e151])]).unwrap_err();
    assert!(matches!(error, TargetError::OutOfRange { .. }), "{error}");
}

#[test]
fn counts_need_events_or_a_proper_prior() {
    let flat = |text: &str| {
        let data = CountData::from_csv_reader(text.as_bytes(), "some.csv").unwrap();
        PoissonRegression::<2>::with_prior("poisson", data, FLAT)
    };
    // Events at two values of the covariate fix both coefficients, whatever the size of the counts.
    assert!(flat("n,a\n0,1\n2,2\n1,3\n0,0\n").is_ok());
    assert!(flat("n,a\n0,1\n4000000000,2\n1000000,3\n0,0\n").is_ok());
    // At a single value they do, if there are rows without events on either side of it.
    assert!(flat("n,a\n0,1\n3,2\n0,3\n").is_ok());
    // No events at all, none in a category, none below the only value with events.
    for text in [
        "n,a\n0,1\n0,2\n0,3\n",
        "n,a\n0,1\n0,1\n2,0\n3,0\n",
        "n,a\n0,1\n0,1.5\n2,2\n3,2\n",
        "n,a\n0,3\n0,9\n2000000,2\n3,2\n",
    ] {
        assert!(
            matches!(flat(text), Err(TargetError::DataSeparated { .. })),
            "{text}: {:?}",
            flat(text).map(|_| ())
        );
        let data = CountData::from_csv_reader(text.as_bytes(), "some.csv").unwrap();
        assert!(PoissonRegression::<2>::with_prior("poisson", data, 10.0).is_ok());
    }
    assert!(matches!(
        flat("n,a\n1,2\n0,2\n3,2\n"),
        Err(TargetError::DataCollinear { .. })
    ));
}

#[test]
fn a_probit_regression_is_improper_where_a_logistic_one_is() {
    let flat = |text| ProbitRegression::<2>::with_prior("probit", read(text).unwrap(), FLAT);
    assert!(matches!(
        flat("y,a\n0,1\n0,2\n1,3\n1,4\n"),
        Err(TargetError::DataSeparated { .. })
    ));
    assert!(flat("y,a\n0,1\n1,2\n0,3\n1,4\n").is_ok());
    // An outlier far in the wrong tail.
    assert!(flat("y,a\n0,1\n1,2\n0,3\n1,4\n0,400\n").is_ok());
}

/// Five rows of two columns in a file, and the parameters that name it.
fn trial() -> (TempDir, PathBuf, Parameters) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("trial.csv");
    fs::write(&path, "y,a,b\n1,1,4\n0,2,1\n1,3,2\n0,5,3\n1,0,3\n").unwrap();
    let parameters = with(|p| p.data = Some(path.clone()));
    (folder, path, parameters)
}

#[test]
fn probit_and_poisson_read_files() {
    let (_folder, path, parameters) = trial();
    for name in ["probit", "poisson"] {
        assert_eq!(dimension_of(name, None, &parameters).unwrap(), 3);
        assert_eq!(build::<3>(name, &parameters).unwrap().name(), name);
        let error = dimension_of(name, Some(2), &parameters).unwrap_err();
        assert!(
            error.to_string().contains("3, the number of columns of"),
            "{name}: {error}"
        );
    }
    fs::write(&path, "y,a\n7,1\n").unwrap();
    assert_eq!(dimension_of("poisson", None, &parameters).unwrap(), 2);
    assert!(matches!(
        dimension_of("probit", None, &parameters),
        Err(TargetError::DataResponse { line: 2, .. })
    ));
}

#[test]
fn the_catalogue_reads_files() {
    let (_folder, path, parameters) = trial();
    assert_eq!(dimension_of("logistic", None, &parameters).unwrap(), 3);
    assert_eq!(dimension_of("logistic", Some(3), &parameters).unwrap(), 3);
    assert_eq!(build::<3>("logistic", &parameters).unwrap().name(), "logistic");
    let error = dimension_of("logistic", Some(4), &parameters).unwrap_err();
    assert!(
        error
            .to_string()
            .starts_with("dimension 4 does not fit target 'logistic': 3, the number of columns of")
    );
    assert!(build::<2>("logistic", &parameters).is_err());
    fs::write(&path, "y,a,b\n1,1,1\n0,2,2\n1,3,3\n0,5,5\n1,0,0\n").unwrap();
    assert!(build::<3>("logistic", &parameters).is_ok());
    let flat = Parameters {
        prior_standard_deviation: Some(FLAT),
        ..parameters
    };
    let error = build::<3>("logistic", &flat).map(|_| ()).unwrap_err();
    assert!(
        matches!(&error, TargetError::DataCollinear { columns, .. } if columns == "a, b"),
        "{error}"
    );
}

#[test]
fn priors_without_a_normal_precision_are_refused_with_their_range() {
    let (_folder, _path, parameters) = trial();
    let built = |s: f64| {
        let parameters = Parameters {
            prior_standard_deviation: Some(s),
            ..parameters.clone()
        };
        build::<3>("logistic", &parameters).map(|_| ())
    };
    for s in [1e-160, 7e-155, 7e153, 1e155, f64::MAX, 1e-320] {
        let error = built(s).unwrap_err();
        let message = error.to_string();
        assert!(
            matches!(error, TargetError::OutOfRange { value, .. } if value == s),
            "{message}"
        );
        assert!(message.contains("from 7.46e-155 to 6.70e153, or inf"), "{message}");
    }
    for s in [1e-3, 6.7e153] {
        assert_eq!(built(s), Ok(()), "{s}");
    }
}

#[test]
fn a_hessian_without_curvature_names_the_column() {
    let rows: Vec<(bool, Vec<f64>)> = (0..12)
        .map(|row| {
            let dose = f64::from(row * row % 7);
            (row % 3 == 0, vec![dose, dose * (1.0 + 1e-15 * f64::from(row))])
        })
        .collect();
    let data = RegressionData::new("memory", &["dose", "again"], &rows).unwrap();
    let error = LogisticRegression::<3>::with_prior("trial", data, 1e12)
        .map(|_| ())
        .unwrap_err();
    let message = error.to_string();
    assert!(
        message.starts_with("the negative Hessian of 'trial' is not positive definite (pivot ")
            && message.ends_with(" of column 'again' of memory)"),
        "{message}"
    );
}

#[test]
fn data_from_memory_are_checked() {
    let rows = vec![(true, vec![1.0]), (false, vec![2.0])];
    let data = RegressionData::new("memory", &["a"], &rows).unwrap();
    assert_eq!((data.rows(), data.dimension(), data.source()), (2, 2, "memory"));
    let ragged = vec![(true, vec![1.0]), (false, vec![])];
    assert!(matches!(
        RegressionData::new("memory", &["a"], &ragged),
        Err(TargetError::Length {
            expected: 1,
            found: 0,
            ..
        })
    ));
    let rows = vec![(true, vec![f64::NAN])];
    assert!(matches!(
        RegressionData::new("memory", &["a"], &rows),
        Err(TargetError::NotFinite { .. })
    ));
    assert!(matches!(
        RegressionData::new("memory", &["a"], &[]),
        Err(TargetError::DataNoRows { .. })
    ));
}
