//! The posterior of log τ in the model of the eight schools, by quadrature.

use crate::special::{HALF_LOG_TWO_PI, increasing_root, log_cosh};

/// Standard deviation of the prior of μ, and scale of that of τ.
pub(crate) const PRIOR_SCALE: f64 = 5.0;

/// The quadrature runs over log τ from here …
const START: f64 = -45.0;
/// … in cells of this width …
const CELL: f64 = 0.125;
/// … up to log τ = 30: below and above less than 1e-19 of the mass is left.
const CELLS: usize = 600;

/// Abscissae and weights of Gauss and Legendre's rule with five points on [−1, 1].
const RULE: [[f64; 2]; 5] = [
    [-0.906_179_845_938_664, 0.236_926_885_056_189_1],
    [-0.538_469_310_105_683_1, 0.478_628_670_499_366_5],
    [0.0, 0.568_888_888_888_888_9],
    [0.538_469_310_105_683_1, 0.478_628_670_499_366_5],
    [0.906_179_845_938_664, 0.236_926_885_056_189_1],
];

/// An effect y_j and its standard error σ_j.
pub(crate) type School = [f64; 2];

/// What is left of the model at a given τ once the η_j are integrated out: y_j ~ N(μ, v_j), v_j = σ_j² + τ².
pub(crate) struct GivenScale {
    /// E(μ | τ, y) = (Σ y_j/v_j) / Λ.
    pub(crate) mean: f64,
    /// Λ = 1/25 + Σ 1/v_j, the precision of μ given τ and y.
    pub(crate) precision: f64,
    /// log p(y | τ) + log p(log τ), μ integrated out too.
    pub(crate) log_density: f64,
}

impl GivenScale {
    /// log p(y | τ) = −½ Σ log 2π v_j − ½ log 25Λ − ½ (Σ y_j²/v_j − (Σ y_j/v_j)²/Λ), and with τ ~ half-Cauchy(5) the density of
    /// log τ is sech(log τ − log 5) / π.
    pub(crate) fn new(schools: &[School], log_scale: f64) -> Self {
        let variance_between = (2.0 * log_scale).exp();
        let mut precision = (PRIOR_SCALE * PRIOR_SCALE).recip();
        let (mut weighted, mut square, mut log_variances) = (0.0, 0.0, 0.0);
        for [y, sigma] in schools {
            let variance = sigma * sigma + variance_between;
            precision += 1.0 / variance;
            weighted += y / variance;
            square += y * y / variance;
            log_variances += 0.5 * variance.ln() + HALF_LOG_TWO_PI;
        }
        let misfit = square - weighted * weighted / precision;
        let log_prior = -log_cosh(log_scale - PRIOR_SCALE.ln()) - std::f64::consts::PI.ln();
        Self {
            mean: weighted / precision,
            precision,
            log_density: log_prior - log_variances - 0.5 * ((PRIOR_SCALE * PRIOR_SCALE * precision).ln() + misfit),
        }
    }
}

/// The marginal posterior of log τ: its constant, its quantiles, and integrals over it.
///
/// Five Gauss points in each of 600 cells: the density is analytic within π/2 of the real line, so the rule's error in a
/// cell is of the order (4π/CELL)^−10 < 1e-17 of its mass.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ScaleMarginal {
    schools: Vec<School>,
    /// The mass below each cell's lower end, and all of it last; not normalised.
    cumulated: Vec<f64>,
}

impl ScaleMarginal {
    pub(crate) fn new(schools: &[School]) -> Self {
        let mut marginal = Self {
            schools: schools.to_vec(),
            cumulated: vec![0.0],
        };
        let mut below = 0.0;
        for cell in 0..CELLS {
            below += marginal.mass_between(cell as f64 * CELL, (cell + 1) as f64 * CELL);
            marginal.cumulated.push(below);
        }
        marginal
    }

    /// p(y).
    fn evidence(&self) -> f64 {
        self.cumulated[CELLS]
    }

    /// log p(y).
    pub(crate) fn log_evidence(&self) -> f64 {
        self.evidence().ln()
    }

    /// E(f(log τ, what is left of the model there) | y), component by component.
    pub(crate) fn expectation<const N: usize>(&self, f: impl Fn(f64, &GivenScale) -> [f64; N]) -> [f64; N] {
        let mut sums = [0.0; N];
        for cell in 0..CELLS {
            for [abscissa, weight] in RULE {
                let log_scale = START + CELL * (cell as f64 + 0.5 * (abscissa + 1.0));
                let given = GivenScale::new(&self.schools, log_scale);
                let mass = 0.5 * CELL * weight * given.log_density.exp() / self.evidence();
                for (sum, value) in sums.iter_mut().zip(f(log_scale, &given)) {
                    *sum += mass * value;
                }
            }
        }
        sums
    }

    /// The value of log τ below which the mass `u` lies; the error in u is below 1e-14.
    pub(crate) fn quantile(&self, u: f64) -> f64 {
        let goal = u * self.evidence();
        let cell = self.cumulated.partition_point(|&below| below < goal).clamp(1, CELLS) - 1;
        let [low, high] = [cell, cell + 1].map(|cell| cell as f64 * CELL);
        let share = (goal - self.cumulated[cell]) / (self.cumulated[cell + 1] - self.cumulated[cell]);
        let excess = |place| self.cumulated[cell] + self.mass_between(low, place) - goal;
        START + increasing_root(excess, |place| self.density(place), [low, high], low + share * CELL)
    }

    /// The density at START + `place`, not normalised. Places count from the start, where rounding is the same everywhere.
    fn density(&self, place: f64) -> f64 {
        GivenScale::new(&self.schools, START + place).log_density.exp()
    }

    fn mass_between(&self, low: f64, high: f64) -> f64 {
        let half = 0.5 * (high - low);
        let sum: f64 = (RULE.iter())
            .map(|[abscissa, weight]| weight * self.density(low + half * (abscissa + 1.0)))
            .sum();
        half * sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCHOOLS: [School; 3] = [[28.0, 15.0], [8.0, 10.0], [-3.0, 16.0]];

    /// Simpson's rule on a fine grid, for the mass below `end`.
    fn simpson(marginal: &ScaleMarginal, end: f64) -> f64 {
        let count = 20_000;
        let step = (end - START) / f64::from(count);
        let inner: f64 = (1..count)
            .map(|i| marginal.density(f64::from(i) * step) * if i % 2 == 1 { 4.0 } else { 2.0 })
            .sum();
        step / 3.0 * (marginal.density(0.0) + inner + marginal.density(end - START))
    }

    #[test]
    fn quantiles_invert_the_distribution_function() {
        for count in 1..=3 {
            let marginal = ScaleMarginal::new(&SCHOOLS[..count]);
            let all = simpson(&marginal, 30.0);
            assert!((marginal.evidence() / all - 1.0).abs() < 1e-10);
            for u in [1e-12, 1e-6, 0.01, 0.3, 0.5, 0.9, 0.999, 1.0 - 1e-9] {
                let below = simpson(&marginal, marginal.quantile(u)) / all;
                assert!((below - u).abs() < 1e-10, "{count} schools, {u}: {below}");
            }
            assert!(marginal.quantile(0.0) >= START && marginal.quantile(1.0) <= 30.0);
            assert!(marginal.quantile(1e-300).is_finite());
        }
    }

    #[test]
    fn expectations_are_normalised() {
        let marginal = ScaleMarginal::new(&SCHOOLS);
        let [one, below] = marginal.expectation(|log_scale, _| [1.0, f64::from(u8::from(log_scale < 0.0))]);
        assert!((one - 1.0).abs() < 1e-13);
        // A cell begins at 0.
        assert!((marginal.quantile(below)).abs() < 1e-12);
    }
}
