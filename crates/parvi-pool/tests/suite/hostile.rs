//! Densities that are no numbers, or that nothing can be known of.

use parvi_pool::{Objection, PoolError, PoolOptions};
use parvi_targets::{Gaussian, Target};

use crate::common::{pool_of, pool_with};

/// A log density given by a function; its score is zero.
struct Given<F>(F);

impl<F: Fn(&[f64; 2]) -> f64 + Sync> Target<2> for Given<F> {
    fn log_density(&self, x: &[f64; 2]) -> f64 {
        self.0(x)
    }
    fn score(&self, _x: &[f64; 2]) -> [f64; 2] {
        [f64::NAN, f64::INFINITY]
    }
}

/// 1/x on 0 < y < x < 1, of mass 1, seen from N(0, I): scouts climb to the corner, where there is next to none of it.
#[test]
fn scouts_that_agree_on_a_place_without_mass_are_not_the_last_word() {
    struct Corner;
    impl Target<2> for Corner {
        fn log_density(&self, &[x, y]: &[f64; 2]) -> f64 {
            if 0.0 < y && y < x && x < 1.0 {
                -x.ln()
            } else {
                f64::NEG_INFINITY
            }
        }
        fn score(&self, x: &[f64; 2]) -> [f64; 2] {
            [-1.0 / x[0], 0.0]
        }
    }
    for seed in [23, 50, 70, 98, 102, 104, 156, 158] {
        let pool = pool_of(&Corner, 500, seed).unwrap();
        let off = pool.log_evidence.abs();
        assert!(off < 4.0 * pool.log_evidence_error, "seed {seed}: {off}");
    }
}

#[test]
fn densities_that_are_no_numbers_are_survived() {
    let hostile = Given(|x: &[f64; 2]| {
        let l = -0.5 * (x[0] * x[0] + x[1] * x[1]);
        match (x[0] * 1e3) as i64 % 7 {
            0 => f64::NAN,
            1 => f64::INFINITY,
            2 => 1e300,
            3 => f64::NEG_INFINITY,
            4 => -1e300,
            _ => l,
        }
    });
    let pool = pool_of(&hostile, 100, 1).unwrap();
    assert!(pool.values_replaced > 0);
    assert!(pool.weights.iter().all(|w| w.is_finite()));
    assert!(pool.condense(100).as_flattened().iter().all(|c| c.is_finite()));
    for (value, is_undefined) in [(f64::NAN, true), (f64::INFINITY, true), (f64::NEG_INFINITY, false)] {
        let error = pool_of(&Given(move |_: &[f64; 2]| value), 100, 1).expect_err("nothing to weigh");
        let PoolError::NowhereFinite {
            points,
            finite: 0,
            undefined,
            beyond: 0,
            scores: 0,
        } = error
        else {
            panic!("{error}");
        };
        assert_eq!((points > 100, undefined), (true, if is_undefined { points } else { 0 }));
        let found = if is_undefined {
            format!(
                "log p was -inf at 0, NaN or +inf at {points} and finite at 0 of {points} points: too few to begin with"
            )
        } else {
            format!("log p was -inf at all {points} points")
        };
        assert_eq!(error.to_string(), format!("{found}; {FRAME}"));
    }
}

/// What every such message ends with.
const FRAME: &str = "the frame is to say where the mass lies and how wide it is";

#[test]
fn densities_too_low_to_count_with_are_told_from_those_that_are_zero() {
    let message = |log_density: &(dyn Fn(&[f64; 2]) -> f64 + Sync)| {
        let refused = pool_of(&Given(log_density), 100, 1);
        refused.expect_err("nothing to weigh").to_string()
    };
    let narrow = message(&|x| -0.5e24 * ((x[0] - 0.3).powi(2) + x[1] * x[1]));
    for message in [narrow, message(&|_| -1e300)] {
        let start = "log p was below -1e15, which counts as -inf, at all ";
        assert!(message.starts_with(start) && message.ends_with(FRAME), "{message}");
    }
    let half = message(&|x| if x[0] > 0.0 { f64::NEG_INFINITY } else { -1e16 });
    assert!(half.contains(", below -1e15, which counts as -inf, at "), "{half}");
}

#[test]
fn mass_where_the_density_is_no_number_is_objected_to() {
    for nothing in [f64::NAN, f64::INFINITY] {
        let torn = Given(move |x: &[f64; 2]| {
            let l = -0.5 * (x[0] * x[0] + x[1] * x[1]);
            if x[0] > 1.0 { nothing } else { l }
        });
        let pool = pool_of(&torn, 500, 1).unwrap();
        assert!(
            matches!(pool.objection(500), Some(Objection::Undefined(share)) if share < 0.5),
            "{pool:?}"
        );
        // Far out it may be one.
        let far = Given(move |x: &[f64; 2]| {
            let l = -0.5 * (x[0] * x[0] + x[1] * x[1]);
            if x[0] > 6.0 { nothing } else { l }
        });
        let pool = pool_of(&far, 500, 1).unwrap();
        assert_eq!(pool.objection(500), None, "{pool:?}");
    }
}

#[test]
fn options_out_of_range_are_refused() {
    let target = Gaussian::<2>::standard();
    let refused = pool_of(&target, 1, 0);
    assert!(matches!(
        refused.err(),
        Some(PoolError::InvalidOption { field: "particles", .. })
    ));
    let none = PoolOptions {
        evaluations: Some(0),
        ..PoolOptions::default()
    };
    assert!(matches!(
        pool_with(&target, 100, 1, &none).err(),
        Some(PoolError::InvalidOption {
            field: "evaluations",
            ..
        })
    ));
}

#[test]
fn few_evaluations_are_exceeded_by_what_a_pool_begins_with_alone() {
    for (particles, limit) in [(100, 1), (1000, 1000), (5000, 3000)] {
        let options = PoolOptions {
            evaluations: Some(limit),
            ..PoolOptions::default()
        };
        let pool = pool_with(&Gaussian::<2>::standard(), particles, 1, &options).unwrap();
        let evaluations = pool.density_evaluations + pool.score_evaluations;
        let first = 375 * 2 + 3 * particles as u64 / 4;
        assert!(evaluations <= limit + first, "{particles} {limit}: {evaluations}");
    }
}

#[test]
fn evaluations_without_a_bound_cost_nothing_by_themselves() {
    let of = |limit| {
        let options = PoolOptions {
            evaluations: Some(limit),
            ..PoolOptions::default()
        };
        pool_with(&Gaussian::<2>::standard(), 100, 1, &options).unwrap()
    };
    let (bounded, unbounded) = (of(1_000_000), of(u64::MAX));
    assert_eq!(unbounded.positions, bounded.positions);
    assert_eq!(unbounded.log_evidence, bounded.log_evidence);
}

#[test]
fn a_quantile_of_no_probability_is_none() {
    let mut pool = pool_of(&Gaussian::<2>::standard(), 50, 1).unwrap();
    for probability in [f64::NAN, -1.0, 1.1, 2.0] {
        assert!(pool.quantile(0, probability).is_nan());
    }
    assert!(pool.quantile(2, 0.5).is_nan() && pool.quantile(0, 0.0) < pool.quantile(0, 1.0));
    // The fields are anyone's to change: points without a weight do not count.
    pool.weights.clear();
    assert!(pool.quantile(0, 0.5).is_nan());
}

#[test]
fn a_pool_that_is_not_to_be_relied_on_evaluates_more() {
    // Ripples that no kernel follows: the weights' variance stays what it is.
    let ripples = |x: f64| 15.0 * (1e4 * x).sin() - 0.5 * x * x;
    let target = Given(|x: &[f64; 2]| ripples(x[0]) + ripples(x[1]));
    let evaluations = |limit| {
        let options = PoolOptions {
            evaluations: limit,
            ..PoolOptions::default()
        };
        let pool = pool_with(&target, 100, 1, &options).unwrap();
        pool.density_evaluations + pool.score_evaluations
    };
    assert!(evaluations(Some(4_000)) <= 4_000);
    let spent = evaluations(None);
    assert!((15_000..=20_000).contains(&spent), "{spent}");
}
