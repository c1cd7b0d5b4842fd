//! Errors name the file, and the flag where one asked for it.

use parvi_files::{AtomicFile, NumberTable, OutputDirectory, ParticleFormat, particles_csv};

#[test]
fn whatever_is_wrong_is_named() {
    let directory = tempfile::tempdir().unwrap();
    let path = |name: &str| directory.path().join(name);
    std::fs::write(path("words.csv"), "x1,x2\n1,two\n").unwrap();
    let words = path("words.csv");
    let shown = words.display();

    let error = NumberTable::read("start", &words).unwrap_err();
    let expected = format!("--start: {shown}: line 2: 'two' is not a number");
    assert_eq!((error.to_string(), error.is_of_request()), (expected, false));

    for name in ["none.csv", "none.npy"] {
        let error = NumberTable::read("start", &path(name)).unwrap_err().to_string();
        let begins = format!("--start: {}: cannot be read: ", path(name).display());
        assert!(error.starts_with(&begins) || cfg!(not(feature = "npy")), "{error}");
    }

    let error = NumberTable::read("start", &path("x.txt")).unwrap_err();
    let expected = format!(
        "--start {}: the extension must be .csv or .npy",
        path("x.txt").display()
    );
    assert_eq!((error.to_string(), error.is_of_request()), (expected, true));

    let error = OutputDirectory::create("frames", &words).err().unwrap();
    let expected = format!("--frames: {shown} is a file, and a directory is needed");
    assert_eq!((error.to_string(), error.is_of_request()), (expected, true));

    let error = ParticleFormat::of("pool", &path("x.txt")).unwrap_err();
    let expected = format!("--pool {}: the extension must be .csv or .npy", path("x.txt").display());
    assert_eq!((error.to_string(), error.is_of_request()), (expected, true));

    let error = particles_csv::read(&words).unwrap_err();
    let expected = format!("{shown}: line 2: 'two' is not a number");
    assert_eq!((error.to_string(), error.is_of_request()), (expected, false));

    let nowhere = path("none").join("x.csv");
    let error = AtomicFile::create(&nowhere).err().unwrap();
    let begins = error
        .to_string()
        .starts_with(&format!("cannot write {}: ", nowhere.display()));
    assert!(begins && !error.is_of_request(), "{error}");
}
