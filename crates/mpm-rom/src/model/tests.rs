use std::path::Path;

use mpm_tensor::Matrix;
use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;

use super::*;
use crate::encoder::EncoderShape;
use crate::manifold::{Evaluation, Manifold, NetworkShape, Scaling, Wanted};
use crate::snapshots::{Body, Frame, Run, Snapshots};
use crate::tensor_file::{TensorFault as E, TensorReader, TensorWriter};

fn model() -> Model<2> {
    let scaling = Scaling {
        centre: vec![0.0; 2],
        factor: vec![1.0 / 3.0; 2],
        mean: vec![0.1, 0.2],
        deviation: vec![1.0, 2.0],
    };
    let network = NetworkShape {
        coordinates: 3,
        width: 5,
        depth: 2,
    };
    let encoder = EncoderShape {
        points: 50,
        width: 4,
        coordinates: 3,
    };
    let mut generator = ChaCha8Rng::seed_from_u64(1);
    let summary = Summary {
        scene: "beam".to_owned(),
        epochs: 7,
        best: None,
        training: Training::default(),
    };
    Model::new(
        Network::start(network, scaling.clone(), &mut generator).unwrap(),
        Encoder::start(encoder, scaling, &mut generator).unwrap(),
        summary,
    )
}

fn replaced(path: &Path, from: &str, to: &str) -> Result<Model<2>, E> {
    assert_eq!(from.len(), to.len());
    let bytes = std::fs::read(path).unwrap();
    let at = bytes
        .windows(from.len())
        .position(|window| window == from.as_bytes())
        .unwrap();
    let mut changed = bytes.clone();
    changed[at..at + to.len()].copy_from_slice(to.as_bytes());
    let other = path.with_extension("changed");
    std::fs::write(&other, changed).unwrap();
    Model::read(&other).map_err(|error| *error.fault)
}

#[test]
fn a_file_reads_back_to_the_same_bits() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("model.safetensors");
    model().write(&path).unwrap();
    assert_eq!(Model::read(&path).unwrap(), model());
}

#[test]
fn every_fault_has_its_error() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("model.safetensors");
    model().write(&path).unwrap();
    assert!(matches!(
        Model::<3>::read(&path).map_err(|error| *error.fault),
        Err(E::Dimension {
            found: 2,
            expected: 3,
            ..
        })
    ));
    assert!(matches!(
        replaced(&path, r#"\"version\":2"#, r#"\"version\":9"#),
        Err(E::Version { found: 9, .. })
    ));
    assert!(matches!(
        replaced(&path, r#"\"kind\":\"model\""#, r#"\"kind\":\"motel\""#),
        Err(E::Kind { found, .. }) if found == "motel"
    ));
    assert!(matches!(
        replaced(&path, r#"\"depth\":2"#, r#"\"depth\":3"#),
        Err(E::Shape { name, .. }) if name == "network"
    ));
    assert!(matches!(
        replaced(&path, r#""network":{"dtype"#, r#""netwerk":{"dtype"#),
        Err(E::Missing(name)) if name == "network"
    ));
    assert!(matches!(
        replaced(&path, r#"\"width\":5"#, r#"\"girth\":5"#),
        Err(E::Header(_))
    ));
    let bytes = std::fs::read(&path).unwrap();
    std::fs::write(&path, &bytes[..bytes.len() - 8]).unwrap();
    let cut = Model::<2>::read(&path).map_err(|error| *error.fault);
    assert!(matches!(cut, Err(E::Damaged(_))));
}

#[test]
fn errors_are_those_of_all_points_and_frames() {
    let model = model();
    let reference: Vec<[f64; 2]> = (0..50)
        .map(|k| [0.1 * f64::from(k), (0.7 * f64::from(k)).sin()])
        .collect();
    let frame = |stretch: f64| Frame {
        time: stretch - 1.0,
        positions: reference.iter().map(|x| [stretch * x[0], x[1]]).collect(),
        deformation_gradients: vec![Matrix([[stretch, 0.0], [0.0, 1.0]]); 50],
        velocities: vec![[0.0; 2]; 50],
    };
    let frames: Vec<_> = [1.0, 1.2, 1.5].map(frame).into();
    let (mut position, mut size, mut gradient) = (0.0, 0.0, 0.0);
    for frame in &frames {
        let (latent, mut at) = (model.encoder().encode(&frame.positions).unwrap(), Evaluation::default());
        model
            .network()
            .evaluate(&reference, &latent, Wanted::GRADIENTS, &mut at);
        for p in 0..50 {
            for i in 0..2 {
                position += (at.positions[p][i] - frame.positions[p][i]).powi(2);
                size += frame.positions[p][i].powi(2);
                for j in 0..2 {
                    gradient += (at.gradients[p].0[i][j] - frame.deformation_gradients[p].0[i][j]).powi(2);
                }
            }
        }
    }
    let body = Body {
        scene: "beam".to_owned(),
        reference,
        centroid: [0.0; 2],
        interval: 0.1,
        density: 1.0,
        parameters: Vec::new(),
    };
    let run = Run {
        parameters: Vec::new(),
        frames,
    };
    let snapshots = Snapshots::new(body, vec![run]).unwrap();
    let lost = model.reconstruction_error(&snapshots).unwrap();
    assert!(
        (lost / (100.0 * (position / size).sqrt()) - 1.0).abs() < 1e-12,
        "{lost}"
    );
    let apart = model.gradient_error(&snapshots).unwrap();
    assert!((apart / (gradient / 150.0_f64).sqrt() - 1.0).abs() < 1e-12, "{apart}");
}

#[test]
fn sizes_that_no_file_can_hold_are_an_error() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("model.safetensors");
    let huge = usize::MAX / 3;
    for (part, size, value) in [
        ("network", "depth", huge),
        ("network", "width", huge),
        ("encoder", "points", usize::MAX),
        ("encoder", "width", huge),
    ] {
        model().write(&path).unwrap();
        let mut header: serde_json::Value = TensorReader::open(&path, ("model", 2)).unwrap().header().unwrap();
        header[part][size] = value.into();
        let mut file = TensorWriter::default();
        file.add_list("network", model().network().parameters());
        file.add_list("encoder", model().encoder().parameters());
        file.write(&path, ("model", 2), &header).unwrap();
        let fault = Model::<2>::read(&path).map_err(|error| *error.fault);
        assert!(matches!(fault, Err(E::Shape { .. })), "{part} {size}: {fault:?}");
    }
}
