//! What the runs say about the best spacing and about the end of the particles' influence.

/// More particles help if they lower ED² at least by this factor.
const HELP: f64 = 0.9;

/// The first number of particles beyond which more do not help, in words, from pairs (M, ED²), few particles first; `None` for fewer
/// than two pairs.
pub fn saturation(errors: &[(usize, f64)]) -> Option<String> {
    let (last, _) = *errors.last().filter(|_| errors.len() > 1)?;
    let stopped = errors.windows(2).find(|pair| pair[1].1 > HELP * pair[0].1);
    Some(match stopped {
        Some(pair) => format!("beyond {}", pair[0].0),
        None => format!("they do up to {last}"),
    })
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
        assert_eq!(saturation(&falling), Some("they do up to 2048".to_owned()));
        let level = [(128, 8.0), (512, 2.0), (2048, 1.9), (8192, 1.0)];
        assert_eq!(saturation(&level), Some("beyond 512".to_owned()));
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
