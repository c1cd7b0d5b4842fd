//! Files of named tensors.

use mpm_rom::tensor_file::{TensorFault, TensorFileError, TensorReader, TensorWriter};

fn small(path: &std::path::Path) {
    let mut writer = TensorWriter::default();
    writer.add("a", &[2, 3], (0..6).map(f64::from));
    writer.add("b", &[1], [f64::NAN]);
    writer.write(path, ("test", 3), &vec![1, 2]).unwrap();
}

#[test]
fn what_is_written_is_read() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("t.safetensors");
    small(&path);
    let file = TensorReader::open(&path, ("test", 3)).unwrap();
    assert_eq!(file.header::<Vec<i32>>().unwrap(), [1, 2]);
    assert_eq!(file.tensor("a", &[2, 3]).unwrap(), [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]);
    assert_eq!(
        std::fs::read_dir(directory.path()).unwrap().count(),
        1,
        "no partial file"
    );
}

#[test]
fn every_fault_has_its_error() {
    use TensorFault as E;
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("t.safetensors");
    small(&path);
    let open = |kind, version| TensorReader::open(&path, (kind, version)).map_err(|error| *error.fault);
    assert!(matches!(open("other", 3), Err(E::Kind { expected: "other", .. })));
    assert!(matches!(
        open("test", 4),
        Err(E::Version {
            found: 3,
            expected: 4,
            ..
        })
    ));
    let file = open("test", 3).unwrap();
    let fault = |error: TensorFileError| *error.fault;
    assert!(matches!(file.header::<String>().map_err(fault), Err(E::Header(_))));
    assert!(matches!(file.tensor("c", &[1]).map_err(fault), Err(E::Missing(name)) if name == "c"));
    assert!(matches!(file.tensor("a", &[3, 2]).map_err(fault), Err(E::Shape { found, .. }) if found == [2, 3]));
    assert!(matches!(
        file.tensor("b", &[1]).map_err(fault),
        Err(E::NotFinite { entry: 0, .. })
    ));
    let bytes = std::fs::read(&path).unwrap();
    for length in [0, 4, 60, bytes.len() - 1] {
        std::fs::write(&path, &bytes[..length]).unwrap();
        assert!(matches!(open("test", 3), Err(E::Damaged(_))), "{length} bytes");
    }
    assert!(matches!(
        TensorReader::open(&directory.path().join("none"), ("test", 3)).map_err(fault),
        Err(E::Unreadable(_))
    ));
    let mut writer = TensorWriter::default();
    writer.add("a", &[2], [1.0]);
    assert!(matches!(
        writer.write(&path, ("test", 3), &()).map_err(fault),
        Err(E::Damaged(_))
    ));
    assert!(matches!(
        TensorWriter::default()
            .write(&directory.path().join("no/x"), ("t", 1), &())
            .map_err(fault),
        Err(E::Unwritable(_))
    ));
}
