//! Scores and log densities are finite far beyond the mass of a target, where samplers may start or stray.

use parvi_targets::{BoxedTarget, Parameters, build, catalogue};
use proptest::prelude::*;

fn check<const D: usize>(target: &BoxedTarget<D>, x: [f64; D]) -> Result<(), TestCaseError> {
    prop_assert!(target.log_density(&x).is_finite(), "{} at {x:?}", target.name());
    let (mut scores, mut densities) = ([[f64::NAN; D]], [f64::NAN]);
    target.scores(&[x], &mut scores);
    target.log_densities(&[x], &mut densities);
    let all = target.score(&x).into_iter().chain(scores[0]).chain(densities);
    for value in all {
        prop_assert!(value.is_finite(), "{} at {x:?}", target.name());
    }
    Ok(())
}

/// Every target that exists in the dimension without a file.
fn all<const D: usize>() -> Vec<BoxedTarget<D>> {
    let built = |name| build::<D>(name, &Parameters::default()).ok();
    catalogue().iter().filter_map(|info| built(info.name)).collect()
}

/// ± 10^e on one axis, 0 on about one in eight.
fn coordinate() -> impl Strategy<Value = f64> {
    (-30.0..30.0_f64, 0..16_u8).prop_map(|(exponent, kind)| match kind {
        0 | 1 => 0.0,
        kind if kind % 2 == 0 => 10_f64.powf(exponent),
        _ => -10_f64.powf(exponent),
    })
}

fn config() -> ProptestConfig {
    ProptestConfig {
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

#[test]
fn in_the_plane() {
    let targets = all::<2>();
    proptest!(config(), |(x in prop::array::uniform2(coordinate()))| {
        targets.iter().try_for_each(|target| check(target, x))?;
    });
}

#[test]
fn in_five_dimensions() {
    let targets = all::<5>();
    proptest!(config(), |(x in prop::array::uniform5(coordinate()))| {
        targets.iter().try_for_each(|target| check(target, x))?;
    });
}
