use super::*;

/// Rosenbrock's valley in pairs of coordinates.
fn valley(x: &[f64]) -> (Terms, Vec<f64>) {
    let (mut value, mut gradient) = (0.0, vec![0.0; x.len()]);
    for (pair, gradient) in x.chunks_exact(2).zip(gradient.chunks_exact_mut(2)) {
        let across = pair[1] - pair[0] * pair[0];
        value += (1.0 - pair[0]).powi(2) + 100.0 * across * across;
        gradient[0] = -2.0 * (1.0 - pair[0]) - 400.0 * pair[0] * across;
        gradient[1] = 200.0 * across;
    }
    let terms = Terms {
        position: value,
        ..Terms::default()
    };
    (terms, gradient)
}

fn start() -> (QuasiNewton, Vec<f64>) {
    let parameters = vec![-1.2, 1.0, 0.3, -0.7, 2.0, 2.5];
    let (terms, gradient) = valley(&parameters);
    let state = QuasiNewton::new(&[0.01; 6], terms, gradient);
    (state, parameters)
}

#[test]
fn the_bottom_of_a_valley_is_found_in_few_steps() {
    let (mut state, mut parameters) = start();
    let mut steps = 0;
    while state.terms.total() > 1e-18 {
        state.step(&mut parameters, &mut valley).expect("downhill");
        steps += 1;
        assert!(steps < 120, "{:?}", state.terms);
    }
    assert!(parameters.iter().all(|x| (x - 1.0).abs() < 1e-8), "{parameters:?}");
}

#[test]
fn the_inverse_takes_changes_of_the_gradient_to_steps_and_outlives_its_file() {
    let (mut state, mut parameters) = start();
    for _ in 0..5 {
        let (x, g) = (parameters.clone(), state.gradient.clone());
        state.step(&mut parameters, &mut valley).expect("downhill");
        let change: Vec<f64> = state.gradient.iter().zip(&g).map(|(a, b)| a - b).collect();
        let stepped = state.inverse.apply(&change);
        for ((stepped, after), before) in stepped.iter().zip(&parameters).zip(&x) {
            assert!((stepped - (after - before)).abs() < 1e-12);
        }
    }
    state.step(&mut parameters, &mut valley).expect("downhill");
    let lower = state.inverse.lower();
    let (mut read, x) = (InverseHessian::from_lower(6, &lower), [0.3, -1.0, 0.2, 2.0, 0.5, -0.1]);
    assert_eq!(read.apply(&x), state.inverse.apply(&x));
    assert_eq!(read.lower(), state.inverse.lower());
}
