//! Rows that grow.

use mpm_scenes::output::{SeriesFile, names, read_series};

#[test]
fn a_resumed_series_has_the_rows_of_the_checkpoint_to_the_bit() {
    let directory = tempfile::tempdir().expect("a directory");
    let columns = || vec!["time".to_owned(), "a".to_owned()];
    let mut file = SeriesFile::create(directory.path(), columns()).expect("writable");
    let rows = [[0.0, 0.1 + 0.2], [0.25, f64::NAN], [0.5, -0.0], [0.75, 1e300]];
    let number_at = |time: f64| Some((4.0 * time) as u64);
    let resume = |columns, rows| SeriesFile::resume(directory.path(), columns, rows, &number_at);
    for row in rows {
        file.push(row.to_vec()).expect("writable");
    }
    let path = directory.path().join(names::SERIES);
    let whole = std::fs::read_to_string(&path).expect("there");
    std::fs::write(&path, whole.clone() + "1.5,0.").expect("writable");
    let mut resumed = resume(columns(), 3).expect("three rows");
    resumed.push(rows[3].to_vec()).expect("writable");
    assert_eq!(std::fs::read_to_string(&path).expect("there"), whole);
    std::fs::write(&path, whole.clone() + "1.5,\u{0}\n").expect("writable");
    assert!(resume(columns(), 4).is_ok());
    assert!(resume(columns(), 9).is_err());
    assert!(resume(vec!["time".to_owned()], 1).is_err());
}

#[test]
fn a_line_that_is_no_row_is_named() {
    let directory = tempfile::tempdir().expect("a directory");
    let path = directory.path().join(names::SERIES);
    let read = |text: &str| {
        std::fs::write(&path, text).expect("writable");
        read_series(directory.path())
    };
    let rows = |text: &str| read(text).expect("a series").rows().len();
    assert_eq!(
        [rows("time,a\n"), rows("time,a\n0,1\n1,2"), rows("time,a\n0,NaN\n")],
        [0, 1, 1]
    );
    for (text, expected) in [
        ("", "line 1: no columns"),
        (
            "0.0,1.0\n1.0,2.0\n",
            "line 1: the first column is `0.0`: must be `time`",
        ),
        ("time,a\n0.0,1.0\n1.0,x\n2.0,3.0\n", "line 3: a = `x`: must be a number"),
        ("time,a\n0.0\n", "line 2: the number of values is 1, that of columns 2"),
        (
            "time,a\n0.0,1.0,2.0\n",
            "line 2: the number of values is 3, that of columns 2",
        ),
        ("time,a\n0.0,\n", "line 2: a = ``: must be a number"),
    ] {
        let message = read(text).expect_err(text).to_string();
        assert_eq!(message, format!("{}, {expected}", path.display()));
    }
}
