//! `parvi sample --frames`: files of the particles on their way.

#![cfg(unix)]

use std::collections::HashMap;
use std::path::Path;
use std::time::Duration;

use crate::support::{assert_refused, files, parvi, sampled_regression, started, stderr, succeeds, value};

/// A `.vtp` file taken apart as a reader of VTK's XML does it.
struct Vtp {
    /// Attributes of the piece.
    piece: HashMap<String, String>,
    /// The arrays by their names: type, components, bytes.
    arrays: HashMap<String, (String, usize, Vec<u8>)>,
    /// Field data.
    fields: HashMap<String, String>,
}

fn attributes(tag: &str) -> HashMap<String, String> {
    let parts: Vec<&str> = tag.split('"').collect();
    parts
        .chunks_exact(2)
        .map(|pair| {
            let name = pair[0].trim().trim_end_matches('=');
            let name = name.rsplit(' ').next().unwrap();
            (name.to_owned(), pair[1].to_owned())
        })
        .collect()
}

impl Vtp {
    /// Checks on the way that tags balance, that arrays lie one behind the other and that the file ends behind the last one.
    fn read(path: &Path) -> Self {
        let bytes = std::fs::read(path).unwrap();
        let find = |mark: &[u8]| bytes.windows(mark.len()).position(|window| window == mark);
        let mark = b"<AppendedData encoding=\"raw\">\n_";
        let begin = find(mark).unwrap() + mark.len();
        let text = std::str::from_utf8(&bytes[..begin - 1]).unwrap();
        let (mut open, mut tags) = (Vec::new(), Vec::new());
        for part in text.split('<').skip(1) {
            let (tag, content) = part.split_once('>').unwrap();
            if let Some(name) = tag.strip_prefix('/') {
                assert_eq!(open.pop(), Some(name.to_owned()));
            } else if !tag.starts_with('?') {
                let name = tag.split([' ', '/']).next().unwrap().to_owned();
                tags.push((name.clone(), attributes(tag), content.to_owned()));
                if !tag.ends_with('/') {
                    open.push(name);
                }
            }
        }
        assert_eq!(open, ["VTKFile", "AppendedData"]);
        let file = &tags[0].1;
        assert_eq!(
            (&*file["type"], &*file["byte_order"], &*file["header_type"]),
            ("PolyData", "LittleEndian", "UInt64")
        );
        let (mut arrays, mut fields, mut end) = (HashMap::new(), HashMap::new(), 0);
        for (_, tag, content) in tags.iter().filter(|(name, ..)| name == "DataArray") {
            let name = tag["Name"].clone();
            if tag["format"] == "ascii" {
                fields.insert(name, content.trim().to_owned());
                continue;
            }
            assert_eq!(tag["offset"].parse::<usize>().unwrap(), end, "{name}");
            let data = &bytes[begin + end..];
            let length = u64::from_le_bytes(data[..8].try_into().unwrap()) as usize;
            let array = data[8..8 + length].to_vec();
            let components = tag["NumberOfComponents"].parse().unwrap();
            assert!(arrays.insert(name, (tag["type"].clone(), components, array)).is_none());
            end += 8 + length;
        }
        assert_eq!(&bytes[begin + end..], b"\n</AppendedData>\n</VTKFile>\n");
        let piece = tags.iter().find(|(name, ..)| name == "Piece").unwrap().1.clone();
        let this = Self { piece, arrays, fields };
        this.check();
        this
    }

    /// As many entries as points everywhere, and one vertex for each.
    fn check(&self) {
        let count = self.count();
        let number = |key: &str| self.piece[key].parse::<usize>().unwrap();
        assert_eq!(number("NumberOfVerts"), count);
        for none in ["NumberOfLines", "NumberOfStrips", "NumberOfPolys"] {
            assert_eq!(number(none), 0);
        }
        for (name, (kind, components, bytes)) in &self.arrays {
            assert!(["Float64", "Int64"].contains(&kind.as_str()), "{name}: {kind}");
            assert_eq!(bytes.len(), 8 * components * count, "{name}");
        }
        assert_eq!(self.integers("connectivity"), Vec::from_iter(0..count as i64));
        assert_eq!(self.integers("offsets"), Vec::from_iter(1..=count as i64));
        assert_eq!(self.integers("particle"), Vec::from_iter(0..count as i64));
    }

    fn count(&self) -> usize {
        self.piece["NumberOfPoints"].parse().unwrap()
    }

    fn words(&self, name: &str) -> Vec<[u8; 8]> {
        self.arrays[name].2.as_chunks().0.to_vec()
    }

    fn floats(&self, name: &str) -> Vec<f64> {
        self.words(name).into_iter().map(f64::from_le_bytes).collect()
    }

    fn integers(&self, name: &str) -> Vec<i64> {
        self.words(name).into_iter().map(i64::from_le_bytes).collect()
    }
}

fn npy(path: &Path) -> (Vec<u64>, Vec<f64>) {
    let bytes = std::fs::read(path).unwrap();
    let array = npyz::NpyFile::new(bytes.as_slice()).unwrap();
    (array.shape().to_vec(), array.into_vec().unwrap())
}

/// The frames of the table and those of the collection, with its times.
fn index(directory: &Path) -> (Vec<String>, Vec<(f64, String)>) {
    let table = std::fs::read_to_string(directory.join("frames.csv")).unwrap();
    let names = table
        .lines()
        .skip(1)
        .map(|row| row.split(',').next().unwrap().to_owned());
    let text = std::fs::read_to_string(directory.join("frames.pvd")).unwrap();
    assert!(text.starts_with("<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\""));
    assert!(text.ends_with("  </Collection>\n</VTKFile>\n"));
    let entries = text.lines().filter(|line| line.contains("<DataSet"));
    let entries = entries.map(|line| {
        let attributes = attributes(line);
        (attributes["timestep"].parse().unwrap(), attributes["file"].clone())
    });
    (names.collect(), entries.collect())
}

#[test]
fn a_run_of_200_steps_has_frames_that_paraview_opens() {
    let root = tempfile::tempdir().unwrap();
    let line =
        "sample --target banana --particles 60 --method paper-apic --steps 200 --out x.npy --frames f --every 25";
    let output = succeeds(root.path(), line);
    assert_eq!(value(&output, "frames").unwrap(), "10");
    let directory = root.path().join("f");
    let (names, collection) = index(&directory);
    let steps: Vec<String> = (0..=200).step_by(25).map(|step| format!("{step:06}")).collect();
    assert_eq!(names[..9], steps);
    assert_eq!(names[9], "returned");
    let times: Vec<f64> = collection.iter().map(|(time, _)| *time).collect();
    assert_eq!(times, [0.0, 25.0, 50.0, 75.0, 100.0, 125.0, 150.0, 175.0, 200.0, 201.0]);
    for (name, (time, file)) in names.iter().zip(&collection) {
        assert_eq!(*file, format!("frame_{name}.vtp"));
        let vtp = Vtp::read(&directory.join(file));
        assert_eq!(vtp.count(), 60);
        assert_eq!(vtp.fields["TimeValue"].parse(), Ok(*time));
        let (shape, positions) = npy(&directory.join(format!("positions_{name}.npy")));
        assert_eq!(shape, [60, 2]);
        let padded: Vec<f64> = positions.chunks(2).flat_map(|x| [x[0], x[1], 0.0]).collect();
        assert_eq!(vtp.floats("position"), padded);
        let column: Vec<f64> = positions.iter().skip(1).step_by(2).copied().collect();
        assert_eq!(vtp.floats("x2"), column);
        if name == "returned" {
            assert_eq!(positions, npy(&root.path().join("x.npy")).1);
            assert!(!vtp.arrays.contains_key("velocity"));
            continue;
        }
        let (shape, velocities) = npy(&directory.join(format!("velocities_{name}.npy")));
        assert_eq!((shape, vtp.arrays["velocity"].1), (vec![60, 2], 3));
        assert_eq!(vtp.floats("velocity")[3..5], velocities[2..4]);
        let (shape, gradients) = npy(&directory.join(format!("deformation_gradients_{name}.npy")));
        assert_eq!((shape, vtp.arrays["deformation_gradient"].1), (vec![60, 2, 2], 9));
        let f = &gradients[..4];
        assert_eq!(
            vtp.floats("deformation_gradient")[..9],
            [f[0], f[1], 0.0, f[2], f[3], 0.0, 0.0, 0.0, 1.0]
        );
    }
    // Nothing but frames and their tables: four files each, two for what was returned.
    assert_eq!(files(&directory).len(), 9 * 4 + 2 + 2);
}

#[test]
fn four_dimensions_have_all_coordinates_at_their_points() {
    let root = tempfile::tempdir().unwrap();
    let line = "sample --target wells --dim 4 --particles 40 --method svgd --steps 20 --out x.npy --frames f";
    succeeds(root.path(), line);
    let (names, _) = index(&root.path().join("f"));
    assert_eq!(names, ["000000", "000010", "000020", "returned"]);
    let vtp = Vtp::read(&root.path().join("f/frame_000020.vtp"));
    let positions = npy(&root.path().join("x.npy")).1;
    let first: Vec<f64> = positions.chunks(4).flat_map(|x| [x[0], x[1], x[2]]).collect();
    assert_eq!(vtp.floats("position"), first);
    let last: Vec<f64> = positions.chunks(4).map(|x| x[3]).collect();
    assert_eq!(vtp.floats("x4"), last);
    assert!(!vtp.arrays.contains_key("velocity"));
}

#[test]
fn coordinates_of_data_keep_their_names() {
    let root = sampled_regression("y,a & b,velocity", "--survey off --frames f");
    let vtp = Vtp::read(&root.path().join("f/frame_000000.vtp"));
    for name in ["intercept", "a &amp; b", "x3", "velocity"] {
        assert!(vtp.arrays.contains_key(name), "{name}");
    }
}

#[test]
fn a_method_that_moves_nothing_has_one_frame_and_says_so() {
    let root = tempfile::tempdir().unwrap();
    let line = "sample --target banana --particles 30 --method iid --out x.npy --frames new/f --every 3";
    let output = succeeds(root.path(), line);
    assert!(
        stderr(&output).contains("no particles have moved"),
        "{}",
        stderr(&output)
    );
    let directory = root.path().join("new/f");
    assert_eq!(index(&directory).1, [(0.0, "frame_returned.vtp".to_owned())]);
    let same = npy(&directory.join("positions_returned.npy")) == npy(&root.path().join("x.npy"));
    assert!(same);
}

#[test]
fn weights_are_in_the_last_frame_and_earlier_frames_go() {
    let root = tempfile::tempdir().unwrap();
    let first = "sample --target banana --particles 30 --method svgd --steps 20 --out x.npy --frames f";
    succeeds(root.path(), first);
    std::fs::write(root.path().join("f/frame_mine.vtp"), "mine").unwrap();
    succeeds(
        root.path(),
        "sample --target banana --particles 30 --weighted on --out x.npy --frames f",
    );
    let expected = [
        "frame_mine.vtp",
        "frame_returned.vtp",
        "frames.csv",
        "frames.pvd",
        "positions_returned.npy",
        "weights_returned.npy",
    ];
    assert_eq!(files(&root.path().join("f")), expected);
    let weights = npy(&root.path().join("f/weights_returned.npy"));
    assert_eq!(weights.0, [30]);
    assert!((weights.1.iter().sum::<f64>() - 1.0).abs() < 1e-12);
    let vtp = Vtp::read(&root.path().join("f/frame_returned.vtp"));
    assert_eq!(vtp.floats("weight"), weights.1);
}

#[test]
fn a_run_that_fails_leaves_the_frames_that_it_made() {
    let root = tempfile::tempdir().unwrap();
    let line = "sample --target ring --particles 60 --method paper-pic --guards off --out x.npy --frames f --every 1";
    let output = parvi(root.path(), line);
    assert_refused(&output, &["step"]);
    assert_eq!(files(root.path()), ["f"]);
    let (names, _) = index(&root.path().join("f"));
    assert_eq!(names[0], "000000");
    assert!(!names.contains(&"returned".to_owned()));
}

const LONG: &str =
    "sample --target mixture-2 --dim 2 --particles 400 --evaluations 3000 --rounds 1 --steps 4000 --seed 3";

/// Runs the long run with frames in `f` and a checkpoint until a frame of step 1000 exists, and kills it.
fn killed(root: &Path) -> String {
    let line = format!("{LONG} --out x.npy --checkpoint state --checkpoint-every 8");
    let frame = root.join("f/frame_001000.vtp");
    let mut child = started(root, &format!("{line} --frames f --every 500"), || frame.exists());
    std::thread::sleep(Duration::from_millis(20));
    let running = child.try_wait().unwrap().is_none();
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(running && root.join("state").exists(), "it was never killed");
    line
}

#[test]
fn a_resumed_run_continues_its_frames() {
    let root = tempfile::tempdir().unwrap();
    succeeds(
        root.path(),
        &format!("{LONG} --out whole.npy --frames whole --every 500"),
    );
    let line = killed(root.path());
    succeeds(root.path(), &format!("{line} --frames f --every 500"));
    let (one, other) = (root.path().join("f"), root.path().join("whole"));
    // Whoever kills may leave a file that was being written.
    let mut names = files(&one);
    names.retain(|name| !name.ends_with(".partial"));
    assert_eq!(names, files(&other));
    for name in names {
        let read = |directory: &Path| std::fs::read(directory.join(&name)).unwrap();
        assert!(read(&one) == read(&other), "{name}");
    }
}

#[test]
fn a_resumed_run_without_its_frames_says_so() {
    let root = tempfile::tempdir().unwrap();
    let line = killed(root.path());
    let resumed = succeeds(root.path(), &format!("{line} --frames other --every 1000"));
    let message = stderr(&resumed);
    assert!(
        message.contains("--frames other: the run goes on from step"),
        "{message}"
    );
    let (names, _) = index(&root.path().join("other"));
    assert!(!names.contains(&"000000".to_owned()) && names.contains(&"004000".to_owned()));
}

#[test]
fn directories_that_cannot_be_used() {
    let root = tempfile::tempdir().unwrap();
    std::fs::write(root.path().join("taken"), "mine").unwrap();
    let refused = |flags: &str, parts: &[&str]| {
        let line = format!("sample --target banana --particles 30 --out x.csv {flags}");
        assert_refused(&parvi(root.path(), &line), parts);
        assert_eq!(files(root.path()), ["taken"], "{flags}");
        assert_eq!(std::fs::read_to_string(root.path().join("taken")).unwrap(), "mine");
    };
    refused("--frames f --every 0", &["--every", "0", "from 1"]);
    refused("--frames f --every -2", &["--every", "-2"]);
    refused("--frames f --every x", &["--every", "x"]);
    refused("--every 5", &["--frames"]);
    for flag in ["frames", "plots"] {
        refused(&format!("--{flag} taken"), &[&format!("--{flag}: taken is a file")]);
        refused(&format!("--{flag} taken/below"), &["taken/below"]);
        refused(
            &format!("--{flag} x.csv"),
            &[&format!("--{flag}: x.csv is the file of --out")],
        );
        // Nothing that was made for the run stays where the run is refused.
        refused(&format!("--{flag} new --spacing -1"), &["--spacing", "-1"]);
        refused(
            &format!("--{flag} new --method paper-pic --poissons-ratio 0.7"),
            &["0.7"],
        );
    }
}
