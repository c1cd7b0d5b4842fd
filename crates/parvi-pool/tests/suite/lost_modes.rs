//! Modes that a round has met and a later proposal has lost.

use parvi_targets::Target;

use crate::common::pool_of;

/// 0.98 N(0, I) + 0.02 N(5·1, 0.3² I).
struct Satellite;

impl Satellite {
    fn logs(x: &[f64; 3]) -> [f64; 2] {
        let near: f64 = x.iter().map(|c| c * c).sum();
        let far: f64 = x.iter().map(|c| (c - 5.0).powi(2)).sum();
        [
            0.98_f64.ln() - 0.5 * near,
            0.02_f64.ln() - 3.0 * 0.3_f64.ln() - 0.5 * far / 0.09,
        ]
    }

    /// log p, and the mode's share of p.
    fn of(x: &[f64; 3]) -> (f64, f64) {
        let [near, far] = Self::logs(x);
        let top = near.max(far);
        let [near, far] = [near, far].map(|log| (log - top).exp());
        (top + (near + far).ln(), far / (near + far))
    }
}

impl Target<3> for Satellite {
    fn log_density(&self, x: &[f64; 3]) -> f64 {
        Self::of(x).0
    }

    fn score(&self, x: &[f64; 3]) -> [f64; 3] {
        let share = Self::of(x).1;
        x.map(|c| -(1.0 - share) * c - share * (c - 5.0) / 0.09)
    }
}

/// With seed 27 the fresh points of the first frozen proposal lack the mode.
#[test]
fn a_mode_that_fresh_points_have_lost_is_not_forgotten() {
    for seed in [1, 24, 27] {
        let pool = pool_of(&Satellite, 1000, seed).expect("a pool");
        assert_eq!(pool.objection(1000), None);
        assert!(
            pool.inconsistency > 0.1 && pool.inconsistency < 3.0,
            "{}",
            pool.inconsistency
        );
        let mean = pool.expectation(|x| x[0] + x[1] + x[2]);
        assert!(
            (mean.value - 0.3).abs() < 4.0 * mean.standard_error,
            "seed {seed}: {mean:?}"
        );
    }
}
