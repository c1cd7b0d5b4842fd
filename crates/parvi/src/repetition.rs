//! Whether log p is a function of the point, at a few points of a pool.

use parvi_pool::Pool;
use parvi_targets::{Target, log_densities_in_calls};

use crate::certificate::Doubt;
use crate::drawn::drawn_indices;

/// Points that are evaluated once more.
const POINTS: usize = 4;

/// Differences up to this, and to this part of |log p|, are those of sums in another order.
const ROUNDING: f64 = 1e-3;
const RELATIVE_ROUNDING: f64 = 1e-9;

/// What a second evaluation has found, and what it took.
pub(crate) struct Repetition {
    /// By how much log p differs, where that is more than rounding explains.
    pub doubt: Option<Doubt>,
    /// Evaluations of the log density.
    pub densities: u64,
}

impl Repetition {
    /// Compares log p at points of equal shares of the pool's weights, the same ones in every run of the pool, with what it was there before.
    pub fn of<const D: usize>(target: &dyn Target<D>, pool: &Pool<D>) -> Self {
        let indices = drawn_indices(pool, POINTS, 0.5);
        let points: Vec<[f64; D]> = indices.iter().map(|&index| pool.positions[index]).collect();
        let mut again = vec![0.0; points.len()];
        log_densities_in_calls(target, &points, &mut again);
        let difference = |(&index, again): (&usize, &f64)| {
            let before = pool.log_densities[index];
            let difference = (again - before).abs();
            // What is no number now was one before.
            let is_rounding = difference <= ROUNDING + RELATIVE_ROUNDING * before.abs();
            (!is_rounding).then_some(if difference.is_nan() { f64::INFINITY } else { difference })
        };
        let differences: Vec<f64> = indices.iter().zip(&again).filter_map(difference).collect();
        let largest = differences.iter().copied().reduce(f64::max);
        let doubt = largest.map(|largest| Doubt::AnotherValue {
            points: differences.len(),
            of: points.len(),
            largest,
        });
        Self {
            doubt,
            densities: points.len() as u64,
        }
    }
}
