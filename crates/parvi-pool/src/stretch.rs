//! By how much a Student kernel's draws are farther out than those of a normal one.

use std::sync::OnceLock;

use parvi_targets::gamma_quantile;

/// Logits log(u/(1 − u)) up to which stretches are interpolated, and the intervals that are used for it.
const LARGEST_LOGIT: f64 = 12.0;
const INTERVALS: usize = 192;

/// √(ν/χ²), χ² the quantile of the χ² law with ν degrees of freedom: cubics over the logit of the probability, to 1e-8 of their value, which need no root to be
/// searched for; the quantile itself where 6e-6 of all draws go.
pub(crate) struct Stretch {
    freedom: u32,
    /// Value and derivative at the ends of the intervals.
    nodes: Vec<[f64; 2]>,
}

impl Stretch {
    /// For ν = 16 or 17, made once.
    pub fn of(freedom: u32) -> &'static Self {
        static MADE: [OnceLock<Stretch>; 2] = [OnceLock::new(), OnceLock::new()];
        MADE[freedom as usize % 2].get_or_init(|| Self::new(freedom))
    }

    fn new(freedom: u32) -> Self {
        let node = |k: usize| {
            let logit = (2 * k) as f64 * (LARGEST_LOGIT / INTERVALS as f64) - LARGEST_LOGIT;
            let (u, rest) = (1.0 / (1.0 + (-logit).exp()), 1.0 / (1.0 + logit.exp()));
            let stretch = exact(freedom, u);
            // With x = χ²/2 of density p: d log √(ν/(2x)) / dt = −u (1 − u) / (2 x p(x)).
            let (shape, x) = (0.5 * f64::from(freedom), 0.5 * f64::from(freedom) / (stretch * stretch));
            let x_density = (shape * x.ln() - x - crate::gamma::log_gamma_of_half(freedom)).exp();
            [stretch, -0.5 * stretch * u * rest / x_density]
        };
        Self {
            freedom,
            nodes: (0..=INTERVALS).map(node).collect(),
        }
    }

    /// At the probability u in (0, 1).
    pub fn at(&self, u: f64) -> f64 {
        let width = 2.0 * LARGEST_LOGIT / INTERVALS as f64;
        let place = ((u / (1.0 - u)).ln() + LARGEST_LOGIT) / width;
        if !(0.0..INTERVALS as f64).contains(&place) {
            return exact(self.freedom, u);
        }
        let (k, t) = (place as usize, place.fract());
        let ([value, slope], [next, next_slope]) = (self.nodes[k], self.nodes[k + 1]);
        let (rise, slope, next_slope) = (next - value, width * slope, width * next_slope);
        value + t * (slope + t * (3.0 * rise - 2.0 * slope - next_slope + t * (slope + next_slope - 2.0 * rise)))
    }
}

fn exact(freedom: u32, u: f64) -> f64 {
    let shape = 0.5 * f64::from(freedom);
    (shape / gamma_quantile(shape, u)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stretches_are_those_of_the_quantile() {
        for freedom in [16, 17] {
            let stretch = Stretch::of(freedom);
            let probabilities = (1..4000).map(|n| f64::from(n) / 4000.0);
            let far = [1e-10, 5e-6, 7e-6, 1e-4, 1.0 - 1e-4, 1.0 - 7e-6, 1.0 - 1e-10];
            let errors = probabilities
                .chain(far)
                .map(|u| (stretch.at(u) / exact(freedom, u) - 1.0).abs());
            let worst = errors.fold(0.0, f64::max);
            assert!(worst < 1e-8, "{freedom}: {worst}");
        }
    }
}
