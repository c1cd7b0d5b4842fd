//! The linear manifolds: what they reproduce, and where.

use mpm_rom::manifold::{Evaluation, LinearError, Manifold, Pod, Wanted};
use mpm_rom::snapshots::Snapshots;
use mpm_tensor::vector;

/// Σ |g̃ − φ|² of the frame with its best coordinates: normal equations of the Jacobian, solved by the modes' orthogonality.
fn worst_gap(manifold: &Pod<3>, snapshots: &Snapshots<3>) -> f64 {
    let r = manifold.coordinates();
    let mut worst = 0.0_f64;
    for frame in snapshots.frames() {
        let mut latent = vec![0.0; r];
        for k in 0..r {
            let (mut above, mut below) = (0.0, 0.0);
            for (p, rest) in snapshots.reference().iter().enumerate() {
                let mode = manifold.modes()[p * r + k];
                above += vector::dot(&mode, &vector::subtract(&frame.positions[p], rest));
                below += vector::dot(&mode, &mode);
            }
            latent[k] = above / below;
        }
        let mut out = Evaluation::default();
        manifold.evaluate(snapshots.reference(), &latent, Wanted::ALL, &mut out);
        for p in 0..snapshots.points() {
            worst = worst.max(vector::distance(&out.positions[p], &frame.positions[p]));
            worst = worst.max(1e-2 * (out.gradients[p] - frame.deformation_gradients[p]).maximum_norm());
        }
    }
    worst
}

#[test]
fn all_modes_together_reproduce_the_snapshots() {
    // 2 runs of 4 frames, of which the first is the state of rest: 6 displacements.
    let snapshots = crate::common::bending_cylinder(50, 2, 4);
    let all = Pod::new(&snapshots, 6).unwrap();
    assert!(worst_gap(&all, &snapshots) < 1e-10);
    assert!(worst_gap(&Pod::new(&snapshots, 1).unwrap(), &snapshots) > 1e-6);
    assert_eq!(Pod::new(&snapshots, 7), Err(LinearError::Rank { wanted: 7, rank: 6 }));
    assert_eq!(Pod::new(&snapshots, 0), Err(LinearError::Rank { wanted: 0, rank: 6 }));
}

#[test]
fn another_place_takes_the_nearest_point() {
    let snapshots = crate::common::bending_cylinder(40, 2, 3);
    let pod = Pod::new(&snapshots, 2).unwrap();
    let near = vector::add(&snapshots.reference()[17], &[1e-6, 0.0, 0.0]);
    let (mut there, mut here) = (Evaluation::default(), Evaluation::default());
    pod.evaluate(&[near], &[1.0, 1.0], Wanted::ALL, &mut there);
    pod.evaluate(snapshots.reference(), &[1.0, 1.0], Wanted::ALL, &mut here);
    assert_eq!(there.gradients[0], here.gradients[17]);
    assert_eq!(there.jacobians, here.jacobians[34..36]);
}
