//! Known densities of constrained coordinates through their transforms: integrals, exact draws, far tails.

use parvi_targets::{ConstrainedTarget, Constraints, ScoreOnly, Target, correlation_matrix};
use proptest::prelude::*;
use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;
use rand_distr::{Beta, Distribution, Gamma};
use statrs::function::gamma::ln_gamma;

/// Gamma densities ∝ x^(a−1) e^(−bx) on every coordinate.
#[derive(Clone)]
struct Gammas<const N: usize>(f64, f64);

impl<const N: usize> Target<N> for Gammas<N> {
    fn log_density(&self, x: &[f64; N]) -> f64 {
        x.iter().map(|x| (self.0 - 1.0) * x.ln() - self.1 * x).sum()
    }

    fn score(&self, x: &[f64; N]) -> [f64; N] {
        x.map(|x| (self.0 - 1.0) / x - self.1)
    }
}

/// ∝ (x + 1)^(a−1) (3 − x)^(b−1) on (−1, 3).
struct ShiftedBeta(f64, f64);

impl Target<1> for ShiftedBeta {
    fn log_density(&self, x: &[f64; 1]) -> f64 {
        (self.0 - 1.0) * (x[0] + 1.0).ln() + (self.1 - 1.0) * (3.0 - x[0]).ln()
    }

    fn score(&self, x: &[f64; 1]) -> [f64; 1] {
        [(self.0 - 1.0) / (x[0] + 1.0) - (self.1 - 1.0) / (3.0 - x[0])]
    }
}

/// Independent standard logistic densities, normalised.
struct Logistic;

impl<const N: usize> Target<N> for Logistic {
    fn log_density(&self, x: &[f64; N]) -> f64 {
        x.iter().map(|x| -x.abs() - 2.0 * (-x.abs()).exp().ln_1p()).sum()
    }

    fn score(&self, x: &[f64; N]) -> [f64; N] {
        x.map(|x| -(0.5 * x).tanh())
    }
}

/// ∝ Π x_k^(a_k − 1).
struct Dirichlet<const N: usize>([f64; N]);

impl<const N: usize> Target<N> for Dirichlet<N> {
    fn log_density(&self, x: &[f64; N]) -> f64 {
        (0..N).map(|k| (self.0[k] - 1.0) * x[k].ln()).sum()
    }

    fn score(&self, x: &[f64; N]) -> [f64; N] {
        std::array::from_fn(|k| (self.0[k] - 1.0) / x[k])
    }
}

/// The density of Lewandowski, Kurowicka & Joe on 3 × 3 correlation matrices, ∝ (det R)^(η−1).
struct Lkj(f64);

impl Target<3> for Lkj {
    fn log_density(&self, x: &[f64; 3]) -> f64 {
        (self.0 - 1.0) * correlation_matrix::<3>(x).unwrap().determinant().ln()
    }

    fn score(&self, x: &[f64; 3]) -> [f64; 3] {
        let [a, b, c] = *x;
        let determinant = correlation_matrix::<3>(x).unwrap().determinant();
        [b * c - a, a * c - b, a * b - c].map(|half| 2.0 * (self.0 - 1.0) * half / determinant)
    }
}

/// The same density in the Cholesky factor, ∝ L₂₂^(2η−1) L₃₃^(2η−2), whose Jacobian to R is L₂₂.
struct LkjFactor(f64);

impl Target<6> for LkjFactor {
    fn log_density(&self, x: &[f64; 6]) -> f64 {
        (2.0 * self.0 - 1.0) * x[2].ln() + (2.0 * self.0 - 2.0) * x[5].ln()
    }

    fn score(&self, x: &[f64; 6]) -> [f64; 6] {
        let (second, third) = ((2.0 * self.0 - 1.0) / x[2], (2.0 * self.0 - 2.0) / x[5]);
        [0.0, 0.0, second, 0.0, 0.0, third]
    }
}

/// ∫ f(x) q(y) dy by the trapezoidal rule, which converges exponentially for what is analytic and decays.
fn integral<T: Target<N>, const N: usize, const D: usize>(
    target: &ConstrainedTarget<T, N, D>,
    ranges: [[f64; 2]; D],
    step: f64,
    f: impl Fn(&[f64; N]) -> f64,
) -> f64 {
    integrals(target, ranges, step, |x| [f(x)])[0]
}

/// The same of several functions at once.
fn integrals<T: Target<N>, const N: usize, const D: usize, const K: usize>(
    target: &ConstrainedTarget<T, N, D>,
    ranges: [[f64; 2]; D],
    step: f64,
    f: impl Fn(&[f64; N]) -> [f64; K],
) -> [f64; K] {
    let counts = ranges.map(|[low, high]| ((high - low) / step) as usize);
    let points: usize = counts.iter().product();
    let mut sums = [0.0; K];
    for index in 0..points {
        let mut rest = index;
        let y = std::array::from_fn(|axis| {
            let node = rest % counts[axis];
            rest /= counts[axis];
            ranges[axis][0] + step * node as f64
        });
        let weight = target.log_density(&y).exp();
        if weight > 0.0 {
            let values = f(&target.constraints().constrain(&y));
            for (sum, value) in sums.iter_mut().zip(values) {
                *sum += weight * value;
            }
        }
    }
    sums.map(|sum| sum * step.powi(D as i32))
}

fn assert_close(value: f64, exact: f64, what: &str) {
    assert!(
        (value - exact).abs() < 1e-8 * exact.abs(),
        "{what}: {value} for {exact}"
    );
}

#[test]
fn densities_of_one_coordinate_have_their_integrals() {
    let gamma = Constraints::<1, 1>::builder()
        .positive(1)
        .build()
        .unwrap()
        .target(Gammas(2.5, 1.5));
    let constant = (ln_gamma(2.5) - 2.5 * 1.5_f64.ln()).exp();
    assert_close(integral(&gamma, [[-30.0, 6.0]], 0.02, |_| 1.0), constant, "gamma");
    assert_close(
        integral(&gamma, [[-30.0, 6.0]], 0.02, |x| x[0]),
        constant * 2.5 / 1.5,
        "gamma mean",
    );

    let beta = Constraints::<1, 1>::builder().bounded(1, -1.0, 3.0).build().unwrap();
    let beta = beta.target(ShiftedBeta(2.0, 3.0));
    // B(2, 3) = 1/12 and a width of 4; mean −1 + 4 · 2/5.
    let constant = 4_f64.powi(4) / 12.0;
    let range = [[-20.0, 20.0]];
    assert_close(integral(&beta, range, 0.05, |_| 1.0), constant, "beta");
    assert_close(integral(&beta, range, 0.05, |x| x[0]), constant * 0.6, "beta mean");

    let above = Constraints::<1, 1>::builder()
        .lower_bounded(1, 2.0)
        .build()
        .unwrap()
        .target(Logistic);
    let below = Constraints::<1, 1>::builder()
        .upper_bounded(1, 2.0)
        .build()
        .unwrap()
        .target(Logistic);
    let share = 1.0 / (1.0 + 2_f64.exp());
    assert_close(integral(&above, [[-40.0, 6.0]], 0.02, |_| 1.0), share, "above 2");
    assert_close(integral(&below, [[-40.0, 6.0]], 0.02, |_| 1.0), 1.0 - share, "below 2");
}

#[test]
fn a_score_alone_stays_alone_under_constraints() {
    let constraints = Constraints::<1, 1>::builder().positive(1).build().unwrap();
    let score_only = constraints.target(ScoreOnly(|x: &[f64; 1]| [2.0 / x[0] - 2.0]));
    assert!(!Target::<1>::has_log_density(&score_only));
    assert!(Target::<1>::has_log_density(&constraints.target(Gammas::<1>(3.0, 2.0))));
}

#[test]
fn ordered_pairs_are_half_of_all() {
    let pairs = Constraints::<2, 2>::builder()
        .ordered(2)
        .build()
        .unwrap()
        .target(Logistic);
    let range = [[-45.0, 45.0], [-30.0, 5.0]];
    assert_close(integral(&pairs, range, 0.05, |_| 1.0), 0.5, "ordered");
    // Order statistics of two logistic variables: means ∓1.
    assert_close(integral(&pairs, range, 0.05, |x| x[0]), -0.5, "the smaller");
    assert_close(integral(&pairs, range, 0.05, |x| x[1]), 0.5, "the larger");
}

#[test]
fn a_dirichlet_density_has_its_moments() {
    let exponents = [1.5, 2.0, 4.5];
    let target = Constraints::<3, 2>::builder().simplex(3).build().unwrap();
    let target = target.target(Dirichlet(exponents));
    let constant = (exponents.iter().map(|&a| ln_gamma(a)).sum::<f64>() - ln_gamma(8.0)).exp();
    let range = [[-30.0, 30.0]; 2];
    assert_close(integral(&target, range, 0.2, |_| 1.0), constant, "Dirichlet");
    for k in 0..3 {
        let mean = exponents[k] / 8.0;
        assert_close(integral(&target, range, 0.2, |x| x[k]), constant * mean, "mean");
        let square = mean * (exponents[k] + 1.0) / 9.0;
        assert_close(
            integral(&target, range, 0.2, |x| x[k] * x[k]),
            constant * square,
            "square",
        );
    }
}

#[test]
fn correlation_matrices_have_the_volume_and_variance_of_lkj() {
    let range = [[-12.0, 12.0]; 3];
    let correlations = Constraints::<3, 3>::builder().correlation(3).build().unwrap();
    // The volume of the elliptope.
    let half_square = 0.5 * std::f64::consts::PI.powi(2);
    let uniform = correlations.target(Lkj(1.0));
    assert_close(integral(&uniform, range, 0.25, |_| 1.0), half_square, "volume");
    // η = 2: the marginal of a correlation is Beta(5/2, 5/2) on (−1, 1), of variance 1/6.
    let factors = Constraints::<6, 3>::builder()
        .correlation_cholesky(3)
        .build()
        .unwrap()
        .target(LkjFactor(2.0));
    let [constant, squares @ ..] = integrals(&factors, range, 0.25, |x| {
        let last = x[1] * x[3] + x[2] * x[4];
        [1.0, x[1] * x[1], x[3] * x[3], last * last]
    });
    for square in squares {
        assert_close(square / constant, 1.0 / 6.0, "variance");
    }
}

/// Exact draws obey Stein's identities E s = 0 and E y_i s_j = −δ_ij in the unconstrained coordinates.
fn stein<T: Target<N>, const N: usize, const D: usize>(
    target: &ConstrainedTarget<T, N, D>,
    mut draw: impl FnMut(&mut ChaCha8Rng) -> [f64; N],
) {
    const DRAWS: usize = 40_000;
    let mut generator = ChaCha8Rng::seed_from_u64(3);
    let ys: Vec<[f64; D]> = (0..DRAWS)
        .map(|_| target.constraints().unconstrain(&draw(&mut generator)).unwrap())
        .collect();
    let mut scores = vec![[0.0; D]; DRAWS];
    target.scores(&ys, &mut scores);
    let mut densities = vec![0.0; DRAWS];
    target.log_densities(&ys, &mut densities);
    assert_eq!(densities[7], target.log_density(&ys[7]));
    assert_eq!(scores[7], target.score(&ys[7]));
    let z_score = |values: Vec<f64>, expected: f64, what: &str| {
        let mean = values.iter().sum::<f64>() / DRAWS as f64;
        let variance = values.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>() / DRAWS as f64;
        let z = (mean - expected) / (variance / DRAWS as f64).sqrt();
        assert!(z.abs() < 4.5, "{what}: {mean} for {expected}, z = {z}");
    };
    for j in 0..D {
        z_score(scores.iter().map(|s| s[j]).collect(), 0.0, "E s");
        for i in 0..D {
            let products = ys.iter().zip(&scores).map(|(y, s)| y[i] * s[j]).collect();
            z_score(products, if i == j { -1.0 } else { 0.0 }, "E y s");
        }
    }
}

#[test]
fn exact_draws_obey_steins_identities() {
    let gamma = Gamma::new(2.5, 1.0 / 1.5).unwrap();
    let positive = Constraints::<2, 2>::builder()
        .positive(2)
        .build()
        .unwrap()
        .target(Gammas(2.5, 1.5));
    stein(&positive, |rng| [gamma.sample(rng), gamma.sample(rng)]);

    let exponents = [0.8, 2.0, 4.5, 1.0];
    let simplex = Constraints::<4, 3>::builder()
        .simplex(4)
        .build()
        .unwrap()
        .target(Dirichlet(exponents));
    let gammas = exponents.map(|a| Gamma::new(a, 1.0).unwrap());
    stein(&simplex, |rng| {
        let draws = gammas.map(|gamma| gamma.sample(rng));
        let sum: f64 = draws.iter().sum();
        draws.map(|x| x / sum)
    });

    // Partial correlations of level k are Beta(η + (K − k − 1)/2) on (−1, 1).
    let eta = 2.5;
    let first = Beta::new(eta + 0.5, eta + 0.5).unwrap();
    let second = Beta::new(eta, eta).unwrap();
    let mut correlations = move |rng: &mut ChaCha8Rng| {
        let [a, b, partial] = [first, first, second].map(|beta: Beta<f64>| 2.0 * beta.sample(rng) - 1.0);
        [a, b, a * b + partial * ((1.0 - a * a) * (1.0 - b * b)).sqrt()]
    };
    let matrices = Constraints::<3, 3>::builder()
        .correlation(3)
        .build()
        .unwrap()
        .target(Lkj(eta));
    stein(&matrices, &mut correlations);
    let factors = Constraints::<6, 3>::builder()
        .correlation_cholesky(3)
        .build()
        .unwrap()
        .target(LkjFactor(eta));
    stein(&factors, |rng| {
        let [a, b, c] = correlations(rng);
        let diagonal = (1.0 - a * a).sqrt();
        let entry = (c - a * b) / diagonal;
        [1.0, a, diagonal, b, entry, (1.0 - b * b - entry * entry).sqrt()]
    });
}

/// Within ±700 on every axis.
fn far() -> impl Strategy<Value = f64> {
    (-10.0..700_f64.ln(), any::<bool>()).prop_map(|(exponent, negative)| {
        let size = exponent.exp();
        if negative { -size } else { size }
    })
}

fn finite_score<T: Target<N>, const N: usize, const D: usize>(
    target: &ConstrainedTarget<T, N, D>,
    y: &[f64; 6],
) -> Result<(), TestCaseError> {
    let y = std::array::from_fn(|k| y[k]);
    let score = target.score(&y);
    prop_assert!(score.iter().all(|s| s.is_finite()), "{score:?} at {y:?}");
    prop_assert!(target.log_density(&y).is_finite(), "{y:?}");
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn scores_are_finite_in_the_far_tails(y in prop::array::uniform6(far())) {
        finite_score(&Constraints::<2, 2>::builder().positive(2).build().unwrap().target(Gammas(2.5, 1.5)), &y)?;
        let unit = Constraints::<1, 1>::builder().bounded(1, -1.0, 3.0).build().unwrap();
        finite_score(&unit.target(ShiftedBeta(2.0, 3.0)), &y)?;
        let ordered = Constraints::<4, 4>::builder().ordered(4).build().unwrap();
        finite_score(&ordered.target(Logistic), &y)?;
        let simplex = Constraints::<5, 4>::builder().simplex(5).build().unwrap();
        finite_score(&simplex.target(Dirichlet([0.5, 2.0, 7.5, 1.0, 1.0])), &y)?;
        let factor = Constraints::<6, 3>::builder().correlation_cholesky(3).build().unwrap();
        finite_score(&factor.target(LkjFactor(2.0)), &y)?;
    }
}
