use super::*;
use crate::tensor_file::TensorFileError;

fn frame(scale: f64) -> Frame<2> {
    Frame {
        time: scale - 1.0,
        positions: vec![[scale, 0.0], [0.0, -scale]],
        deformation_gradients: vec![Matrix::IDENTITY * scale; 2],
        velocities: vec![[0.25, scale], [1.0, 2.0]],
    }
}

fn body() -> Body<2> {
    Body {
        scene: "two points".to_owned(),
        reference: vec![[1.0, 0.0], [0.0, -1.0]],
        centroid: [3.0, 4.0],
        interval: 0.1,
        density: 1000.0,
        parameters: vec!["gravity".to_owned(), "angle".to_owned()],
    }
}

fn runs() -> Vec<Run<2>> {
    let run = |parameter: f64, frames: usize| Run {
        parameters: vec![parameter, 0.5],
        frames: (0..frames).map(|n| frame(1.0 + 0.1 * n as f64)).collect(),
    };
    vec![run(1.0, 3), run(2.0, 1)]
}

fn refused(change: impl FnOnce(&mut Body<2>, &mut Vec<Run<2>>)) -> SnapshotsError {
    let (mut body, mut runs) = (body(), runs());
    change(&mut body, &mut runs);
    Snapshots::new(body, runs).unwrap_err()
}

#[test]
fn a_file_reads_back_to_the_same_bits() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("snapshots.safetensors");
    let snapshots = Snapshots::new(body(), runs()).unwrap();
    snapshots.write(&path).unwrap();
    assert_eq!(Snapshots::read(&path).unwrap(), snapshots);
    let three = Snapshots::<3>::read(&path);
    assert!(matches!(
        three,
        Err(TensorFileError::Dimension {
            found: 2,
            expected: 3,
            ..
        })
    ));
}

#[test]
fn a_selection_keeps_the_order_asked_for() {
    let snapshots = Snapshots::new(body(), runs()).unwrap();
    let selected = snapshots.select(&[1, 0, 1]).unwrap();
    let parameters: Vec<_> = selected.runs().iter().map(|run| run.parameters[0]).collect();
    assert_eq!(parameters, [2.0, 1.0, 2.0]);
    assert_eq!(
        snapshots.select(&[2]),
        Err(SnapshotsError::NoSuchRun { number: 2, runs: 2 })
    );
    assert_eq!(snapshots.select(&[]), Err(SnapshotsError::Empty { what: "runs" }));
}

#[test]
fn faults_are_named_with_run_frame_and_point() {
    use SnapshotsError as E;
    assert_eq!(refused(|b, _| b.reference.clear()), E::Empty { what: "points" });
    assert_eq!(refused(|_, r| r.clear()), E::Empty { what: "runs" });
    assert_eq!(refused(|_, r| r[1].frames.clear()), E::Empty { what: "frames" });
    let time = f64::NAN;
    assert!(matches!(
        refused(|_, r| r[0].frames[1].time = time),
        E::Time { run: 0, frame: 1, .. }
    ));
    assert_eq!(
        refused(|_, r| r[0].frames[2].time = 0.05),
        E::Time {
            run: 0,
            frame: 2,
            time: 0.05
        }
    );
    let field = "interval";
    assert_eq!(refused(|b, _| b.interval = 0.0), E::NotPositive { field, value: 0.0 });
    assert!(matches!(
        refused(|b, _| b.density = f64::NAN),
        E::NotPositive { field: "density", .. }
    ));
    assert!(matches!(
        refused(|b, _| b.reference[1][0] = f64::NAN),
        E::Reference { point: 1, .. }
    ));
    assert!(matches!(
        refused(|_, r| r[0].parameters.truncate(1)),
        E::Parameters {
            run: 0,
            found: 1,
            expected: 2
        }
    ));
    assert!(matches!(
        refused(|_, r| r[1].parameters[1] = f64::INFINITY),
        E::Parameter { run: 1, name, .. } if name == "angle"
    ));
    let (run, frame) = (0, 2);
    assert!(matches!(
        refused(|_, r| r[0].frames[2].velocities.truncate(1)),
        E::Length {
            run: 0,
            frame: 2,
            field: "velocities",
            found: 1,
            expected: 2
        }
    ));
    let not_finite = |field| E::NotFinite {
        run,
        frame,
        point: 1,
        field,
    };
    assert_eq!(
        refused(|_, r| r[0].frames[2].positions[1][0] = f64::NAN),
        not_finite("positions")
    );
    assert_eq!(
        refused(|_, r| r[0].frames[2].velocities[1][1] = f64::INFINITY),
        not_finite("velocities")
    );
    assert_eq!(
        refused(|_, r| r[0].frames[2].deformation_gradients[1].0[0][1] = f64::NAN),
        not_finite("deformation_gradients")
    );
    assert!(matches!(
        refused(|_, r| r[0].frames[1].deformation_gradients[1].0[0][0] = -1.0),
        E::Inverted { run: 0, frame: 1, point: 1, determinant } if determinant < 0.0
    ));
}
