//! Whether log p falls off, where a pool does not know its integral.

use mpm_tensor::vector;
use parvi_pool::Pool;
use parvi_targets::{Frame, Target};

use crate::drawn::drawn;

/// Rays that are looked along.
const RAYS: usize = 16;

/// Where: in units of the distance of the point that a ray leads through.
const NEAR: f64 = 10.0;
const FAR: f64 = 1e3;

/// A tail r^−(D + ν) makes r^D p fall by ν ln (FAR/NEAR); at least this much is a fall: ν ≥ 0.1.
const LEAST_FALL: f64 = 0.5;

/// Standard error of the log evidence above which the rays are looked along.
const UNKNOWN: f64 = 1.0;

/// What rays say, and what they took.
pub(crate) struct Tails {
    /// Rays along which log p does not fall off, of so many, where they are half of all or more.
    pub endless: Option<[usize; 2]>,
    /// Evaluations of the log density.
    pub densities: u64,
}

impl Tails {
    /// Rays from the frame's origin through points drawn from the pool. The integral of p over a cone about one of them is ∫ r^D p d ln r but for a factor: it is finite only where r^D p
    /// falls. Nothing is evaluated where the pool knows log Z within 1.
    pub fn of<const D: usize>(target: &dyn Target<D>, frame: &Frame<D>, pool: &Pool<D>) -> Self {
        if pool.log_evidence_error <= UNKNOWN {
            return Self {
                endless: None,
                densities: 0,
            };
        }
        let origin = frame.to_target(&[0.0; D]);
        let rays: Vec<[f64; D]> = drawn(pool, RAYS, 0.5)
            .iter()
            .map(|x| vector::subtract(x, &origin))
            .collect();
        let [near, far] = [NEAR, FAR].map(|t| {
            let places: Vec<[f64; D]> = rays.iter().map(|ray| vector::add_scaled(&origin, t, ray)).collect();
            let mut logs = vec![0.0; places.len()];
            target.log_densities(&places, &mut logs);
            logs
        });
        let change_of_volume = D as f64 * (FAR / NEAR).ln();
        // Not of what is no number.
        let is_endless = |(near, far): &(&f64, &f64)| *far - *near + change_of_volume > -LEAST_FALL;
        let endless = near.iter().zip(&far).filter(is_endless).count();
        Self {
            endless: (2 * endless >= rays.len().max(1)).then_some([endless, rays.len()]),
            densities: 2 * rays.len() as u64,
        }
    }
}
