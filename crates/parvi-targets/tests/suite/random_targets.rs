//! Random targets: maps against their Jacobians, scores against differences, draws against densities, in all families.

use mpm_tensor::Matrix;
use parvi_targets::{
    Affine, BoxedBijection, CatalogueTarget, ExactDraws, Frame, MAXIMUM_DIMENSION, Neck, Profile, RandomFamily,
    RandomTarget, SOBOL_MAXIMUM_DIMENSION, Shear, Skew, StudentT, Target, TargetError, Twist, UnitCubeTransport,
};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

/// All families that exist in D dimensions.
fn families<const D: usize>() -> impl Iterator<Item = RandomFamily> {
    RandomFamily::ALL
        .into_iter()
        .filter(|family| family.minimum_dimension() <= D)
}

fn draws<const D: usize>(target: &RandomTarget<D>, count: usize, seed: u64) -> Vec<[f64; D]> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    (0..count).map(|_| target.draw(&mut rng)).collect()
}

/// Mean and covariance of draws as a frame.
fn whitening<const D: usize>(points: &[[f64; D]]) -> Frame<D> {
    Frame::of_points(points, None).unwrap()
}

fn maps() -> Vec<BoxedBijection<4>> {
    let matrix = Matrix::from_fn(|i, j| {
        if i == j {
            2.0 - i as f64 * 0.7
        } else {
            0.3 * i as f64 - 0.2 * j as f64
        }
    });
    let bend = Profile::Bend {
        curvature: -0.8,
        knee: 1.5,
    };
    let wave = Profile::Wave {
        amplitude: 0.7,
        frequency: 2.0,
        phase: 0.3,
    };
    vec![
        Box::new(Affine::new([1.0, -2.0, 0.0, 0.5], matrix).unwrap()),
        Box::new(Affine::scales([0.0; 4], [0.01, 3.0, 100.0, 1.0]).unwrap()),
        Box::new(Shear::new::<4>(2, 0, bend).unwrap()),
        Box::new(Shear::new::<4>(0, 3, wave).unwrap()),
        Box::new(Twist::by_radius::<4>([1, 3], -1.3).unwrap()),
        Box::new(Twist::by_axis::<4>([3, 0], 2, 0.9).unwrap()),
        Box::new(Neck::new::<4>(1, 2, 1.7, 0.8).unwrap()),
        Box::new(Skew::new::<4>(2, 0.6, 0.85).unwrap()),
    ]
}

/// T⁻¹ ∘ T = id; determinant, its gradient and J⁻ᵀ g against central differences of T.
#[test]
fn maps_know_their_inverse_and_jacobian() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    for map in maps() {
        for _ in 0..50 {
            let mut point = || std::array::from_fn::<f64, 4, _>(|_| 4.0 * rng.random::<f64>() - 2.0);
            let (y, gradient) = (point(), point());
            let back = map.inverse(&map.forward(&y));
            for axis in 0..4 {
                assert!((back[axis] - y[axis]).abs() < 1e-12, "{map:?} at {y:?}: {back:?}");
            }
            let moved = |axis: usize, by: f64| {
                let mut moved = y;
                moved[axis] += by;
                moved
            };
            let step = 1e-4;
            let columns: [[f64; 4]; 4] = std::array::from_fn(|j| {
                let at = |multiple: f64| map.forward(&moved(j, multiple * step));
                let (one, other, two, another) = (at(1.0), at(-1.0), at(2.0), at(-2.0));
                std::array::from_fn(|i| (8.0 * (one[i] - other[i]) - (two[i] - another[i])) / (12.0 * step))
            });
            let jacobian = Matrix::<4>::from_fn(|i, j| columns[j][i]);
            let volume = jacobian.determinant().abs().ln();
            assert!((volume - map.log_determinant(&y)).abs() < 1e-8, "{map:?}: {volume}");
            let back = jacobian.apply_transposed(&map.push_gradient(&y, &gradient));
            for axis in 0..4 {
                assert!((back[axis] - gradient[axis]).abs() < 1e-7, "{map:?}: {back:?}");
                let at = |multiple: f64| map.log_determinant(&moved(axis, multiple * step));
                let slope = (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * step);
                let own = map.log_determinant_gradient(&y)[axis];
                assert!((slope - own).abs() < 1e-8, "{map:?}: {slope} for {own}");
            }
        }
    }
}

#[test]
fn maps_refuse_what_they_cannot_be() {
    let wave = |amplitude| Profile::Wave {
        amplitude,
        frequency: 1.0,
        phase: 0.0,
    };
    assert!(Shear::new::<2>(0, 2, wave(1.0)).is_err() && Shear::new::<2>(1, 1, wave(1.0)).is_err());
    assert!(Shear::new::<2>(0, 1, wave(f64::NAN)).is_err());
    assert!(Twist::by_axis::<3>([0, 1], 1, 1.0).is_err() && Twist::by_radius::<3>([0, 1], f64::INFINITY).is_err());
    assert!(Neck::new::<2>(0, 1, 1.0, 0.0).is_err() && Skew::new::<1>(0, 0.0, -1.0).is_err());
    assert!(Affine::scales([0.0; 2], [1.0, 0.0]).is_err());
}

/// Differences along random directions of whitened coordinates, with steps h and h/2: where both agree (not across a cusp), the
/// score does too.
fn score_is_the_gradient<const D: usize>(seeds: std::ops::Range<u64>) {
    let (mut smooth, mut all) = (0, 0);
    for family in families::<D>() {
        for seed in seeds.clone() {
            let target = RandomTarget::<D>::of_family(family, seed).unwrap();
            let points = draws(&target, 1000, 5);
            let frame = whitening(&points);
            let mut rng = ChaCha8Rng::seed_from_u64(seed);
            for (index, x) in points.iter().take(30).enumerate() {
                // Draws, and points outside.
                let z = frame.to_reference(x).map(|z| z * [1.0, 1.5, 4.0][index % 3]);
                let direction: [f64; D] = std::array::from_fn(|_| 2.0 * rng.random::<f64>() - 1.0);
                let along = |step: f64| {
                    let moved: [f64; D] = std::array::from_fn(|axis| z[axis] + step * direction[axis]);
                    target.log_density(&frame.to_target(&moved))
                };
                let slope = |h: f64| (8.0 * (along(h) - along(-h)) - (along(2.0 * h) - along(-2.0 * h))) / (12.0 * h);
                let score = frame.pull_back_score(&target.score(&frame.to_target(&z)));
                let own: f64 = (0..D).map(|axis| score[axis] * direction[axis]).sum();
                let size = score.iter().fold(1.0_f64, |size, s| size.max(s.abs()));
                let (fine, coarse) = (slope(2e-5), slope(4e-5));
                all += 1;
                if (fine - coarse).abs() < 1e-5 * size {
                    smooth += 1;
                    let tolerance = 1e-6 * size + 2.0 * (fine - coarse).abs() + 1e-10 * along(0.0).abs();
                    assert!(
                        (own - fine).abs() < tolerance,
                        "{family:?} {seed} in {D}: {own} for {fine}, {coarse}"
                    );
                }
            }
        }
    }
    assert!(f64::from(smooth) > 0.95 * f64::from(all), "{smooth} of {all} in {D}");
}

#[test]
fn scores_are_gradients() {
    score_is_the_gradient::<1>(0..6);
    score_is_the_gradient::<2>(0..12);
    crate::in_dimensions!(score_is_the_gradient(0..6), 3, 4);
    crate::in_dimensions!(score_is_the_gradient(0..4), 5, 6, 7, 8);
}

/// Where the cube has D dimensions, log p(T(u)) − log ∫ p = −log |det ∂T/∂u| by differences.
fn density_is_that_of_the_transport<const D: usize>() -> usize {
    let mut tried = 0;
    for family in families::<D>() {
        for seed in 0..4 {
            let target = RandomTarget::<D>::of_family(family, seed).unwrap();
            if target.cube_dimension() != D {
                continue;
            }
            tried += 1;
            let mut rng = ChaCha8Rng::seed_from_u64(seed);
            for _ in 0..10 {
                let u: [f64; D] = std::array::from_fn(|_| 0.1 + 0.8 * rng.random::<f64>());
                let step = 1e-5;
                let columns: [[f64; D]; D] = std::array::from_fn(|axis| {
                    let at = |multiple: f64| {
                        let mut moved = u;
                        moved[axis] += multiple * step;
                        target.transport(&moved)
                    };
                    let (one, other, two, another) = (at(1.0), at(-1.0), at(2.0), at(-2.0));
                    std::array::from_fn(|i| (8.0 * (one[i] - other[i]) - (two[i] - another[i])) / (12.0 * step))
                });
                let volume = Matrix::<D>(columns).determinant().abs().ln();
                let own = target.log_density(&target.transport(&u)) - target.log_evidence().unwrap();
                assert!(
                    (own + volume).abs() < 1e-4,
                    "{family:?} {seed} in {D}: {own} for {}",
                    -volume
                );
            }
        }
    }
    tried
}

#[test]
fn densities_are_those_of_the_transports() {
    let tried = density_is_that_of_the_transport::<1>()
        + density_is_that_of_the_transport::<2>()
        + density_is_that_of_the_transport::<4>()
        + density_is_that_of_the_transport::<6>()
        + density_is_that_of_the_transport::<8>();
    assert!(tried > 40, "{tried}");
}

/// ∫ p over its stated value, by importance sampling from kernels on draws, each as wide as the distance to a neighbour, with its
/// error; and the largest z-score by which shares of half spaces differ between weighted points and draws.
fn evidence_by_kernels<const D: usize>(target: &RandomTarget<D>) -> (f64, f64, f64) {
    let (kernels, neighbour, samples) = (400, 12, 4000);
    let centres = draws(target, kernels, 21);
    let frame = whitening(&centres);
    let centres: Vec<[f64; D]> = centres.iter().map(|x| frame.to_reference(x)).collect();
    let square = |a: &[f64; D], b: &[f64; D]| (0..D).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>();
    let width = |centre: &[f64; D]| {
        let mut squares: Vec<f64> = centres.iter().map(|other| square(centre, other)).collect();
        squares.select_nth_unstable_by(neighbour, f64::total_cmp).1.sqrt()
    };
    let widths: Vec<f64> = centres.iter().map(width).collect();
    let kernel = StudentT::<D>::new(3.0).unwrap();
    // Of a kernel of width w: 1/(3w²), and the density at its centre over the number of kernels.
    let peak = |width: &f64| (kernel.log_density(&[0.0; D]) - D as f64 * width.ln()).exp() / kernels as f64;
    let shapes: Vec<(f64, f64)> = widths.iter().map(|w| ((3.0 * w * w).recip(), peak(w))).collect();
    let mut rng = ChaCha8Rng::seed_from_u64(22);
    let (weights, zs): (Vec<f64>, Vec<[f64; D]>) = (0..samples)
        .map(|index| {
            let k = index % kernels;
            let offset = kernel.draw(&mut rng);
            let z: [f64; D] = std::array::from_fn(|axis| centres[k][axis] + widths[k] * offset[axis]);
            let of_kernel = |(centre, (inverse, peak)): (&[f64; D], &(f64, f64))| {
                let base = 1.0 + square(&z, centre) * inverse;
                peak / base.powi(3 + D as i32).sqrt()
            };
            let proposal: f64 = centres.iter().zip(&shapes).map(of_kernel).sum();
            let log_density = target.log_density(&frame.to_target(&z)) + frame.log_determinant();
            let weight = (log_density - target.log_evidence().unwrap()).exp() / proposal;
            (weight, z)
        })
        .unzip();
    let mean = weights.iter().sum::<f64>() / samples as f64;
    let variance = weights.iter().map(|w| (w - mean).powi(2)).sum::<f64>() / samples as f64;
    let fresh = draws(target, samples, 23);
    let difference = |axis: usize| {
        let beyond = |z: &[f64; D]| f64::from(u8::from(z[axis] > 0.2));
        let drawn = fresh.iter().map(|x| beyond(&frame.to_reference(x))).sum::<f64>() / samples as f64;
        let weighted = zs.iter().zip(&weights).map(|(z, w)| w * (beyond(z) - drawn));
        let offset = weighted.clone().sum::<f64>() / samples as f64;
        let squares = weighted.map(|term| (term - offset).powi(2)).sum::<f64>() / samples as f64;
        offset / ((squares + drawn * (1.0 - drawn)) / samples as f64).sqrt()
    };
    let worst = (0..D).map(|axis| difference(axis).abs()).fold(0.0, f64::max);
    (mean, (variance / samples as f64).sqrt(), worst)
}

/// Kernels on 400 draws miss parts of the thinnest spirals; nine of ten targets they weigh to a tenth and better.
fn evidence_is_stated<const D: usize>(seeds: std::ops::Range<u64>) {
    let (mut sharp, mut all) = (0, 0);
    for family in families::<D>() {
        for seed in seeds.clone() {
            let target = RandomTarget::<D>::of_family(family, seed).unwrap();
            let (ratio, error, difference) = evidence_by_kernels(&target);
            assert!(
                difference < 5.0,
                "{family:?} {seed} in {D}: draws and density differ by {difference}"
            );
            assert!(
                (ratio - 1.0).abs() < 5.0 * error,
                "{family:?} {seed} in {D}: {ratio} ± {error}"
            );
            all += 1;
            sharp += usize::from(error < 0.1);
        }
    }
    assert!(10 * sharp >= 9 * all, "{sharp} of {all} in {D}");
}

#[test]
fn evidence_is_known() {
    crate::in_dimensions!(evidence_is_stated(0..6), 1, 2);
    evidence_is_stated::<3>(0..3);
}

/// Stein's identity E(w s + ∇w) = 0 over draws, w = exp(−|z − c|²/2b²) about other draws, in whitened coordinates.
fn draws_fit_the_score<const D: usize>(seeds: std::ops::Range<u64>) {
    let count = 4000;
    for family in families::<D>() {
        for seed in seeds.clone() {
            let target = RandomTarget::<D>::of_family(family, seed).unwrap();
            let points = draws(&target, count, 31);
            let frame = whitening(&points);
            let zs: Vec<[f64; D]> = points.iter().map(|x| frame.to_reference(x)).collect();
            let scores: Vec<[f64; D]> = points.iter().map(|x| frame.pull_back_score(&target.score(x))).collect();
            for (centre, width) in [(zs[0], 1.0), (zs[1], 2.0), ([0.0; D], 3.0)] {
                for axis in 0..D {
                    let terms: Vec<f64> = zs
                        .iter()
                        .zip(&scores)
                        .map(|(z, score)| {
                            let square: f64 = (0..D).map(|k| ((z[k] - centre[k]) / width).powi(2)).sum();
                            (-0.5 * square).exp() * (score[axis] - (z[axis] - centre[axis]) / (width * width))
                        })
                        .collect();
                    let mean = terms.iter().sum::<f64>() / count as f64;
                    let variance = terms.iter().map(|t| (t - mean).powi(2)).sum::<f64>() / count as f64;
                    let z_score = mean / (variance / count as f64).sqrt().max(1e-12);
                    assert!(z_score.abs() < 5.0, "{family:?} {seed} in {D}, axis {axis}: {z_score}");
                }
            }
        }
    }
}

#[test]
fn draws_fit_scores() {
    crate::in_dimensions!(draws_fit_the_score(0..4), 1, 2);
    draws_fit_the_score::<4>(0..3);
    crate::in_dimensions!(draws_fit_the_score(0..2), 6, 8);
}

/// The same seed gives the same bits; the family that a seed chooses is the one that can be asked for; the cube is one that Sobol'
/// points fill; nothing is NaN far away; the frame is as far off as it says.
fn targets_keep_their_word<const D: usize>() {
    let mut seen = Vec::new();
    for seed in 0..120 {
        let target = RandomTarget::<D>::new(seed).unwrap();
        seen.push(target.family());
        if seed % 4 > 0 {
            continue;
        }
        let again = RandomTarget::<D>::of_family(target.family(), seed).unwrap();
        assert_eq!(target.seed(), seed);
        let xs = draws(&target, 301, 3);
        assert_eq!(xs, draws(&again, 301, 3));
        assert_eq!(target.frame(), again.frame());
        assert_eq!(target.log_density(&xs[0]), again.log_density(&xs[0]));
        assert_eq!(target.score(&xs[0]), again.score(&xs[0]));
        assert!(target.cube_dimension() <= SOBOL_MAXIMUM_DIMENSION);
        let log_evidence = target.log_evidence().unwrap();
        assert!(log_evidence.abs() <= 20.0 && Some(log_evidence) == again.log_evidence());
        for size in [1e3, 1e10, 1e30, 1e200] {
            let x: [f64; D] = std::array::from_fn(|axis| if seed >> axis & 1 == 0 { size } else { -size });
            let value = target.log_density(&x);
            let what = target.family();
            assert!(value < f64::INFINITY, "{what:?} {seed} in {D}: {value}");
            assert!(size > 1e30 || value.is_finite(), "{what:?} {seed} in {D}: {value}");
            assert!(target.score(&x).iter().all(|s| s.is_finite()));
        }
        let frame = target.frame();
        for axis in 0..D {
            let mut distances: Vec<f64> = xs.iter().map(|x| frame.to_reference(x)[axis].abs()).collect();
            distances.sort_by(f64::total_cmp);
            assert!(
                (0.1..3.0).contains(&distances[150]),
                "{:?} {seed} in {D}",
                target.family()
            );
        }
    }
    for family in families::<D>() {
        assert!(seen.contains(&family), "{family:?} in {D}");
    }
    let other = [RandomTarget::<D>::new(0).unwrap(), RandomTarget::<D>::new(1).unwrap()];
    assert_ne!(draws(&other[0], 1, 0), draws(&other[1], 1, 0));
}

#[test]
fn every_dimension_has_its_targets() {
    crate::in_dimensions!(targets_keep_their_word(), 1, 2, 3, 4, 5, 6, 7, 8);
}

#[test]
fn dimensions_beyond_are_refused() {
    let refused = |error: TargetError| matches!(error, TargetError::DimensionNotAllowed { .. });
    assert!(refused(RandomTarget::<9>::new(0).unwrap_err()));
    assert!(refused(RandomTarget::<0>::new(0).unwrap_err()));
    assert!(refused(
        RandomTarget::<1>::of_family(RandomFamily::Moons, 0).unwrap_err()
    ));
    assert!(refused(
        RandomTarget::<2>::of_family(RandomFamily::Product, 0).unwrap_err()
    ));
    assert_eq!(MAXIMUM_DIMENSION, 8);
}
