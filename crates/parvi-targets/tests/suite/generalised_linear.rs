//! Probit and Poisson regression: batches against definitions, derivatives, published and independently computed modes.

use parvi_targets::{
    CatalogueTarget, CountData, Curvature, Link, Logarithm, Logit, PoissonRegression, Probit, ProbitRegression,
    Regression, RegressionTable, Target, synthetic_counts, wells,
};
use statrs::function::erf::erfc;
use statrs::function::gamma::ln_gamma;

use crate::support::{assert_hessian, log_prior};

/// Coefficients of moderate size, different for every particle and axis.
fn particles<const D: usize>(count: usize, size: f64) -> Vec<[f64; D]> {
    (0..count)
        .map(|p| std::array::from_fn(|k| size * (((p * D + k + 1) as f64 * 0.618_033_988_75).fract() * 2.0 - 1.0)))
        .collect()
}

fn batch<const D: usize>(target: &impl Target<D>, xs: &[[f64; D]]) -> (Vec<[f64; D]>, Vec<f64>) {
    let (mut scores, mut densities) = (vec![[f64::NAN; D]; xs.len()], vec![f64::NAN; xs.len()]);
    target.scores(xs, &mut scores);
    target.log_densities(xs, &mut densities);
    (scores, densities)
}

/// The same bits for a particle in every batch and for every number of threads; the same number as for a single point.
fn does_not_depend_on_the_batch<L: Link, const D: usize>(data: &RegressionTable<L::Response>) {
    let target = Regression::<L, D>::with_prior("own", data.clone(), 10.0).unwrap();
    let xs = particles::<D>(201, 3.0);
    let (scores, densities) = batch(&target, &xs);
    for size in [1, 63, 64, 65] {
        let parts: Vec<_> = xs.chunks(size).map(|part| batch(&target, part)).collect();
        assert!(parts.iter().flat_map(|(scores, _)| scores).eq(scores.iter()));
        assert!(parts.iter().flat_map(|(_, densities)| densities).eq(densities.iter()));
    }
    for threads in [1, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        assert_eq!(
            pool.install(|| batch(&target, &xs)),
            (scores.clone(), densities.clone())
        );
    }
    for ((x, score), density) in xs.iter().zip(&scores).zip(&densities) {
        assert!((target.log_density(x) / density - 1.0).abs() < 1e-13);
        let single = target.score(x);
        let size = single.iter().fold(1.0_f64, |size, s| size.max(s.abs()));
        assert!((0..D).all(|k| (single[k] - score[k]).abs() < 1e-12 * size));
    }
}

#[test]
fn a_particle_has_the_same_bits_in_every_batch() {
    // Two whole blocks of 128 rows and a part of one.
    let rows = wells(4, Some(300)).unwrap();
    does_not_depend_on_the_batch::<Probit, 4>(&rows);
    does_not_depend_on_the_batch::<Logit, 4>(&rows);
    does_not_depend_on_the_batch::<Probit, 1>(&wells(1, Some(3)).unwrap());
    does_not_depend_on_the_batch::<Logarithm, 1>(&synthetic_counts(1).unwrap());
    does_not_depend_on_the_batch::<Logarithm, 8>(&synthetic_counts(8).unwrap());
}

/// A link without the forms for blocks gives the same through the defaults.
#[test]
fn own_links_need_three_functions() {
    #[derive(Clone, Copy, Debug)]
    struct PlainProbit;
    impl Link for PlainProbit {
        type Response = bool;
        fn log_likelihood(t: f64) -> f64 {
            Probit::log_likelihood(t)
        }
        fn slope(t: f64) -> f64 {
            Probit::slope(t)
        }
        fn curvature(t: f64) -> f64 {
            Probit::curvature(t)
        }
    }
    let data = wells(3, Some(100)).unwrap();
    let plain = Regression::<PlainProbit, 3>::with_prior("own", data.clone(), 10.0).unwrap();
    let fast = ProbitRegression::<3>::with_prior("own", data, 10.0).unwrap();
    let xs = particles::<3>(70, 20.0);
    let ((scores, densities), (fast_scores, fast_densities)) = (batch(&plain, &xs), batch(&fast, &xs));
    for p in 0..xs.len() {
        assert!((densities[p] / fast_densities[p] - 1.0).abs() < 1e-13);
        assert!((0..3).all(|k| (scores[p][k] - fast_scores[p][k]).abs() < 1e-11 * (1.0 + scores[p][k].abs())));
    }
    does_not_depend_on_the_batch::<PlainProbit, 3>(&wells(3, Some(100)).unwrap());
}

#[test]
fn probit_agrees_with_the_definition() {
    let data = wells(5, Some(300)).unwrap();
    let target = ProbitRegression::<5>::with_prior("probit", data.clone(), 2.0).unwrap();
    for beta in particles::<5>(50, 0.5) {
        let mut density = log_prior(&beta, 2.0);
        for (row, &response) in data.responses().iter().enumerate() {
            let t: f64 = data.covariates(row).unwrap().iter().zip(beta).map(|(x, b)| x * b).sum();
            let t = if response { t } else { -t };
            density += (0.5 * erfc(-t / std::f64::consts::SQRT_2)).ln();
        }
        // The complementary error function of statrs is good to 1e-10.
        assert!((target.log_density(&beta) / density - 1.0).abs() < 1e-9);
    }
}

#[test]
fn poisson_agrees_with_the_definition() {
    let data = synthetic_counts(6).unwrap();
    let target = PoissonRegression::<6>::with_prior("poisson", data.clone(), 2.0).unwrap();
    for beta in particles::<6>(50, 1.0) {
        let mut density = log_prior(&beta, 2.0);
        let mut score = beta.map(|b| -b / 4.0);
        for (row, &response) in data.responses().iter().enumerate() {
            let x = data.covariates(row).unwrap();
            let t: f64 = x.iter().zip(beta).map(|(x, b)| x * b).sum();
            let y = f64::from(response);
            density += y * t - t.exp() - ln_gamma(y + 1.0);
            (0..6).for_each(|k| score[k] += (y - t.exp()) * x[k]);
        }
        assert!((target.log_density(&beta) / density - 1.0).abs() < 1e-12);
        let size = score.iter().fold(1.0_f64, |size, s| size.max(s.abs()));
        assert!((0..6).all(|k| (target.score(&beta)[k] - score[k]).abs() < 1e-12 * size));
    }
}

fn hessian_is_the_derivative_of_the_score<L: Link, const D: usize>(data: RegressionTable<L::Response>) {
    let target = Regression::<L, D>::with_prior("own", data, 10.0).unwrap();
    for x in particles::<D>(20, 2.0) {
        let hessian = target.negative_hessian(&x);
        let size = hessian.0.iter().flatten().fold(1.0_f64, |size, h| size.max(h.abs()));
        assert_hessian(&target, &x, 1e-7 * size);
    }
}

#[test]
fn hessians_are_derivatives_of_scores() {
    hessian_is_the_derivative_of_the_score::<Probit, 3>(wells(3, Some(50)).unwrap());
    hessian_is_the_derivative_of_the_score::<Logarithm, 3>(synthetic_counts(3).unwrap());
}

/// Mode, standard deviations and log density, but for the prior's constant, of the probit posterior of 40 wells (prior sd 10), computed independently with
/// 40 digits.
#[test]
fn the_laplace_approximation_of_the_probit_posterior() {
    let target = ProbitRegression::<5>::with_prior("probit", wells(5, Some(40)).unwrap(), 10.0).unwrap();
    let mode = [
        1.166_488_121_228_440_6,
        -1.308_859_993_911_545_3,
        -0.019_386_017_658_502_14,
        0.467_775_771_821_275_55,
        1.416_378_518_133_872_2,
    ];
    let deviations = [
        1.079_773_285_893_483,
        0.874_665_693_858_634_8,
        0.340_248_557_065_07,
        0.258_413_468_067_298_54,
        0.716_373_964_095_676_4,
    ];
    for k in 0..5 {
        assert!((target.laplace().mode()[k] - mode[k]).abs() < 1e-12);
        assert!((target.laplace().covariance().0[k][k].sqrt() / deviations[k] - 1.0).abs() < 1e-11);
    }
    let log_density = -10.909_500_438_029_557 + log_prior(&[0.0; 5], 10.0);
    assert!((target.log_density(&mode) - log_density).abs() < 1e-12);
}

/// Breaks of yarn during weaving, by wool (A, B) and tension (low, medium, high); source: L. H. C. Tippett, *Technological
/// Applications of Statistics*, 1950, p. 106. The maximum of the likelihood is the one that textbooks print:
/// 3.69196 − 0.20599 · B − 0.32132 · medium − 0.51849 · high, standard errors 0.04541, 0.05157, 0.06027, 0.06396.
#[test]
fn the_poisson_regression_of_the_breaks_of_yarn() {
    let breaks: [(f64, usize, [u32; 9]); 6] = [
        (0.0, 0, [26, 30, 54, 25, 70, 52, 51, 26, 67]),
        (0.0, 1, [18, 21, 29, 17, 12, 18, 35, 30, 36]),
        (0.0, 2, [36, 21, 24, 18, 10, 43, 28, 15, 26]),
        (1.0, 0, [27, 14, 29, 19, 29, 31, 41, 20, 44]),
        (1.0, 1, [42, 26, 19, 16, 39, 28, 21, 39, 29]),
        (1.0, 2, [20, 21, 24, 17, 13, 15, 15, 16, 28]),
    ];
    let indicator = |on: bool| f64::from(u8::from(on));
    let rows: Vec<(u32, Vec<f64>)> = breaks
        .iter()
        .flat_map(|(wool, tension, counts)| {
            counts.map(|count| (count, vec![*wool, indicator(*tension == 1), indicator(*tension == 2)]))
        })
        .collect();
    let data = CountData::new("breaks of yarn", &["wool B", "medium", "high"], &rows).unwrap();
    let target = PoissonRegression::<4>::with_prior("poisson", data, f64::INFINITY).unwrap();
    let published = [
        (3.691_963, 0.045_411),
        (-0.205_988, 0.051_571),
        (-0.321_320, 0.060_266),
        (-0.518_488, 0.063_960),
    ];
    for (k, (mode, deviation)) in published.into_iter().enumerate() {
        assert!((target.laplace().mode()[k] - mode).abs() < 1e-6);
        assert!((target.laplace().covariance().0[k][k].sqrt() - deviation).abs() < 1e-6);
    }
}

/// Far beyond the data scores stay finite, and Newton's method comes back from there.
#[test]
fn far_away_counts_are_finite() {
    let target = PoissonRegression::<3>::with_prior("poisson", synthetic_counts(3).unwrap(), 10.0).unwrap();
    for size in [1e2, 1e3, 5e3, 1e10, 1e30] {
        for x in [[size; 3], [-size; 3], [size, -size, size], [0.0, size, 0.0]] {
            let (scores, densities) = batch(&target, &[x]);
            assert!(
                scores[0]
                    .iter()
                    .chain(&densities)
                    .chain(&target.score(&x))
                    .all(|value| value.is_finite())
            );
            assert!(target.log_density(&x) < -50.0);
        }
    }
    // The tangent beyond 100 continues value and slope.
    for step in [-1e-9, 1e-9] {
        let t = 100.0 + step;
        assert!((Logarithm::log_likelihood(t) / Logarithm::log_likelihood(100.0) - 1.0 - step).abs() < 1e-14);
        assert!((Logarithm::slope(t) / Logarithm::slope(100.0) - 1.0).abs() < 2e-9);
    }
}

/// The embedded counts do not change under a new version of a library.
#[test]
fn the_synthetic_counts_are_pinned() {
    let data = synthetic_counts(8).unwrap();
    assert_eq!((data.rows(), data.dimension()), (40, 8));
    let counts = [
        0, 0, 2, 2, 3, 1, 1, 1, 0, 0, 1, 0, 0, 0, 2, 1, 5, 1, 4, 2, 0, 1, 5, 1, 1, 2, 7, 2, 0, 1, 0, 2, 1, 1, 8, 0, 0,
        3, 2, 1,
    ];
    assert_eq!(data.responses(), counts);
    let sum: f64 = (0..40).flat_map(|row| data.covariates(row).unwrap()).sum();
    assert!((sum - 55.183_005_524_501_105).abs() < 1e-12, "{sum:?}");
    assert_eq!(synthetic_counts(3).unwrap().responses(), data.responses());
    assert_eq!(
        synthetic_counts(3).unwrap().covariates(7),
        data.covariates(7).map(|row| &row[..3])
    );
    assert!(synthetic_counts(0).is_err() && synthetic_counts(9).is_err());
    let target = PoissonRegression::<8>::with_prior("poisson", data, 10.0).unwrap();
    assert!(target.exact_draws().is_none() && target.moments().is_none());
}
