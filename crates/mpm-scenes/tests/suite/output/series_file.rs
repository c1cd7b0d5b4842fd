//! Rows that grow.

use mpm_scenes::output::{SeriesFile, names};

#[test]
fn a_resumed_series_has_the_rows_of_the_checkpoint_to_the_bit() {
    let directory = tempfile::tempdir().expect("a directory");
    let columns = || vec!["time".to_owned(), "a".to_owned()];
    let mut file = SeriesFile::create(directory.path(), columns()).expect("writable");
    let rows = [[0.0, 0.1 + 0.2], [1e-300, f64::NAN], [0.5, -0.0], [1.0, 1e300]];
    for row in rows {
        file.push(row.to_vec()).expect("writable");
    }
    let path = directory.path().join(names::SERIES);
    let whole = std::fs::read_to_string(&path).expect("there");
    std::fs::write(&path, whole.clone() + "1.5,0.").expect("writable");
    let mut resumed = SeriesFile::resume(directory.path(), columns(), 3).expect("three rows");
    resumed.push(rows[3].to_vec()).expect("writable");
    assert_eq!(std::fs::read_to_string(&path).expect("there"), whole);
    assert!(SeriesFile::resume(directory.path(), columns(), 9).is_err());
    assert!(SeriesFile::resume(directory.path(), vec!["time".to_owned()], 1).is_err());
}
