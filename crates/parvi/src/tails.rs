//! Whether log p falls off: fast enough for an integral, where a pool does not know it, and for standard deviations.

use mpm_tensor::vector;
use parvi_pool::Pool;
use parvi_targets::{Frame, Target, log_densities_in_calls};

use crate::drawn::drawn_indices;

/// Rays that are looked along.
const RAYS: usize = 16;

/// Where: in units of the distance of the point that a ray leads through.
const NEAR: f64 = 10.0;
const FAR: f64 = 1e3;

/// A tail r^−(D + ν) makes r^D p fall by ν ln (FAR/NEAR); at least this much is a fall: ν ≥ 0.1.
const LEAST_FALL: f64 = 0.5;

/// r^(D + 2) p there over that at the point below which it is nothing, as where log p has a floor that keeps programs from −∞.
const LEAST: f64 = 1e-6;

/// Standard error of the log evidence above which the integral may be infinite.
const UNKNOWN: f64 = 1.0;

/// What rays say, and what they took: of each, how many there are and of how many, where these are half of all or more.
pub(crate) struct Tails {
    /// Rays along which r^D p does not fall off.
    pub endless: Option<[usize; 2]>,
    /// Rays along which r^(D + 2) p does not.
    pub spreadless: Option<[usize; 2]>,
    /// Evaluations of the log density.
    pub densities: u64,
}

impl Tails {
    /// Rays from the frame's origin through points drawn from the pool. The integral of p over a cone about one of them is ∫ r^D p d ln r but for a factor: it is finite only where r^D p
    /// falls, which is not asked where the pool knows log Z within 1; that of r² p where r^(D + 2) p does.
    pub fn of<const D: usize>(target: &dyn Target<D>, frame: &Frame<D>, pool: &Pool<D>) -> Self {
        let origin = frame.to_target(&[0.0; D]);
        let points = drawn_indices(pool, RAYS, 0.5);
        let rays: Vec<[f64; D]> = points
            .iter()
            .map(|&point| vector::subtract(&pool.positions[point], &origin))
            .collect();
        let own: Vec<f64> = points.iter().map(|&point| pool.log_densities[point]).collect();
        let [near, far] = [NEAR, FAR].map(|t| {
            let places: Vec<[f64; D]> = rays.iter().map(|ray| vector::add_scaled(&origin, t, ray)).collect();
            let mut logs = vec![0.0; places.len()];
            log_densities_in_calls(target, &places, &mut logs);
            logs
        });
        // None of what is no number is above.
        let count = |is_one: &dyn Fn(usize) -> bool| {
            let count = (0..rays.len()).filter(|&ray| is_one(ray)).count();
            (2 * count >= rays.len().max(1)).then_some([count, rays.len()])
        };
        let change =
            |power: usize, from: &[f64], t: f64, ray: usize| far[ray] - from[ray] + power as f64 * (FAR / t).ln();
        let is_known = pool.log_evidence_error <= UNKNOWN;
        let is_endless = |ray: usize| change(D, &near, NEAR, ray) > -LEAST_FALL;
        let is_spreadless =
            |ray: usize| change(D + 2, &near, NEAR, ray) > -LEAST_FALL && change(D + 2, &own, 1.0, ray) > LEAST.ln();
        Self {
            endless: if is_known { None } else { count(&is_endless) },
            spreadless: count(&is_spreadless),
            densities: 2 * rays.len() as u64,
        }
    }
}
