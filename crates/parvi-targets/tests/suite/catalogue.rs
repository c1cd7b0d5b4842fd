//! The catalogue's entries against the targets they describe, and its errors.

use parvi_targets::{
    Dimensions, Parameters, TargetError, build, catalogue, coordinate_names, dimension_of, target_info,
};

use crate::support::with;

/// Builds an entry in dimension D where it exists there, and compares what is said with what is so.
fn check_in<const D: usize>() {
    for info in catalogue()
        .iter()
        .filter(|info| info.parameters.iter().all(|parameter| parameter.default.is_some()))
    {
        let parameters = Parameters::default();
        let exists = match info.dimensions {
            Dimensions::Fixed(only) => D == only,
            Dimensions::Range { minimum, maximum, .. } => (minimum..=maximum).contains(&D),
            Dimensions::FromData => false,
        };
        match build::<D>(info.name, &parameters) {
            Ok(target) => {
                assert!(exists, "{} in {D}", info.name);
                assert_eq!(target.name(), info.name);
                assert_eq!(target.exact_draws().is_some(), info.exact_draws);
                assert_eq!(target.unit_cube_transport().is_some(), info.unit_cube_transport);
                assert_eq!(target.moments().is_some(), info.moments);
                assert_eq!(target.modes().len().max(1), info.modes);
                assert_eq!(dimension_of(info.name, Some(D), &parameters), Ok(D));
            }
            Err(error) => {
                assert!(!exists, "{} in {D}: {error}", info.name);
                assert!(matches!(error, TargetError::DimensionNotAllowed { dimension, .. } if dimension == D));
            }
        }
    }
}

#[test]
fn entries_describe_their_targets() {
    crate::in_dimensions!(check_in(), 1, 2, 3, 4, 5, 6, 7, 8, 9);
}

#[test]
fn dimensions_are_resolved() {
    let none = Parameters::default();
    assert_eq!(dimension_of("banana", None, &none), Ok(2));
    assert_eq!(dimension_of("wells-small", None, &none), Ok(5));
    assert_eq!(dimension_of("wells-small", Some(3), &none), Ok(3));
    assert_eq!(dimension_of("probit", None, &none), Ok(5));
    let message = |name, requested| dimension_of(name, requested, &none).unwrap_err().to_string();
    for (name, requested, expected) in [
        ("gaussian", None, "target 'gaussian' needs a dimension: 1 to 8"),
        ("wells", None, "target 'wells' needs a dimension: 1 to 6"),
        ("poisson", None, "target 'poisson' needs a dimension: 1 to 8"),
        (
            "gaussian",
            Some(0),
            "dimension 0 does not fit target 'gaussian': 1 to 8",
        ),
        (
            "gaussian",
            Some(9),
            "dimension 9 does not fit target 'gaussian': 1 to 8",
        ),
        ("wells", Some(7), "dimension 7 does not fit target 'wells': 1 to 6"),
        ("funnel", Some(1), "dimension 1 does not fit target 'funnel': 2 to 8"),
        ("schools", Some(2), "dimension 2 does not fit target 'schools': 3 to 8"),
        ("ring", Some(3), "dimension 3 does not fit target 'ring': 2"),
        ("logistic", Some(3), "target 'logistic' needs the parameter 'data'"),
        ("program", Some(3), "target 'program' needs the parameter 'program'"),
    ] {
        assert_eq!(message(name, requested), expected);
    }
}

#[test]
fn unknown_names_list_the_known_ones() {
    let error = target_info("wels").unwrap_err().to_string();
    assert!(
        error.starts_with("unknown target 'wels': known are gaussian, banana, ring, "),
        "{error}"
    );
    assert!(build::<2>("wels", &Parameters::default()).is_err());
    assert!(dimension_of("", None, &Parameters::default()).is_err());
}

#[test]
fn parameters_reach_their_target_and_no_other() {
    let parameters = with(|p| p.correlation = Some(0.5));
    let moments = build::<3>("gaussian", &parameters).unwrap().moments().unwrap();
    assert_eq!(moments.covariance.0[0], [1.0, 0.5, 0.25]);
    let error = build::<2>("ring", &parameters).map(|_| ()).unwrap_err();
    assert_eq!(
        error.to_string(),
        "target 'ring' has no parameter 'correlation' (given as 0.5): it has radius, width"
    );
    let error = build::<2>("mixture-3", &parameters).map(|_| ()).unwrap_err();
    assert!(error.to_string().ends_with("it has none"));
    for correlation in [1.0, -1.0, 2.0, f64::NAN] {
        let parameters = with(|p| p.correlation = Some(correlation));
        assert!(build::<2>("gaussian", &parameters).is_err());
    }
    let bad = [
        ("banana", with(|p| p.width = Some(0.0))),
        ("banana", with(|p| p.curvature = Some(f64::INFINITY))),
        ("ring", with(|p| p.radius = Some(-1.0))),
        ("ring", with(|p| p.width = Some(f64::NAN))),
        ("mixture-2", with(|p| p.width = Some(-0.5))),
        ("funnel", with(|p| p.width = Some(100.0))),
        ("student-t", with(|p| p.degrees_of_freedom = Some(0.0))),
        ("rosenbrock", with(|p| p.spread = Some(0.0))),
        ("rosenbrock", with(|p| p.width = Some(1e7))),
        ("scales", with(|p| p.correlation = Some(-1.0))),
        ("cross", with(|p| p.spread = Some(f64::NAN))),
        ("cross", with(|p| p.width = Some(1e-200))),
        ("probit", with(|p| p.prior_standard_deviation = Some(0.0))),
        ("wells", with(|p| p.prior_standard_deviation = Some(-1.0))),
    ];
    for (name, parameters) in bad {
        let error = build::<2>(name, &parameters).map(|_| ()).unwrap_err();
        assert!(
            matches!(error, TargetError::OutOfRange { .. } | TargetError::NotFinite { .. }),
            "{name}: {error}"
        );
    }
}

#[test]
fn coordinates_have_names() {
    let names = |name, dimension| coordinate_names(name, dimension, &Parameters::default()).unwrap();
    assert_eq!(names("gaussian", Some(2)), None);
    assert_eq!(names("wells", Some(2)).unwrap(), ["intercept", "distance/100"]);
    assert_eq!(names("probit", None).unwrap().len(), 5);
    assert_eq!(names("poisson", Some(3)).unwrap(), ["intercept", "x1", "x2"]);
    assert_eq!(names("schools", Some(4)).unwrap(), ["μ", "log τ", "η_{1}", "η_{2}"]);
    assert!(coordinate_names("schools", Some(9), &Parameters::default()).is_err());
}
