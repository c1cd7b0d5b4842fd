//! Expectations with the part that the scores explain taken from the target instead of the particles.

use parvi_targets::Frame;

use super::stein_polynomials::{MAXIMUM_DEGREE, SteinPolynomials};
use crate::cholesky::Cholesky;

/// Particles that coefficients are fitted to, at most.
const FITTED: usize = 2048;

/// Polynomials, at most.
const LARGEST_COUNT: usize = 128;

/// Particles per polynomial, at least.
const PARTICLES_PER_POLYNOMIAL: usize = 8;

/// Degrees beyond this are taken only where they explain: else they say more about the gaps between particles than about the target.
const MODEST_DEGREE: usize = 4;

/// What a polynomial has to vary by, over its size: with less it is a constant, as the score of an exponential law, and what varies is rounding.
const VARIES: f64 = 1e-9;

/// Ridge of the normal equations, whose diagonal is one.
const RIDGE: f64 = 1e-11;

/// The expectation of a function over particles, and what the scores say about it.
///
/// With the regression f = c + Σ_a β_a A ψ_a + r over the particles and E_p\[A ψ_a\] = 0, the expectation under the target is
/// E_p\[f\] = c + E_p\[r\]: where the polynomials explain f, c is it, whatever the particles are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expectation {
    /// The average of f over the particles.
    pub average: f64,
    /// c, the estimate of E_p\[f\] by the regression, or that of the pool where [`expectation`](crate::expectation) finds it better.
    pub estimate: f64,
    /// Standard deviation of f over the particles.
    pub standard_deviation: f64,
    /// Standard deviation of r, what the polynomials leave unexplained; over the root of the number of particles, where these have equal weights, it is the standard error of the estimate, also of the pool's.
    pub unexplained: f64,
    /// Standard error of the average: ((c − average)² + sd(r)² / ESS)^½. The part that is not explained is taken to be no worse than from
    /// independent draws.
    pub standard_error: f64,
}

impl Expectation {
    /// Of equally weighted values about which no scores are known.
    pub(crate) fn without_scores(values: &[f64]) -> Self {
        let weights = normalised(values.len(), None);
        let (average, standard_deviation) = mean_and_deviation(&weights, |p| values[p]);
        Self {
            average,
            estimate: average,
            standard_deviation,
            unexplained: standard_deviation,
            standard_error: standard_deviation / (values.len() as f64).sqrt(),
        }
    }

    /// That of the function times `unit` > 0.
    pub(crate) fn times(self, unit: f64) -> Self {
        Self {
            average: self.average * unit,
            estimate: self.estimate * unit,
            standard_deviation: self.standard_deviation * unit,
            unexplained: self.unexplained * unit,
            standard_error: self.standard_error * unit,
        }
    }

    /// sd(r) / sd(f); 0 for a constant.
    pub fn unexplained_share(&self) -> f64 {
        if self.standard_deviation > 0.0 {
            self.unexplained / self.standard_deviation
        } else {
            0.0
        }
    }
}

/// The regression's design, made once for any number of functions.
///
/// Source: A. Mira, R. Solgi, D. Imparato, Stat. Comput. 23 (2013) 653–662; the polynomials are those of [`SteinPolynomials`] in the particles'
/// own standardised coordinates.
pub(crate) struct ControlVariates<const D: usize> {
    weights: Vec<f64>,
    /// 1 / Σ w².
    effective_size: f64,
    /// Every `stride`-th particle is fitted to.
    stride: usize,
    /// √w (A ψ_a − mean) / sd, for each polynomial, of each fitted particle.
    design: Vec<Vec<f64>>,
    factor: Cholesky,
    /// Means of A ψ_a over all particles, in units of the columns' sd.
    means: Vec<f64>,
}

impl<const D: usize> ControlVariates<D> {
    /// What `judge` makes of the regression of the lowest degree that leaves at most `enough` unexplained, which is the first thing that it returns;
    /// else of the modest degree that leaves least. `None` if there is no regression.
    pub fn explaining<T>(
        positions: &[[f64; D]],
        scores: &[[f64; D]],
        weights: Option<&[f64]>,
        enough: f64,
        judge: impl Fn(&Self, usize) -> (f64, T),
    ) -> Option<T> {
        let mut best: Option<(f64, T)> = None;
        for degree in Self::degrees(positions.len()) {
            let Some(regression) = Self::new(positions, scores, weights, degree) else {
                break;
            };
            let (unexplained, judged) = judge(&regression, degree);
            if unexplained <= enough {
                return Some(judged);
            }
            if degree <= MODEST_DEGREE && best.as_ref().is_none_or(|(least, _)| unexplained < *least) {
                best = Some((unexplained, judged));
            }
        }
        best.map(|(_, judged)| judged)
    }

    /// The degrees that may be tried for this many particles, from below.
    fn degrees(particles: usize) -> impl Iterator<Item = usize> {
        let largest = (particles.min(FITTED) / PARTICLES_PER_POLYNOMIAL).min(LARGEST_COUNT);
        [1, 2, 3, 4, 6, 8, 10, MAXIMUM_DEGREE]
            .into_iter()
            .filter(move |&degree| SteinPolynomials::<D>::count(degree) <= largest)
    }

    /// Of particles with their scores and weights (`None`: equal ones); `None` if the particles lie in a plane or a score is not finite.
    pub fn new(positions: &[[f64; D]], scores: &[[f64; D]], weights: Option<&[f64]>, degree: usize) -> Option<Self> {
        let weights = normalised(positions.len(), weights);
        let frame = Frame::of_points(positions, Some(&weights)).ok()?;
        let polynomials = SteinPolynomials::<D>::new(degree);
        let (count, stride) = (polynomials.len(), positions.len().div_ceil(FITTED).max(1));
        let mut design = vec![vec![0.0; positions.len().div_ceil(stride)]; count];
        let mut means = vec![0.0; count];
        for (p, (x, s)) in positions.iter().zip(scores).enumerate() {
            polynomials.evaluate(&frame.to_reference(x), &frame.pull_back_score(s), |k, value| {
                means[k] += weights[p] * value;
                if p % stride == 0 {
                    design[k][p / stride] = value;
                }
            });
        }
        let fitted = fitted_weights(&weights, stride);
        for (column, mean) in design.iter_mut().zip(&mut means) {
            let (centre, deviation) = mean_and_deviation(&fitted, |row| column[row]);
            // Over infinity a constant is zero, and explains nothing.
            let deviation = if deviation > VARIES * centre.abs() {
                deviation
            } else {
                f64::INFINITY
            };
            *mean /= deviation;
            for (entry, weight) in column.iter_mut().zip(&fitted) {
                *entry = weight.sqrt() * (*entry - centre) / deviation;
            }
        }
        let entry = |i: usize, k: usize| dot(&design[i], &design[k]) + if i == k { RIDGE } else { 0.0 };
        let gram = (0..count).map(|i| (0..=i).map(|k| entry(i, k)).collect()).collect();
        Some(Self {
            effective_size: weights.iter().map(|weight| weight * weight).sum::<f64>().recip(),
            factor: Cholesky::new(gram)?,
            weights,
            stride,
            design,
            means,
        })
    }

    /// The expectation of the function with these values at the particles.
    pub fn expectation(&self, values: &[f64]) -> Expectation {
        let (average, standard_deviation) = mean_and_deviation(&self.weights, |p| values[p]);
        let fitted = fitted_weights(&self.weights, self.stride);
        let (centre, _) = mean_and_deviation(&fitted, |row| values[row * self.stride]);
        let centred = |row: usize| fitted[row].sqrt() * (values[row * self.stride] - centre);
        let mut residual: Vec<f64> = (0..fitted.len()).map(centred).collect();
        let projections: Vec<f64> = self.design.iter().map(|column| dot(column, &residual)).collect();
        let coefficients = self.factor.solve(&projections);
        for (column, coefficient) in self.design.iter().zip(&coefficients) {
            for (rest, entry) in residual.iter_mut().zip(column) {
                *rest -= coefficient * entry;
            }
        }
        let explained = dot(&coefficients, &self.means);
        let rows = fitted.len() as f64;
        let degrees_of_freedom = (rows - self.means.len() as f64 - 1.0).max(1.0);
        let unexplained = dot(&residual, &residual).sqrt() * (rows / degrees_of_freedom).sqrt();
        Expectation {
            average,
            estimate: average - explained,
            standard_deviation,
            unexplained,
            standard_error: explained.hypot(unexplained / self.effective_size.sqrt()),
        }
    }
}

/// Σ_k a_k b_k in eight sums side by side, which vector instructions can take.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (a, a_rest) = a.as_chunks::<8>();
    let (b, b_rest) = b.as_chunks::<8>();
    let mut sums = [0.0; 8];
    for (a, b) in a.iter().zip(b) {
        for l in 0..8 {
            sums[l] += a[l] * b[l];
        }
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum();
    sums.iter().sum::<f64>() + rest
}

/// Weights that sum to one.
fn normalised(count: usize, weights: Option<&[f64]>) -> Vec<f64> {
    match weights {
        None => vec![1.0 / count as f64; count],
        Some(weights) => {
            let total: f64 = weights.iter().sum();
            weights.iter().map(|weight| weight / total).collect()
        }
    }
}

/// The weights of the particles that are fitted to, which sum to one again.
fn fitted_weights(weights: &[f64], stride: usize) -> Vec<f64> {
    let own: Vec<f64> = weights.iter().copied().step_by(stride).collect();
    normalised(own.len(), Some(&own))
}

/// Mean and standard deviation of `value(k)` with weights that sum to one; a deviation of zero counts as the smallest number.
fn mean_and_deviation(weights: &[f64], value: impl Fn(usize) -> f64) -> (f64, f64) {
    let mean: f64 = weights.iter().enumerate().map(|(k, weight)| weight * value(k)).sum();
    let square = |(k, weight): (usize, &f64)| weight * (value(k) - mean).powi(2);
    let variance: f64 = weights.iter().enumerate().map(square).sum();
    (mean, variance.sqrt().max(f64::MIN_POSITIVE))
}

#[cfg(test)]
mod tests {
    use mpm_tensor::Matrix;
    use parvi_targets::{CatalogueTarget, Gaussian, StudentT, Target};
    use rand::SeedableRng;
    use rand::rngs::ChaCha8Rng;

    use super::*;

    fn draws<const D: usize>(target: &dyn CatalogueTarget<D>, count: usize) -> (Vec<[f64; D]>, Vec<[f64; D]>) {
        let mut generator = ChaCha8Rng::seed_from_u64(7);
        let exact = target.exact_draws().unwrap();
        let positions: Vec<[f64; D]> = (0..count).map(|_| exact.draw(&mut generator)).collect();
        let scores = positions.iter().map(|x| target.score(x)).collect();
        (positions, scores)
    }

    #[test]
    fn moments_of_a_gaussian_come_out_exact_from_any_particles() {
        let covariance = Matrix([[2.0, 0.5], [0.5, 0.3]]);
        let target = Gaussian::new([3.0, -1.0], covariance).unwrap();
        let (mut positions, _) = draws(&target, 5000);
        for x in &mut positions {
            *x = [1.3 * x[0] + 0.7, x[1] - 0.2]; // off in place and width
        }
        let scores: Vec<[f64; 2]> = positions.iter().map(|x| target.score(x)).collect();
        let regression = ControlVariates::new(&positions, &scores, None, 2).unwrap();
        let first: Vec<f64> = positions.iter().map(|x| x[0]).collect();
        let square: Vec<f64> = positions.iter().map(|x| x[0] * x[1]).collect();
        assert!((regression.expectation(&first).estimate - 3.0).abs() < 1e-9);
        assert!((regression.expectation(&square).estimate - (0.5 - 3.0)).abs() < 1e-8);
        assert!(regression.expectation(&first).standard_error > 0.5);
    }

    #[test]
    fn the_variance_of_a_heavy_tail_is_seen_beyond_the_particles() {
        let target = StudentT::<2>::new(5.0).unwrap();
        let (positions, _) = draws(&target, 2000);
        let narrow: Vec<[f64; 2]> = positions.iter().map(|x| x.map(|c| c.clamp(-2.5, 2.5))).collect();
        let scores: Vec<[f64; 2]> = narrow.iter().map(|x| target.score(x)).collect();
        let regression = ControlVariates::new(&narrow, &scores, None, 4).unwrap();
        let square: Vec<f64> = narrow.iter().map(|x| x[0] * x[0]).collect();
        let found = regression.expectation(&square);
        assert!((found.estimate / (5.0 / 3.0) - 1.0).abs() < 0.01, "{found:?}");
        assert!(found.average < 1.5, "{found:?}");
    }

    #[test]
    fn what_polynomials_do_not_explain_is_said() {
        let target = Gaussian::<1>::standard();
        let (positions, scores) = draws(&target, 1000);
        let regression = ControlVariates::new(&positions, &scores, None, 4).unwrap();
        let step: Vec<f64> = positions.iter().map(|x| f64::from(x[0] > 0.3)).collect();
        let found = regression.expectation(&step);
        assert!(found.unexplained_share() > 0.2);
        assert!((found.average - 0.382).abs() < 4.0 * found.standard_error);
    }

    #[test]
    fn weights_and_repeated_particles_are_the_same() {
        let target = StudentT::<1>::new(5.0).unwrap();
        let (positions, scores) = draws(&target, 60);
        let weights: Vec<f64> = (0..60).map(|p| f64::from(1 + p % 3)).collect();
        let repeat =
            |points: &[[f64; 1]]| -> Vec<[f64; 1]> { (0..60).flat_map(|p| vec![points[p]; 1 + p % 3]).collect() };
        let weighted = ControlVariates::new(&positions, &scores, Some(&weights), 3).unwrap();
        let repeated = ControlVariates::new(&repeat(&positions), &repeat(&scores), None, 3).unwrap();
        let values: Vec<f64> = positions.iter().map(|x| x[0].sin()).collect();
        let again: Vec<f64> = repeat(&positions).iter().map(|x| x[0].sin()).collect();
        let (a, b) = (weighted.expectation(&values), repeated.expectation(&again));
        assert!((a.average - b.average).abs() < 1e-12 && (a.estimate - b.estimate).abs() < 1e-9);
    }

    #[test]
    fn a_constant_score_explains_nothing() {
        // Exponential laws, of which two scores are constant up to the edges.
        let uniform = |p: u32, rate: f64| (rate * (f64::from(p) + 0.5)).fract();
        let positions: Vec<[f64; 2]> = (0..500)
            .map(|p| [uniform(p, 0.754_877_666), uniform(p, 0.569_840_291)].map(|u| -u.ln()))
            .collect();
        let scores = vec![[-1.0; 2]; 500];
        let event: Vec<f64> = positions.iter().map(|x| f64::from(x[0] > 1.0)).collect();
        for degree in 1..=4 {
            let regression = ControlVariates::new(&positions, &scores, None, degree).unwrap();
            let found = regression.expectation(&event);
            assert!(found.standard_error < 2.0, "{degree}: {found:?}");
        }
    }

    #[test]
    fn particles_in_a_plane_have_no_regression() {
        let flat = vec![[1.0, 2.0]; 50];
        assert!(ControlVariates::new(&flat, &flat, None, 2).is_none());
    }
}
