//! What the runs say about the best spacing and about the end of the particles' influence.

use super::Series;
use crate::study::prelude::*;

/// More particles help if they lower ED² at least by this factor.
const HELP: f64 = 0.9;

/// The spacing with the lowest median ED², and its runs; of runs in one dimension.
pub fn best<'a>(here: &Rows<'a>, series: &Series, particles: usize) -> Option<(f64, Rows<'a>)> {
    let here = here.with("particles", particles);
    let at = |spacing: f64| {
        let runs = here.with("requested_spacing", spacing);
        Some((runs.median(ENERGY)?, spacing, runs))
    };
    let errors = series.sorted().into_iter().filter_map(at);
    let (_, spacing, runs) = errors.min_by(|left, right| left.0.total_cmp(&right.0))?;
    Some((spacing, runs))
}

/// Where the error stops being that of the particles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Saturation {
    /// From this number of particles to the next, ED² falls by less than a tenth.
    Beyond(usize),
    /// Not up to this number, the largest one.
    NotUpTo(usize),
}

/// The first number of particles beyond which more do not help, from pairs (M, ED²), few particles first; `None` for fewer
/// than two pairs.
pub fn saturation(errors: &[(usize, f64)]) -> Option<Saturation> {
    let (last, _) = *errors.last().filter(|_| errors.len() > 1)?;
    let stopped = errors.windows(2).find(|pair| pair[1].1 > HELP * pair[0].1);
    Some(stopped.map_or(Saturation::NotUpTo(last), |pair| Saturation::Beyond(pair[0].0)))
}

/// The exponent b of ED² ∝ M^b between the last two of pairs (M, ED²).
pub fn gain(errors: &[(usize, f64)]) -> Option<f64> {
    let [.., (fewer, before), (more, after)] = errors else {
        return None;
    };
    let exponent = (after / before).ln() / (*more as f64 / *fewer as f64).ln();
    exponent.is_finite().then_some(exponent)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_particles_influence_ends_where_the_error_stays() {
        let falling = [(128, 8.0), (512, 2.0), (2048, 0.5)];
        assert_eq!(saturation(&falling), Some(Saturation::NotUpTo(2048)));
        let level = [(128, 8.0), (512, 2.0), (2048, 1.9), (8192, 1.0)];
        assert_eq!(saturation(&level), Some(Saturation::Beyond(512)));
        assert_eq!(saturation(&falling[..1]), None);
        assert_eq!(saturation(&[]), None);
    }

    #[test]
    fn the_gain_is_an_exponent() {
        assert!((gain(&[(1, 9.0), (10, 100.0), (100, 1.0)]).unwrap() + 2.0).abs() < 1e-12);
        assert_eq!(gain(&[(10, 100.0)]), None);
        assert_eq!(gain(&[(10, 0.0), (100, 1.0)]), None);
    }
}
