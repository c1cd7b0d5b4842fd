//! Shells that points of the one before are led into.

use mpm_tensor::Matrix;
use parvi_targets::{Frame, Gaussian, StudentT};
use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;

use crate::density::Density;
use crate::fold::Fold;
use crate::options::PoolOptions;
use crate::reach::reach;
use crate::{Kernel, Mixture};

/// Two folds of points of a kernel that is as wide as the target, and the kernels that are found beyond.
fn beyond(target: &dyn parvi_targets::Target<2>) -> (usize, Vec<Kernel<2>>) {
    let frame = Frame::identity();
    let mut density = Density::of(target, &frame);
    density.source.limit = 20_000;
    let kernel = Kernel {
        centre: [0.0; 2],
        factor: Matrix::IDENTITY * 1.3,
        share: 1.0,
    };
    let mut folds = [1, 2].map(|seed| {
        let mut fold = Fold::new();
        fold.draw(&mut density, Mixture::new(vec![kernel]).unwrap(), 4000, seed);
        fold
    });
    let plan = PoolOptions::default().plan::<2>(500).unwrap();
    let kernels = reach(&mut folds, &mut density, &plan, &mut ChaCha8Rng::seed_from_u64(5));
    (folds.iter().map(|fold| fold.positions.len()).sum(), kernels)
}

#[test]
fn nothing_is_beyond_a_normal_law() {
    let (points, kernels) = beyond(&Gaussian::standard());
    assert!(points == 8000 && kernels.is_empty());
}

/// Beyond the radius r the share of the second moments of t_ν with ν = 3 in the plane is (3 u^(−1/2) − u^(−3/2))/2, u = 1 + r²/3, and the mass is u^(−3/2): 0.37 beyond twice the
/// radius that 0.9 of the mass is within. Shares are of what is known so far, which may lack all of that.
#[test]
fn shares_of_second_moments_are_those_of_the_law() {
    let (points, kernels) = beyond(&StudentT::new(3.0).unwrap());
    let share: f64 = kernels.iter().map(|kernel| kernel.share).sum();
    assert!(points > 8500, "{points}");
    assert!((0.34..0.62).contains(&share), "{share}");
}
