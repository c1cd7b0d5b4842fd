//! Targets with one mode whose moments are known in closed form.

use parvi_targets::build;

use super::promises::{conforming, conforms, score_is_the_gradient};
use crate::support::with;

#[test]
fn gaussian() {
    crate::in_dimensions!(conforms("gaussian"), 1, 2, 6);
    let correlated = with(|p| p.correlation = Some(-0.95));
    conforming(&*build::<4>("gaussian", &correlated).unwrap());
}

#[test]
fn banana() {
    conforms::<2>("banana");
    let bent = with(|p| {
        p.curvature = Some(-2.0);
        p.width = Some(0.1);
    });
    conforming(&*build::<2>("banana", &bent).unwrap());
}

#[test]
fn ring() {
    conforms::<2>("ring");
    let wide = with(|p| {
        p.radius = Some(0.5);
        p.width = Some(1.0);
    });
    conforming(&*build::<2>("ring", &wide).unwrap());
}

#[test]
fn funnel() {
    crate::in_dimensions!(conforms("funnel"), 2, 3, 4, 6);
}

#[test]
fn student_t() {
    crate::in_dimensions!(conforms("student-t"), 1, 2, 6);
    let cauchy = with(|p| p.degrees_of_freedom = Some(1.0));
    let cauchy = build::<3>("student-t", &cauchy).unwrap();
    assert!(cauchy.moments().is_none());
    score_is_the_gradient(&*cauchy);
}

#[test]
fn rosenbrock() {
    crate::in_dimensions!(conforms("rosenbrock"), 2, 3, 4, 7, 8);
    // The plane's density with the constants of the literature.
    let classic = with(|p| {
        p.spread = Some(10_f64.sqrt());
        p.width = Some(0.1_f64.sqrt());
    });
    conforming(&*build::<2>("rosenbrock", &classic).unwrap());
}

#[test]
fn scales() {
    crate::in_dimensions!(conforms("scales"), 2, 4, 8);
    let uncorrelated = with(|p| p.correlation = Some(0.0));
    let target = build::<3>("scales", &uncorrelated).unwrap();
    conforming(&*target);
    let covariance = target.moments().unwrap().covariance.0;
    for (axis, variance) in [1e-6, 1.0, 1e6].into_iter().enumerate() {
        assert!((covariance[axis][axis] / variance - 1.0).abs() < 1e-14);
    }
}

#[test]
fn cross() {
    crate::in_dimensions!(conforms("cross"), 2, 3, 8);
    let round = with(|p| {
        p.spread = Some(0.5);
        p.width = Some(0.5);
    });
    conforming(&*build::<2>("cross", &round).unwrap());
}
