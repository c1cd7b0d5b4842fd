//! The public problems of nested sampling, and the evidence that every target of the catalogue states.

use std::f64::consts::PI;

use parvi_targets::{
    CatalogueTarget, Eggbox, ExactDraws, GaussianShells, LogGamma, Parameters, Target, TargetError, build, catalogue,
};
use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;

use crate::support::with;

/// log ∫ p over a rectangle of the plane by the midpoint rule.
fn log_integral(target: &dyn Target<2>, sides: [[f64; 2]; 2], count: i32) -> f64 {
    let step = sides.map(|[low, high]| (high - low) / f64::from(count));
    let at = |axis: usize, k: i32| sides[axis][0] + (f64::from(k) + 0.5) * step[axis];
    let points: Vec<[f64; 2]> = (0..count)
        .flat_map(|i| (0..count).map(move |j| [i, j]))
        .map(|[i, j]| [at(0, i), at(1, j)])
        .collect();
    let mut values = vec![0.0; points.len()];
    target.log_densities(&points, &mut values);
    let largest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let sum: f64 = values.iter().map(|value| (value - largest).exp()).sum();
    largest + (sum * step[0] * step[1]).ln()
}

#[test]
fn eggbox_has_the_published_evidence() {
    let eggbox = Eggbox::new().unwrap();
    let stated = eggbox.log_evidence().unwrap();
    // Feroz, Hobson & Bridges 2009 give 235.88 from a grid.
    assert!((stated - 235.88).abs() < 0.03);
    // Beyond 20 there is no more than e⁻²⁰ of the prior times the height of a mode at each of the four sides.
    let found = log_integral(&eggbox, [[-20.0, 20.0]; 2], 3200);
    assert!((found - stated).abs() < 1e-6, "{found}");
}

/// Draws and points stretched away from them, differences of fourth order.
#[test]
fn eggbox_score_is_the_gradient() {
    let eggbox = Eggbox::new().unwrap();
    let (mut rng, step) = (ChaCha8Rng::seed_from_u64(1), 1e-4);
    for index in 0..200 {
        let y = eggbox.draw(&mut rng).map(|y| y * [1.0, 1.1, 1.7][index % 3]);
        let score = eggbox.score(&y);
        for axis in 0..2 {
            let at = |multiple: f64| {
                let mut moved = y;
                moved[axis] += multiple * step;
                eggbox.log_density(&moved)
            };
            let slope = (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * step);
            assert!(
                (slope - score[axis]).abs() < 1e-7 * (100.0 + slope.abs()),
                "{y:?}: {slope}, {score:?}"
            );
        }
    }
}

/// Shares of whole, half and quarter modes.
#[test]
fn eggbox_draws_fill_all_modes() {
    let eggbox = Eggbox::new().unwrap();
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    let count = 50_000;
    let mut shares = [[0.0; 6]; 6];
    let mut squares = 0.0;
    for _ in 0..count {
        let x = eggbox.in_box(&eggbox.draw(&mut rng));
        let place = x.map(|x| (x / (2.0 * PI)).round());
        squares += (x[0] - 2.0 * PI * place[0]).powi(2) / f64::from(count);
        shares[place[0] as usize][place[1] as usize] += 1.0 / f64::from(count);
    }
    // log p falls by 405/8 per square of the distance in x, and a little more slowly further out.
    assert!((squares / (4.0 / 405.0) - 1.0).abs() < 0.03, "{squares}");
    for i in 0..6 {
        for j in 0..6 {
            let part = |k: usize| if k == 0 || k == 5 { 0.5 } else { 1.0 };
            let expected = if (i + j) % 2 == 0 {
                part(i) * part(j) / 12.5
            } else {
                0.0
            };
            let error = (expected * (1.0 - expected) / f64::from(count)).sqrt();
            assert!(
                (shares[i][j] - expected).abs() <= 4.5 * error,
                "{i} {j}: {}",
                shares[i][j]
            );
        }
    }
}

#[test]
fn shells_have_the_published_evidence() {
    fn stated<const D: usize>() -> f64 {
        GaussianShells::<D>::new().unwrap().log_evidence().unwrap()
    }
    // Feroz, Hobson & Bridges 2009, table 1.
    assert!((stated::<2>() + 1.75).abs() < 5e-3);
    assert!((stated::<5>() + 5.67).abs() < 5e-3);
    assert!((stated::<10>() + 14.59).abs() < 5e-3);
    let found = log_integral(&GaussianShells::<2>::new().unwrap(), [[-6.5, 6.5]; 2], 1000);
    assert!((found - stated::<2>()).abs() < 1e-9, "{found}");
}

/// In ten dimensions: mean square radius, and log p against the law of the radius.
#[test]
fn shells_exist_in_ten_dimensions() {
    let shells = GaussianShells::<10>::new().unwrap();
    let (count, mut rng) = (20_000, ChaCha8Rng::seed_from_u64(4));
    let (mut squares, mut first) = (0.0, 0.0);
    for _ in 0..count {
        let x = shells.draw(&mut rng);
        let square = |offset: f64| (x[0] - offset).powi(2) + x[1..].iter().map(|x| x * x).sum::<f64>();
        squares += square(3.5).min(square(-3.5)) / f64::from(count);
        first += f64::from(u8::from(x[0] > 0.0)) / f64::from(count);
        assert!(shells.log_density(&x).is_finite() && shells.score(&x).iter().all(|s| s.is_finite()));
    }
    let expected = 10.0 * (shells.moments().unwrap().covariance.0[1][1]);
    assert!((squares - expected).abs() < 0.015, "{squares} for {expected}");
    assert!((first - 0.5).abs() < 0.015);
}

#[test]
fn spike_slab_has_its_evidence_and_masses() {
    let target = build::<2>("spike-slab", &Parameters::default()).unwrap();
    let found = log_integral(&*target, [[-0.9, 0.9]; 2], 1800);
    assert!((found - 101_f64.ln()).abs() < 1e-9, "{found}");
    // The spike alone, within eight of its widths: 100 and what the slab has there.
    let spike = log_integral(&*target, [[0.031 - 0.08, 0.031 + 0.08]; 2], 800).exp();
    assert!((100.0..101.0).contains(&spike), "{spike}");
}

#[test]
fn log_gamma_has_the_published_evidence() {
    let target = LogGamma::<2>::new().unwrap();
    let stated = target.log_evidence().unwrap();
    assert!((stated + 2.27e-5).abs() < 1e-6, "{stated}");
    let found = log_integral(&target, [[-30.0, 10.0], [-6.0, 6.0]], 1000);
    assert!((found - stated).abs() < 1e-7, "{found} for {stated}");
    assert!(LogGamma::<10>::new().unwrap().log_evidence().unwrap().abs() < 1e-4);
}

/// Means of the coordinates of the cube: of log-gamma m − γβ, γ = 0.5772.
#[test]
fn log_gamma_draws_have_their_means() {
    let target = LogGamma::<6>::new().unwrap();
    let (count, mut rng) = (40_000, ChaCha8Rng::seed_from_u64(6));
    let mut mean = [0.0; 6];
    for _ in 0..count {
        let x = target.in_cube(&target.draw(&mut rng));
        for axis in 0..6 {
            mean[axis] += x[axis] / f64::from(count);
        }
    }
    let skewed = 0.577_216 / 30.0;
    let third = 1.0 / 3.0;
    let expected = [
        0.5 - skewed,
        0.5,
        2.0 * third - skewed,
        2.0 * third - skewed,
        2.0 * third,
        2.0 * third,
    ];
    for axis in 0..6 {
        let tolerance = if axis < 2 { 4e-3 } else { 1e-3 };
        assert!(
            (mean[axis] - expected[axis]).abs() < tolerance,
            "{axis}: {}",
            mean[axis]
        );
    }
}

#[test]
fn problems_refuse_a_line() {
    let refused = |error: TargetError| matches!(error, TargetError::DimensionNotAllowed { dimension: 1, .. });
    assert!(refused(GaussianShells::<1>::new().unwrap_err()));
    assert!(refused(LogGamma::<1>::new().unwrap_err()));
}

/// What the catalogue says of evidence is so; in the plane the integral agrees.
#[test]
fn catalogue_states_evidence() {
    for info in catalogue() {
        let Ok(target) = build::<2>(info.name, &Parameters::default()) else {
            continue;
        };
        assert_eq!(target.log_evidence().is_some(), info.log_evidence, "{}", info.name);
        // Random ones have a test of their own, and so have posteriors with ends or exponential tails and what is much narrower than its domain.
        let elsewhere = ["random", "eggbox", "spike-slab"].contains(&info.name) || info.name.starts_with("sbibm-");
        let Some(stated) = target.log_evidence().filter(|_| !elsewhere) else {
            continue;
        };
        let sides = target
            .domain()
            .map(|[low, high]| [low - 0.5 * (high - low), high + 0.5 * (high - low)]);
        // The midpoint rule has all digits of what is smooth where two points lie within a standard deviation.
        let count = match info.name {
            "funnel" => 2000,
            _ => 800,
        };
        let found = log_integral(&*target, sides, count);
        let tolerance = match info.name {
            // Heavy tails beyond the box.
            "student-t" | "funnel" => 5e-3,
            _ => 1e-4,
        };
        assert!(
            (found - stated).abs() < tolerance,
            "{}: {found} for {stated}",
            info.name
        );
    }
    let schools = build::<4>("schools", &Parameters::default()).unwrap();
    assert_eq!(schools.log_evidence(), Some(0.0));
    let parameters = with(|p| p.target_seed = Some(7));
    let [one, other] = [0, 7].map(|seed| {
        let parameters = with(|p| p.target_seed = Some(seed));
        build::<3>("random", &parameters).unwrap().log_evidence()
    });
    assert_ne!(one, other);
    let error = build::<2>("gaussian", &parameters).map(|_| ()).unwrap_err().to_string();
    assert!(error.contains("'target-seed' (given as 7)"), "{error}");
}
