//! Student's t with three degrees of freedom, whose fourth moments are infinite: distributions instead of moments.

use parvi_targets::{CatalogueTarget, ExactDraws, SobolSequence, StudentT, Target, UnitCubeTransport};
use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;
use statrs::distribution::{ContinuousCDF, FisherSnedecor, StudentsT};

/// The largest difference between the empirical distribution function of `values` and F.
fn kolmogorov_distance(mut values: Vec<f64>, distribution: &impl ContinuousCDF<f64, f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let count = values.len() as f64;
    (values.iter().enumerate())
        .map(|(rank, value)| (distribution.cdf(*value) - (rank as f64 + 0.5) / count).abs())
        .fold(0.0, f64::max)
}

/// How far coordinates are from t_ν, and |x|²/D from the F distribution with D and ν degrees of freedom: the largest of these distances.
fn distance_to_the_law<const D: usize>(nu: f64, points: &[[f64; D]]) -> f64 {
    let marginal = StudentsT::new(0.0, 1.0, nu).unwrap();
    let along = |axis: usize| kolmogorov_distance(points.iter().map(|x| x[axis]).collect(), &marginal);
    let square = |x: &[f64; D]| x.iter().map(|x| x * x).sum::<f64>() / D as f64;
    let radial = FisherSnedecor::new(D as f64, nu).unwrap();
    let radius = kolmogorov_distance(points.iter().map(square).collect(), &radial);
    (0..D).map(along).fold(radius, f64::max)
}

fn draws_and_transport<const D: usize>(nu: f64) {
    let target = StudentT::<D>::new(nu).unwrap();
    let mut rng = ChaCha8Rng::seed_from_u64(8);
    let count = 1 << 14;
    let draws: Vec<[f64; D]> = (0..count).map(|_| target.draw(&mut rng)).collect();
    // Kolmogorov's statistic √n·distance exceeds 2.2 once in 8,000 times.
    let independent = distance_to_the_law(nu, &draws);
    assert!(
        independent < 2.2 / f64::from(count).sqrt(),
        "nu = {nu}, D = {D}: {independent}"
    );
    let quasi_random = |seed: u64| {
        let sequence = SobolSequence::scrambled(target.cube_dimension(), seed).unwrap();
        let points: Vec<[f64; D]> = (0..count)
            .map(|index| target.transport(&sequence.point(index as u32)))
            .collect();
        distance_to_the_law(nu, &points)
    };
    // Quasi-random points come closer, also in sets with a curved boundary: here by a factor of four.
    let mean = (0..4).map(quasi_random).sum::<f64>() / 4.0;
    assert!(mean < 0.55 / f64::from(count).sqrt(), "nu = {nu}, D = {D}: {mean}");
}

#[test]
fn three_degrees_of_freedom() {
    crate::in_dimensions!(draws_and_transport(3.0), 1, 2, 4, 8);
    let target = StudentT::<2>::new(3.0).unwrap();
    let moments = target.moments().unwrap();
    assert_eq!(moments.mean, [0.0; 2]);
    assert_eq!(moments.covariance.0, [[3.0, 0.0], [0.0, 3.0]]);
    assert_eq!(target.frame(), parvi_targets::Frame::identity());
    // p(x) = (1 + |x|²/3)^(−5/2) / 2π, score −5 x / (3 + |x|²).
    assert!((target.log_density(&[0.0; 2]) + std::f64::consts::TAU.ln()).abs() < 1e-14);
    let (density, score) = (target.log_density(&[1.0, -2.0]), target.score(&[1.0, -2.0]));
    assert!((density + 2.5 * (8.0_f64 / 3.0).ln() + std::f64::consts::TAU.ln()).abs() < 1e-14);
    assert_eq!(score, [-0.625, 1.25]);
}

#[test]
fn other_degrees_of_freedom() {
    draws_and_transport::<3>(1.0);
    draws_and_transport::<3>(5.0);
}
