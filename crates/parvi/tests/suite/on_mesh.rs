//! Sampling within a mesh.

use mpm_mesh::generate::{EdgeTarget, ball, disk, wavy_channel};
use mpm_mesh::{CellSearch, MshFormat, SimplexMesh, write_msh};
use mpm_tensor::{Matrix, vector};
use parvi::{MeshOptions, OnMesh, Run, SampleError, Samples, Silent};
use parvi_metrics::{Cloud, EnergyReference};
use parvi_targets::{Gaussian, Target};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

use crate::support::on_threads;

/// The uniform density of a bounded domain: no score.
struct Uniform;

impl<const D: usize> Target<D> for Uniform {
    fn log_density(&self, _: &[f64; D]) -> f64 {
        0.0
    }

    fn score(&self, _: &[f64; D]) -> [f64; D] {
        [0.0; D]
    }
}

fn edges(length: f64) -> EdgeTarget {
    EdgeTarget { length, angle: 0.0 }
}

fn sampled<const D: usize>(target: &dyn Target<D>, mesh: &SimplexMesh<D>, count: usize, seed: u64) -> Samples<D> {
    sampled_with(&MeshOptions::default(), target, mesh, count, seed)
}

fn sampled_with<const D: usize>(
    options: &MeshOptions,
    target: &dyn Target<D>,
    mesh: &SimplexMesh<D>,
    count: usize,
    seed: u64,
) -> Samples<D> {
    let samples = options.sample(target, mesh, &Run::new(count, seed), &mut Silent);
    let samples = samples.expect("a run that ends well");
    let search = CellSearch::new(mesh.clone());
    let outside = |x: &&[f64; D]| search.nearest(x, f64::INFINITY).is_none_or(|near| near.distance > 1e-9);
    assert_eq!(samples.positions.iter().find(outside), None);
    samples
}

/// Independent draws of a density ∝ `target` within the unit ball, `top` its largest logarithm.
fn reference<const D: usize>(target: &dyn Target<D>, top: f64) -> EnergyReference<D> {
    let mut generator = ChaCha8Rng::seed_from_u64(77);
    let mut all = Vec::new();
    while all.len() < 20_000 {
        let x: [f64; D] = std::array::from_fn(|_| 2.0 * generator.random::<f64>() - 1.0);
        if vector::norm(&x) < 1.0 && generator.random::<f64>() < (target.log_density(&x) - top).exp() {
            all.push(x);
        }
    }
    EnergyReference::new(&Cloud::new(&all).expect("finite")).expect("a sample")
}

/// ED² over that of as many independent draws.
fn relative_energy<const D: usize>(samples: &Samples<D>, reference: &EnergyReference<D>) -> f64 {
    let squared = reference.squared(&Cloud::new(&samples.positions).expect("finite"));
    squared.expect("in range") * samples.positions.len() as f64 / reference.mean_distance()
}

#[test]
fn densities_on_a_disk_are_far_better_than_independent_draws() {
    let mesh = disk([0.0; 2], 1.0, &edges(0.14)).expect("a mesh");
    let gaussian = Gaussian::<2>::new([0.3, 0.2], Matrix::IDENTITY * 0.16).expect("a covariance");
    let targets: [(&dyn Target<2>, [f64; 2]); 2] = [(&Uniform, [0.0; 2]), (&gaussian, [0.3, 0.2])];
    for (target, mode) in targets {
        let reference = reference(target, target.log_density(&mode));
        for seed in 0..3 {
            let energy = relative_energy(&sampled(target, &mesh, 1000, seed), &reference);
            assert!(energy < 0.1, "{energy}");
        }
    }
}

#[test]
fn moved_meshes_see_more() {
    let mesh = disk([0.0; 2], 1.0, &edges(0.2)).expect("a mesh");
    let reference = reference::<2>(&Uniform, 0.0);
    let energy = |shifts: bool| {
        let options = MeshOptions {
            shifts,
            ..MeshOptions::default()
        };
        let of_seed = |seed| relative_energy(&sampled_with(&options, &Uniform, &mesh, 1000, seed), &reference);
        (0..4).map(of_seed).sum::<f64>() / 4.0
    };
    let (moved, at_rest) = (energy(true), energy(false));
    assert!(moved < 0.67 * at_rest, "{moved}, {at_rest}");
}

#[test]
fn a_density_in_a_ball_is_better_than_independent_draws() {
    let mesh = ball([0.0; 3], 1.0, 0.35).expect("a mesh");
    let gaussian = Gaussian::<3>::new([0.0, 0.3, 0.2], Matrix::IDENTITY * 0.25).expect("a covariance");
    let reference = reference(&gaussian, gaussian.log_density(&[0.0, 0.3, 0.2]));
    let energy = relative_energy(&sampled(&gaussian, &mesh, 1000, 1), &reference);
    assert!(energy < 0.3, "{energy}");
}

/// Uniform in the channel: the mean is the centroid of the mesh.
#[test]
fn the_wavy_channel_is_filled_evenly() {
    let mesh = wavy_channel([0.0, 23.5], &edges(0.5)).expect("a mesh");
    let samples = sampled(&Uniform, &mesh, 1000, 5);
    let total = mesh.total_volume();
    for axis in 0..2 {
        let of_cell = |k: usize| {
            mesh.cell(k)
                .iter()
                .map(|&v| mesh.vertices()[v as usize][axis])
                .sum::<f64>()
                / 3.0
        };
        let centroid: f64 = (0..mesh.cell_count())
            .map(|k| mesh.volume(k) / total * of_cell(k))
            .sum();
        let mean: f64 = samples.positions.iter().map(|x| x[axis]).sum::<f64>() / 1000.0;
        let tolerance = [0.01, 0.05][axis];
        assert!((mean - centroid).abs() < tolerance, "axis {axis}: {mean}, {centroid}");
    }
}

#[test]
fn the_same_seed_gives_the_same_bits_on_any_number_of_threads() {
    let mesh = disk([0.0; 2], 1.0, &edges(0.3)).expect("a mesh");
    let bits = |threads: usize| {
        let samples = on_threads(threads, || sampled(&Uniform, &mesh, 20_000, 3));
        samples
            .positions
            .into_flattened()
            .into_iter()
            .map(f64::to_bits)
            .collect::<Vec<_>>()
    };
    assert_eq!(bits(1), bits(3));
}

#[test]
fn what_cannot_be_sampled_is_refused() {
    let directory = tempfile::tempdir().expect("a directory");
    let file = directory.path().join("disk.msh");
    let mesh = disk([0.0; 2], 1.0, &edges(0.5)).expect("a mesh");
    std::fs::write(&file, write_msh(&mesh, MshFormat::Text41)).expect("a file");
    let on = |file: &std::path::Path| OnMesh {
        file: file.to_owned(),
        options: MeshOptions::default(),
    };
    let run = Run::new(100, 1);
    let plane = Gaussian::<2>::standard();
    assert!(on(&file).sample(&plane, &run, &mut Silent).is_ok());
    let refused = [
        on(&directory.path().join("none.msh"))
            .sample(&plane, &run, &mut Silent)
            .err(),
        on(&file).sample(&Gaussian::<3>::standard(), &run, &mut Silent).err(),
        on(&file).sample(&Gaussian::<5>::standard(), &run, &mut Silent).err(),
    ];
    let message = refused[0].as_ref().map(ToString::to_string).unwrap_or_default();
    assert!(message.contains("none.msh: cannot be read: "), "{message}");
    for error in refused {
        assert!(matches!(&error, Some(SampleError::MeshFile { .. })), "{error:?}");
    }
    let options = MeshOptions {
        time_step: Some(-1.0),
        ..MeshOptions::default()
    };
    let error = options.sample(&plane, &mesh, &run, &mut Silent).err();
    assert!(matches!(
        error,
        Some(SampleError::InvalidOption { field: "time step", .. })
    ));
}
