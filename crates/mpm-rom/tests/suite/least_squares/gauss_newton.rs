//! Least squares of what is not linear.

use mpm_rom::least_squares::{GaussNewton, Settings};
use mpm_rom::manifold::{Evaluation, Wanted};

/// g_p(y) = (e^{y₀ p}, y₁ sin(y₀ p)), p = 0.1, 0.2, …
fn curve(y: &[f64], out: &mut Evaluation<2>) {
    out.positions.clear();
    out.jacobians.clear();
    for p in (1..10).map(|p| 0.1 * f64::from(p)) {
        let (exponential, (sine, cosine)) = ((y[0] * p).exp(), (y[0] * p).sin_cos());
        out.positions.push([exponential, y[1] * sine]);
        out.jacobians.push([p * exponential, y[1] * p * cosine]);
        out.jacobians.push([0.0, sine]);
    }
}

#[test]
fn weights_decide_between_targets() {
    // g_p(y) = y for both points.
    let same = |y: &[f64], _: Wanted, out: &mut Evaluation<1>| {
        out.positions = vec![[y[0]]; 2];
        out.jacobians = vec![[1.0]; 2];
    };
    let mut y = [0.3];
    let found = GaussNewton::weighted(vec![3.0, 1.0]).minimise(&[[1.0], [5.0]], &mut y, &Settings::default(), same);
    let found = found.expect("of full rank");
    assert!(
        (y[0] - 2.0).abs() < 1e-14 && (found - 12.0).abs() < 1e-13,
        "{y:?} {found:?}"
    );
}

#[test]
fn it_finds_the_parameters_of_a_curve_from_afar() {
    let (mut search, mut exact) = (GaussNewton::default(), Evaluation::default());
    curve(&[1.3, -0.7], &mut exact);
    let mut y = [5.0, 4.0];
    let found = search
        .minimise(&exact.positions, &mut y, &Settings::default(), |y, _, out| {
            curve(y, out)
        })
        .expect("of full rank");
    assert!(
        (y[0] - 1.3).abs() < 1e-12 && (y[1] + 0.7).abs() < 1e-12,
        "{y:?} {found:?}"
    );
    assert!(found < 1e-24);
}
