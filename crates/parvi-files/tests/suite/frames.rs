//! Frames of a run that moves particles.

use parvi::{Run, SvgdOptions};
use parvi_files::{FrameWriter, OutputDirectory, Particles};
use parvi_targets::{Frame, Gaussian};

#[test]
fn frames_of_an_earlier_run_go_and_other_files_stay() {
    let root = tempfile::tempdir().unwrap();
    for name in ["frame_000099.vtp", "notes.txt"] {
        std::fs::write(root.path().join(name), "").unwrap();
    }
    let directory = OutputDirectory::create("frames", root.path()).unwrap();
    let unexpected = |notice: &str| panic!("{notice}");
    let mut frames = FrameWriter::new(directory, 5, Vec::new(), false, unexpected).unwrap();
    let options = SvgdOptions {
        steps: Some(10),
        ..SvgdOptions::default()
    };
    let (target, run) = (Gaussian::<2>::standard(), Run::new(8, 0));
    let samples = options.sample(&target, &Frame::identity(), &run, &mut frames).unwrap();
    assert!(frames.failure().is_none());
    assert_eq!(frames.finish(&Particles::from(&samples), samples.steps).unwrap(), 4);

    let entries = std::fs::read_dir(root.path()).unwrap();
    let mut names: Vec<String> = entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort_unstable();
    let frames = ["000000", "000005", "000010", "returned"];
    let mut expected = ["frames.csv", "frames.pvd", "notes.txt"].map(str::to_owned).to_vec();
    expected.extend(frames.map(|frame| format!("frame_{frame}.vtp")));
    expected.extend(frames.map(|frame| format!("positions_{frame}.npy")));
    expected.sort_unstable();
    // Of SVGD there are positions alone.
    assert_eq!(names, expected);
}
