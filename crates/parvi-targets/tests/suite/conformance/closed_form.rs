//! Targets with one mode whose moments are known in closed form.

use parvi_targets::{Parameters, build};

use super::promises::{conforming, conforms, score_is_the_gradient};

#[test]
fn gaussian() {
    conforms::<1>("gaussian");
    conforms::<2>("gaussian");
    conforms::<6>("gaussian");
    let correlated = Parameters {
        correlation: Some(-0.95),
        ..Parameters::default()
    };
    conforming(&*build::<4>("gaussian", &correlated).unwrap());
}

#[test]
fn banana() {
    conforms::<2>("banana");
    let bent = Parameters {
        curvature: Some(-2.0),
        width: Some(0.1),
        ..Parameters::default()
    };
    conforming(&*build::<2>("banana", &bent).unwrap());
}

#[test]
fn ring() {
    conforms::<2>("ring");
    let wide = Parameters {
        radius: Some(0.5),
        width: Some(1.0),
        ..Parameters::default()
    };
    conforming(&*build::<2>("ring", &wide).unwrap());
}

#[test]
fn funnel() {
    conforms::<2>("funnel");
    conforms::<3>("funnel");
    conforms::<4>("funnel");
    conforms::<6>("funnel");
}

#[test]
fn student_t() {
    conforms::<1>("student-t");
    conforms::<2>("student-t");
    conforms::<6>("student-t");
    let cauchy = Parameters {
        degrees_of_freedom: Some(1.0),
        ..Parameters::default()
    };
    let cauchy = build::<3>("student-t", &cauchy).unwrap();
    assert!(cauchy.moments().is_none());
    score_is_the_gradient(&*cauchy);
}

#[test]
fn rosenbrock() {
    conforms::<2>("rosenbrock");
    conforms::<3>("rosenbrock");
    conforms::<4>("rosenbrock");
    conforms::<7>("rosenbrock");
    conforms::<8>("rosenbrock");
    // The plane's density with the constants of the literature.
    let classic = Parameters {
        spread: Some(10_f64.sqrt()),
        width: Some(0.1_f64.sqrt()),
        ..Parameters::default()
    };
    conforming(&*build::<2>("rosenbrock", &classic).unwrap());
}

#[test]
fn scales() {
    conforms::<2>("scales");
    conforms::<4>("scales");
    conforms::<8>("scales");
    let uncorrelated = Parameters {
        correlation: Some(0.0),
        ..Parameters::default()
    };
    let target = build::<3>("scales", &uncorrelated).unwrap();
    conforming(&*target);
    let covariance = target.moments().unwrap().covariance.0;
    for (axis, variance) in [1e-6, 1.0, 1e6].into_iter().enumerate() {
        assert!((covariance[axis][axis] / variance - 1.0).abs() < 1e-14);
    }
}

#[test]
fn cross() {
    conforms::<2>("cross");
    conforms::<3>("cross");
    conforms::<8>("cross");
    let round = Parameters {
        spread: Some(0.5),
        width: Some(0.5),
        ..Parameters::default()
    };
    conforming(&*build::<2>("cross", &round).unwrap());
}
