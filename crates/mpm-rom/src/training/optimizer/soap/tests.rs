use super::*;

/// Θ of 3 × 5 and 2 × 3.
fn layers() -> Vec<Layer> {
    let first = Layer::at(0, 4, 3);
    let second = Layer::at(first.bias.end, 2, 2);
    vec![first, second]
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |largest, value| value.abs().max(largest))
}

#[test]
fn every_parameter_has_its_place() {
    let mut soap = Soap::new(&layers(), &layers());
    let change = soap.change(&[1.0; 42], 0.1, 1);
    assert!(change.iter().all(|change| (change + 0.1).abs() < 1e-9), "{change:?}");
}

#[test]
fn vectors_stay_orthonormal_and_become_those_of_the_covariance() {
    let mut soap = Soap::new(&layers()[..1], &[]);
    for step in 0..2001 {
        let gradient: Vec<_> = (0..15)
            .map(|k| (k as f64 + 1.0) * f64::from(step * k + k * k).sin())
            .collect();
        soap.change(&gradient, 0.1, step as u64 + 1);
    }
    let layer = &soap.layers[0];
    for (vectors, covariance) in layer.vectors.iter().zip(&layer.covariances) {
        let size = vectors.rows();
        let product = vectors.transposed_times(vectors);
        let diagonal = &vectors.transposed_times(covariance) * vectors;
        for i in 0..size {
            for j in 0..size {
                let unit = f64::from(u8::from(i == j));
                assert!((product[(i, j)] - unit).abs() < 1e-12);
                let off = diagonal[(i, j)].abs() / (diagonal[(i, i)] * diagonal[(j, j)]).sqrt();
                assert!(i == j || off < 0.5, "{i} {j} {off}");
            }
        }
    }
}

/// Change of the parameters, of gradient, rate and step.
type Change<'a> = dyn FnMut(&[f64], f64, u64) -> Vec<f64> + 'a;

/// ‖A (Θ − Θ*) B‖² with A and B turned and of condition 100: Adam needs the axes of the parameters, SOAP finds its own.
#[test]
fn a_turned_quadratic_is_minimised_faster_than_by_adam() {
    let size = 4;
    let turned = DenseMatrix::from_fn(size, size, |i, j| {
        let sum = |k: usize| {
            let wave = |i: usize| ((i as f64 + 0.5) * k as f64 * std::f64::consts::PI / size as f64).cos();
            let norm = if k == 0 { 1.0 } else { 2.0 } / size as f64;
            norm * wave(i) * wave(j) * 100f64.powf(-(k as f64) / (size as f64 - 1.0))
        };
        (0..size).map(sum).sum::<f64>()
    });
    let layer = Layer::at(0, size - 1, size);
    let loss_and_gradient = |parameters: &[f64]| {
        let error = DenseMatrix::from_fn(size, size, |i, j| {
            parameters[Eigenbasis::position(&layer, i, j)] - (1.0 + (i + 2 * j) as f64).sin()
        });
        let residual = &(&turned * &error) * &turned;
        let matrix = &(&turned * &residual) * &turned;
        let mut gradient = vec![0.0; size * size];
        for i in 0..size {
            for j in 0..size {
                gradient[Eigenbasis::position(&layer, i, j)] = 2.0 * matrix[(i, j)];
            }
        }
        (residual.entries().map(|entry| entry * entry).sum::<f64>(), gradient)
    };
    let minimise = |change: &mut Change<'_>| {
        let mut parameters = vec![0.0; size * size];
        for step in 0..1000 {
            let (_, gradient) = loss_and_gradient(&parameters);
            let rate = 0.1 * 0.99f64.powi(step);
            for (parameter, change) in parameters.iter_mut().zip(change(&gradient, rate, step as u64 + 1)) {
                *parameter += change;
            }
        }
        loss_and_gradient(&parameters).0
    };
    let mut soap = Soap::new(std::slice::from_ref(&layer), &[]);
    let mut adam = super::super::Adam::new(size * size);
    let with_soap = minimise(&mut |gradient, rate, step| soap.change(gradient, rate, step));
    let with_adam = minimise(&mut |gradient, rate, step| adam.change(gradient, rate, step));
    assert!(with_soap < 0.1 * with_adam, "{with_soap} {with_adam}");
}

#[test]
fn without_gradient_there_is_no_step() {
    let mut soap = Soap::new(&layers(), &[]);
    let change = soap.change(&[0.0; 21], 0.1, 1);
    assert_eq!(largest(&change), 0.0);
}
