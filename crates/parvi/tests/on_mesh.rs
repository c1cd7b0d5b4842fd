//! Sampling within a mesh.

use mpm_mesh::SimplexMesh;
use mpm_mesh::generate::{EdgeTarget, disk};
use mpm_tensor::vector;
use parvi::{MeshOptions, Run, Samples, Silent};
use parvi_metrics::{Cloud, EnergyReference};
use parvi_targets::{Gaussian, Target};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

fn scan_case(target: &dyn Target<2>, mesh: &SimplexMesh<2>, count: usize, options: &MeshOptions, seed: u64) -> Samples<2> {
    options.sample(target, mesh, &Run::new(count, seed), &mut Silent).expect("a run that ends well")
}

struct Uniform;
impl Target<2> for Uniform {
    fn log_density(&self, _: &[f64; 2]) -> f64 { 0.0 }
    fn score(&self, _: &[f64; 2]) -> [f64; 2] { [0.0; 2] }
}

/// Draws within the unit disk by rejection; p ≤ p(mode).
fn draws(target: &dyn Target<2>, top: f64, count: usize) -> Vec<[f64; 2]> {
    let mut generator = ChaCha8Rng::seed_from_u64(77);
    let mut all = Vec::new();
    while all.len() < count {
        let x: [f64; 2] = std::array::from_fn(|_| 2.0 * generator.random::<f64>() - 1.0);
        if vector::norm(&x) < 1.0 && generator.random::<f64>() < (target.log_density(&x) - top).exp() {
            all.push(x);
        }
    }
    all
}

#[test]
fn scan() {
    let gaussian = Gaussian::<2>::new([0.3, 0.2], mpm_tensor::Matrix::IDENTITY * 0.16).expect("gaussian");
    let targets: [(&str, &dyn Target<2>, [f64; 2]); 2] = [("uniform", &Uniform, [0.0; 2]), ("gaussian", &gaussian, [0.3, 0.2])];
    for (name, target, mode) in targets {
        let reference = draws(target, target.log_density(&mode), 40_000);
        let cloud = Cloud::new(&reference).expect("finite");
        let energy = EnergyReference::new(&cloud).expect("reference");
        for count in [512, 2048] {
            for h in [0.4, 0.28, 0.2, 0.14, 0.1] {
                let mesh = disk([0.0; 2], 1.0, &EdgeTarget { length: h, angle: 0.0 }).expect("mesh");
                for shifts in [false, true] {
                    let options = MeshOptions { shifts, ..MeshOptions::default() };
                    let t = std::time::Instant::now();
                    let samples = scan_case(target, &mesh, count, &options, 1);
                    let t = t.elapsed().as_secs_f64();
                    let outside = samples.positions.iter().filter(|x| vector::norm(x) > 1.0 + 1e-9).count();
                    let ed = energy.squared(&Cloud::new(&samples.positions).expect("finite")).expect("ed");
                    println!("{name} M={count} h={h} shifts={shifts} steps={} ED2/iid={:.3} residual={:.3} out={outside} {t:.2}s", samples.steps, ed / (energy.mean_distance() / count as f64), samples.residual.expect("r"));
                }
            }
        }
    }
}
