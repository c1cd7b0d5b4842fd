//! Pictures of a run.

use parvi::{Run, SvgdOptions};
use parvi_files::pictures::{History, Known, Subject, look};
use parvi_files::{Outcome, OutputDirectory};
use parvi_targets::{Frame, Gaussian};

#[test]
fn a_run_with_a_trace_in_the_plane_has_all_pictures_but_that_of_a_survey() {
    let root = tempfile::tempdir().unwrap();
    let directory = OutputDirectory::create("plots", root.path()).unwrap();
    std::fs::write(directory.file("survey.svg"), "of an earlier run").unwrap();
    let options = SvgdOptions {
        steps: Some(10),
        trace_every: 2,
        ..SvgdOptions::default()
    };
    let (target, mut history) = (Gaussian::<2>::standard(), History::default());
    let samples = options.sample(&target, &Frame::identity(), &Run::new(64, 0), &mut history);
    let known = look::<2>(&target, None);
    assert!(matches!(known, Known::Quadrature(_)));
    let names = Subject {
        target: "gaussian",
        coordinates: &["x_{1}".to_owned(), "x_{2}".to_owned()],
        known: &known,
        method: "svgd",
        outcome: &Outcome::from(samples.unwrap()),
        history: &history,
        untraced: None,
        notice: |notice| panic!("{notice}"),
    }
    .draw(&directory)
    .unwrap();
    assert_eq!(names, ["histogram.svg", "corner.svg", "trace.svg", "strip.svg"]);
    assert!(names.iter().all(|name| directory.file(name).exists()));
    assert!(!directory.file("survey.svg").exists());
}
