//! Particles that condensation left where the target has no mass.

use mpm_tensor::vector;
use parvi_pool::Pool;
use parvi_targets::{Target, log_densities_in_calls};

/// Part of a particle's mass that lies at lower densities than a particle may have.
pub(crate) const BEYOND: f64 = 0.01;

/// Puts every particle where p is lower than nearly everywhere under the target onto the nearest of the pool's points where it is not; how often log p was evaluated.
///
/// Support points of a signed measure may be pushed out by negative weights, and far from all mass nothing but a share 1/M of it pulls them back; beyond an edge of the
/// target, too. The level is that of all but the share `beyond`/M of the pool's mass: 1/(100 M), so that no tail is cut that M particles could stand for, or 0, the level of its lowest point. No point
/// is given to two particles.
pub(crate) fn bring_back<const D: usize>(
    target: &dyn Target<D>,
    pool: &Pool<D>,
    beyond: f64,
    particles: &mut [[f64; D]],
) -> u64 {
    let mut log_densities = vec![f64::NAN; particles.len()];
    log_densities_in_calls(target, particles, &mut log_densities);
    let level = level(pool, beyond / particles.len() as f64);
    let frame = pool.measure.frame();
    let inside = pool
        .positions
        .iter()
        .zip(&pool.log_densities)
        .filter(|(_, log)| **log >= level);
    let mut inside: Vec<([f64; D], [f64; D])> = inside.map(|(x, _)| (frame.to_reference(x), *x)).collect();
    let is_stray = |log: &f64| !log.is_finite() || *log < level;
    for (particle, _) in particles
        .iter_mut()
        .zip(&log_densities)
        .filter(|(_, log)| is_stray(log))
    {
        let z = frame.to_reference(particle);
        let distances = inside.iter().map(|(y, _)| vector::distance_squared(y, &z)).enumerate();
        if let Some((nearest, _)) = distances.min_by(|a, b| a.1.total_cmp(&b.1)) {
            *particle = inside.swap_remove(nearest).1;
        }
    }
    log_densities.len() as u64
}

/// Whether the target was zero, or no number, anywhere.
pub(crate) fn has_edges<const D: usize>(pool: &Pool<D>) -> bool {
    pool.log_densities.contains(&f64::NEG_INFINITY)
}

/// The log density that all but this share of the pool's mass exceeds or has.
fn level<const D: usize>(pool: &Pool<D>, share: f64) -> f64 {
    let points = pool.log_densities.iter().zip(&pool.weights).filter(|(_, w)| **w > 0.0);
    let mut points: Vec<(f64, f64)> = points.map(|(log, w)| (*log, *w)).collect();
    points.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    let mut below = 0.0;
    let first = points.iter().find(|(_, w)| {
        below += w;
        below > share
    });
    first.map_or(f64::NEG_INFINITY, |(log, _)| *log)
}

#[cfg(test)]
mod tests {
    use parvi_pool::{Beginning, PoolOptions, explore};
    use parvi_targets::{Frame, Gaussian};

    use super::*;

    #[test]
    fn particles_far_from_all_mass_come_to_points_of_their_own_and_no_others_move() {
        let target = Gaussian::<2>::standard();
        let frame = Frame::identity();
        let options = PoolOptions::default();
        let watch = &mut |_: &parvi_pool::Report<'_>| std::ops::ControlFlow::Continue(());
        let pool = explore(&target, Beginning::in_frame(&frame).with_seed(1), 100, &options, watch).expect("a pool");
        let mut particles = pool.condense(100);
        let [first, second] = [[9.0, 0.0], [9.1, 0.0]];
        (particles[3], particles[7]) = (first, second);
        let before = particles.clone();
        assert_eq!(bring_back(&target, &pool, BEYOND, &mut particles), 100);
        let moved: Vec<usize> = (0..100).filter(|&p| particles[p] != before[p]).collect();
        assert_eq!(moved, [3, 7]);
        assert_ne!(particles[3], particles[7]);
        for p in moved {
            // A mass of 1e-4 is beyond radius 4.3.
            assert!((2.0..4.6).contains(&particles[p][0]), "{:?}", particles[p]);
            assert!(pool.positions.contains(&particles[p]));
        }
    }
}
