//! Narrow pieces far from a wide one, which no way uphill leads to.

use mpm_tensor::vector;
use parvi_pool::{Objection, PoolOptions};
use parvi_targets::{Gaussian, Target};

use crate::common::{pool_of, pool_with};

/// A normal law of width 0.5 about (−1, …) and equally heavy ones of widths 0.06 and 0.05.
struct Needles<const D: usize>([[f64; D]; 3]);

const WIDTHS: [f64; 3] = [0.5, 0.06, 0.05];

impl<const D: usize> Needles<D> {
    fn logs(&self, x: &[f64; D]) -> [f64; 3] {
        std::array::from_fn(|k| {
            let z = vector::distance_squared(x, &self.0[k]) / WIDTHS[k].powi(2);
            -0.5 * z - D as f64 * (WIDTHS[k].ln() + 0.5 * std::f64::consts::TAU.ln()) - 3_f64.ln()
        })
    }
}

impl<const D: usize> Target<D> for Needles<D> {
    fn log_density(&self, x: &[f64; D]) -> f64 {
        let logs = self.logs(x);
        let top = logs.into_iter().fold(f64::NEG_INFINITY, f64::max);
        top + logs.iter().map(|l| (l - top).exp()).sum::<f64>().ln()
    }

    fn score(&self, x: &[f64; D]) -> [f64; D] {
        let log = self.log_density(x);
        let mut score = [0.0; D];
        for (k, own) in self.logs(x).into_iter().enumerate() {
            let slope = vector::subtract(&self.0[k], x);
            vector::accumulate(&mut score, (own - log).exp() / WIDTHS[k].powi(2), &slope);
        }
        score
    }
}

/// Of 200 seeds 198 meet both needles.
#[test]
fn needles_are_found_by_most_seeds() {
    let target = Needles([[-1.0, 0.3], [2.1, 1.4], [1.3, -2.2]]);
    let finds = |seed: &u64| pool_of(&target, 1000, *seed).unwrap().log_evidence.abs() < 0.05;
    let found = (0..8).filter(finds).count();
    assert_eq!(found, 8);
}

#[test]
fn what_searches_met_of_late_is_followed_by_quiet_or_an_objection() {
    let target = Needles([[-1.0, 0.3, 0.5], [1.6, 1.4, -0.5], [1.3, -2.2, 1.0]]);
    let mut pools = (0..32).map(|seed| pool_of(&target, 500, seed).unwrap());
    // There are seeds whose searches meet none.
    let mut pool = pools
        .find(|pool| pool.quiet.is_finite())
        .expect("a search that met a piece");
    assert!(pool.quiet >= 2.0, "{}", pool.quiet);
    let overlooked = (1.0 - pool.unseen()).powf(pool.drawn_in_vain as f64);
    assert!(
        pool.drawn_in_vain > 1000 && (overlooked - 0.05).abs() < 1e-9,
        "{overlooked}"
    );
    assert_eq!(pool.objection(500), None, "{pool:?}");
    pool.quiet = 1.9;
    assert_eq!(pool.objection(500), Some(Objection::Searching(1.9)));
}

/// Scouts climb to what is known, and scores point to it: neither is a draw that might have met a piece.
#[test]
fn what_is_unseen_goes_by_draws_alone() {
    let pool = pool_of(&Gaussian::<3>::standard(), 1000, 0).unwrap();
    let draws = 0.05_f64.ln() / (1.0 - pool.unseen()).ln();
    // 2.25 per particle, in a whole number of groups of 16.
    assert_eq!(draws.round(), 2240.0);
}

#[test]
fn more_effort_meets_more_needles() {
    let target = Needles([[-1.0, 0.3, 0.5], [1.6, 1.4, -0.5], [1.3, -2.2, 1.0]]);
    let met = |search_effort: f64| {
        let options = PoolOptions {
            search_effort,
            ..PoolOptions::default()
        };
        let pools = (0..6).map(|seed| pool_with(&target, 500, seed, &options).unwrap());
        pools.filter(|pool| pool.log_evidence.abs() < 0.05).count()
    };
    let (as_is, more) = (met(1.0), met(4.0));
    assert!(more > as_is, "{as_is} {more}");
}

#[test]
fn an_effort_below_one_is_refused() {
    let target = Needles([[-1.0, 0.3], [2.1, 1.4], [1.3, -2.2]]);
    for search_effort in [0.99, f64::NAN, f64::INFINITY] {
        let options = PoolOptions {
            search_effort,
            ..PoolOptions::default()
        };
        let refused = pool_with(&target, 500, 0, &options).unwrap_err();
        assert!(refused.to_string().contains("search effort"), "{refused}");
    }
}
