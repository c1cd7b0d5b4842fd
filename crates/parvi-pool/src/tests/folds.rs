//! Rounds that a fold takes in and forgets.

use mpm_tensor::Matrix;
use parvi_targets::{Frame, Gaussian, GaussianMixture, Mode};

use crate::density::Density;
use crate::fold::Fold;
use crate::{Kernel, Mixture};

fn law(centre: [f64; 2], width: f64) -> Mixture<2> {
    Mixture::new(vec![Kernel {
        centre,
        factor: Matrix::IDENTITY * width,
        share: 1.0,
    }])
    .unwrap()
}

#[test]
fn a_fold_that_forgets_weighs_as_if_the_rest_were_all() {
    let target = Gaussian::<2>::standard();
    let frame = Frame::identity();
    let law = |width| law([0.3, 0.0], width);
    let mut density = Density::of(&target, &frame);
    let [mut both, mut second] = [Fold::new(), Fold::new()];
    both.draw(&mut density, law(2.0), 40, 1);
    both.draw(&mut density, law(1.1), 64, 2);
    second.draw(&mut density, law(1.1), 64, 2);
    let mut joined = second.clone();
    let mut first = Fold::new();
    first.draw(&mut density, law(2.0), 40, 1);
    joined.absorb(first);
    let sum = |fold: &Fold<2>| fold.log_weights().iter().map(|l| l.exp()).sum::<f64>();
    assert!((sum(&joined) - sum(&both)).abs() < 1e-12);
    both.forget(1);
    assert_eq!(both.log_weights(), second.log_weights());
}

/// Of few kernels that are forgotten, what they were is taken away; where they were nearly all, the rest is summed anew.
#[test]
fn what_is_left_of_the_sums_is_no_rounding() {
    let target = Gaussian::<3>::standard();
    let frame = Frame::identity();
    let kernels = |width: f64, count: u32| {
        let kernel = |n: u32| Kernel {
            centre: [0.1 * f64::from(n), 0.0, -0.1],
            factor: Matrix::IDENTITY * width,
            share: 1.0,
        };
        Mixture::new((0..count).map(kernel).collect()).unwrap()
    };
    let mut density = Density::of(&target, &frame);
    let [mut both, mut rest] = [Fold::new(), Fold::new()];
    both.draw(&mut density, kernels(3.0, 2), 4000, 1);
    for fold in [&mut both, &mut rest] {
        // Some of the points are far out, where what is narrow is next to nothing.
        fold.draw(&mut density, kernels(0.05, 40), 64, 2);
        fold.draw(&mut density, kernels(1.0, 9), 64, 3);
    }
    both.forget(1);
    assert_eq!(both.positions, rest.positions);
    for (one, other) in both.log_weights().iter().zip(rest.log_weights()) {
        assert!((one - other).abs() < 1e-12 * (1.0 + other.abs()), "{one} {other}");
    }
}

/// Two normal laws: what is about the second is news where nothing was drawn there before, and none where both were known or where there is nothing.
#[test]
fn news_is_what_was_not_known() {
    let mode = |x| Mode {
        centre: [x, 0.0],
        width: 1.0,
        mass: 0.5,
    };
    let target = GaussianMixture::new("two", &[mode(-4.0), mode(4.0)]).unwrap();
    let frame = Frame::identity();
    let news = |first: &Mixture<2>, last: &Mixture<2>| {
        let mut density = Density::of(&target, &frame);
        let mut fold = Fold::new();
        fold.draw(&mut density, first.clone(), 2000, 1);
        fold.draw(&mut density, last.clone(), 200, 2);
        fold.news_of_last()
    };
    let (one, all) = (law([-4.0, 0.0], 1.0), law([0.0, 0.0], 3.0));
    let found = law([4.0, 0.0], 0.8);
    assert!((news(&one, &found) - 0.5).abs() < 0.1, "{}", news(&one, &found));
    assert!(news(&all, &found) < 0.05, "{}", news(&all, &found));
    assert!(news(&all, &law([0.0, 6.0], 0.3)) < 1e-4);
    assert_eq!(Fold::<2>::new().news_of_last(), 0.0);
}

#[test]
fn weights_over_two_proposals_are_unbiased() {
    let target = Gaussian::<2>::standard();
    let frame = Frame::identity();
    let runs = 200;
    let mean = (0..runs)
        .map(|seed| {
            let mut density = Density::of(&target, &frame);
            let mut fold = Fold::new();
            fold.draw(&mut density, law([1.0, 0.0], 0.8), 64, seed);
            fold.draw(&mut density, law([-1.0, 0.5], 1.2), 128, 1000 + seed);
            fold.log_weights().iter().map(|l| l.exp()).sum::<f64>()
        })
        .sum::<f64>()
        / runs as f64;
    assert!((mean - 1.0).abs() < 0.005, "{mean}");
}
