//! Snapshots, their file, and what is refused.

use mpm_rom::snapshots::{Body, Frame, Place, Run, Snapshots, SnapshotsError};
use mpm_rom::tensor_file::TensorFault;
use mpm_tensor::Matrix;

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
    let three = Snapshots::<3>::read(&path).map_err(|error| *error.fault);
    assert!(matches!(
        three,
        Err(TensorFault::Dimension {
            found: 2,
            expected: 3,
            ..
        })
    ));
}

#[test]
fn faults_are_named_with_run_frame_and_point() {
    use SnapshotsError as E;
    assert_eq!(refused(|b, _| b.reference.clear()), E::Empty { what: "points" });
    assert_eq!(refused(|_, r| r.clear()), E::Empty { what: "runs" });
    assert_eq!(refused(|_, r| r[1].frames.clear()), E::Empty { what: "frames" });
    // Run, frame and point, and what is wrong there.
    let fault = |change: fn(&mut Body<2>, &mut Vec<Run<2>>)| match refused(change) {
        E::Value { place, field, .. } => (place, field),
        E::Length { place, field, .. } => (place, field.to_owned()),
        other => panic!("{other}"),
    };
    let at = |run, frame, point, field: &str| (Place { run, frame, point }, field.to_owned());
    let (first, second, third) = (Some(0), Some(1), Some(2));
    assert_eq!(
        fault(|_, r| r[0].frames[1].time = f64::NAN),
        at(first, second, None, "time")
    );
    assert_eq!(fault(|_, r| r[0].frames[2].time = 0.05), at(first, third, None, "time"));
    assert_eq!(fault(|b, _| b.interval = 0.0), at(None, None, None, "interval"));
    assert_eq!(fault(|b, _| b.density = f64::NAN), at(None, None, None, "density"));
    assert_eq!(
        fault(|b, _| b.reference[1][0] = f64::NAN),
        at(None, None, second, "reference")
    );
    assert_eq!(
        fault(|_, r| r[0].parameters.truncate(1)),
        at(first, None, None, "parameters")
    );
    assert_eq!(
        fault(|_, r| r[1].parameters[1] = f64::INFINITY),
        at(second, None, None, "angle")
    );
    assert_eq!(
        fault(|_, r| r[0].frames[2].velocities.truncate(1)),
        at(first, third, None, "velocities")
    );
    let of_point = |field| at(first, third, second, field);
    assert_eq!(
        fault(|_, r| r[0].frames[2].positions[1][0] = f64::NAN),
        of_point("positions")
    );
    assert_eq!(
        fault(|_, r| r[0].frames[2].velocities[1][1] = f64::INFINITY),
        of_point("velocities")
    );
    let gradient = fault(|_, r| r[0].frames[2].deformation_gradients[1].0[0][1] = f64::NAN);
    assert_eq!(gradient, of_point("deformation_gradients"));
    let inverted = refused(|_, r| r[0].frames[1].deformation_gradients[1].0[0][0] = -1.0);
    assert!(
        inverted.to_string().starts_with("run 0, frame 1, point 1: det F = -"),
        "{inverted}"
    );
}
