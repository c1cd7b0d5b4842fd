//! Numbers that are read from a run.

use std::ops::ControlFlow;
use std::path::PathBuf;

use mpm_scenes::reading::{FinishedRun, Reading, ReadingError};
use mpm_scenes::variation::{PreparedScene, SceneDocument};
use mpm_scenes::{Observer, Outcome, Progress, Series, Summary, ValidationRow};

const BAR: &str = r#"
    title = "bar"
    dimension = 1
    domain = { lower = [0.0], upper = [2.0] }
    grid = { spacing = 0.4 }
    time = { end = 2.0 }
    materials.bar = { law = "linear-elastic", density = 1.0, young_modulus = 1.0, poisson_ratio = 0.0 }
    bodies = [{ name = "bar", material = "bar", shape = { kind = "box", lower = [0.0], upper = [1.0] } }]
    output = { interval = 1.0 }
"#;

fn reading(text: &str) -> Reading {
    toml::from_str(text).unwrap()
}

/// The field that does not fit, and why.
fn refused<T>(result: Result<T, ReadingError>) -> (&'static str, String) {
    match result {
        Err(ReadingError::Unfit { field, message }) => (field, message),
        _ => panic!("a field that does not fit"),
    }
}

fn scene() -> PreparedScene {
    PreparedScene::new(SceneDocument::parse(BAR, "bar.toml".as_ref()).unwrap()).unwrap()
}

fn run<'a>(prepared: &'a PreparedScene, validation: &[ValidationRow]) -> FinishedRun<'a> {
    let mut series = Series::new(vec!["time".to_owned(), "upper_x".to_owned()]);
    for (time, x) in [(0.0, 0.9), (1.0, 2.5), (2.0, 2.25)] {
        series.push(vec![time, x]);
    }
    FinishedRun {
        prepared,
        directory: PathBuf::new(),
        summary: Summary {
            outcome: Outcome::Finished,
            steps: 1,
            steps_here: 1,
            time: 2.0,
            particles: 1,
            resumed_at: None,
            validation: validation.to_vec(),
        },
        series,
    }
}

/// Stops a run after its first step.
struct Impatient;

impl Observer for Impatient {
    fn after_step(&mut self, _: Progress) -> ControlFlow<()> {
        ControlFlow::Break(())
    }
}

#[test]
fn a_run_is_finished_unless_it_was_stopped() {
    let (root, scene) = (tempfile::tempdir().unwrap(), scene());
    let run = |observer: &mut dyn Observer| FinishedRun::of(&scene, root.path().to_owned(), observer).unwrap();
    assert!(run(&mut Impatient).is_none());
    let finished = run(&mut ()).unwrap();
    assert!(finished.summary.resumed_at.is_some());
    assert_eq!(finished.series.column("time").unwrap().last(), Some(&2.0));
}

#[test]
fn equal_scenes_have_equal_fingerprints() {
    let mut document = scene().document;
    document.put("grid.spacing", 0.5.into()).unwrap();
    let changed = PreparedScene::new(document.clone()).unwrap().fingerprint;
    assert!(changed.len() == 16 && changed != scene().fingerprint);
    document.put("grid.spacing", 0.4.into()).unwrap();
    assert_eq!(PreparedScene::new(document).unwrap().fingerprint, scene().fingerprint);
}

#[test]
fn a_column_is_shifted_by_numbers_of_the_scene() {
    let run_out = "column = \"upper_x\"\nfactor = 0.5\noffset = -1.0\noffsets = { \"grid.spacing\" = 0.25 }";
    let value = |take: &str| {
        let reading = reading(&format!("{run_out}{take}"));
        reading.read(&run(&scene(), &[]), None).unwrap().value
    };
    assert!((value("") - 0.5 * (2.25 - 1.0 + 0.1)).abs() < 1e-15);
    assert!((value("\ntake = \"largest\"") - 0.5 * (2.5 - 1.0 + 0.1)).abs() < 1e-15);
    assert!((value("\ntake = \"least\"") - 0.5 * (0.9 - 1.0 + 0.1)).abs() < 1e-15);
    let over = value("\nover = \"upper_x + upper_x\"");
    assert!((over - 0.5 * (2.25 / 5.0 - 1.0 + 0.1)).abs() < 1e-15);
}

#[test]
fn a_quantity_brings_what_it_is_compared_with() {
    let rows = [ValidationRow::near("period", 1.01, 1.0, 0.02)];
    let reading = reading("quantity = \"period\"\nfactor = -100.0");
    let measured = reading.read(&run(&scene(), &rows), None).unwrap();
    assert_eq!(
        (measured.value, measured.reference, measured.tolerance),
        (-101.0, Some(-100.0), Some(2.0))
    );
}

#[test]
fn what_is_missing_is_named_with_what_there_is() {
    let rows = [ValidationRow::near("period", 1.01, 1.0, 0.02)];
    let message = |text: &str, rows: &[ValidationRow]| refused(reading(text).read(&run(&scene(), rows), None));
    assert_eq!(
        message("quantity = \"tip\"", &rows),
        ("quantity", "`tip` is none of `period`".to_owned())
    );
    assert!(message("quantity = \"tip\"", &[]).1.contains("no reference"));
    assert_eq!(
        message("column = \"y\"", &rows),
        ("column", "`y` is none of `time`, `upper_x`".to_owned())
    );
    assert_eq!(message("column = \"time\"\nover = \"z\"", &rows).0, "over");
    assert_eq!(message("column = \"time\"\noffsets = { h = 1.0 }", &rows).0, "offsets");
    assert!(
        message("particles = \"displacement-error\"", &[])
            .1
            .contains("no frames")
    );
}

#[test]
fn half_a_reading_is_refused() {
    for (text, field) in [
        ("take = \"last\"", ""),
        ("column = \"y\"\noffset = nan", ""),
        ("quantity = \"a\"\ncolumn = \"b\"", ""),
        ("quantity = \"a\"\ntake = \"last\"", "take"),
        ("column = \"a\"\ntake = \"difference\"", "against"),
        ("column = \"a\"\nagainst = { label = \"b\" }", "against"),
    ] {
        assert_eq!(refused(reading(text).check()).0, field, "{text}");
    }
    let difference = "column = \"a\"\ntake = \"largest-difference\"\nagainst = { label = \"b\" }";
    assert!(reading(difference).check().is_ok());
    assert!(reading("particles = \"displacement-error\"").check().is_ok());
}
