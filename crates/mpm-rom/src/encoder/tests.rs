use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;

use super::*;

fn encoder() -> Encoder<2> {
    let scaling = Scaling {
        centre: vec![0.0; 2],
        factor: vec![1.0; 2],
        mean: vec![0.1, -0.2],
        deviation: vec![0.7, 1.3],
    };
    let shape = EncoderShape {
        points: 90,
        width: 4,
        coordinates: 3,
    };
    Encoder::start(shape, scaling, &mut ChaCha8Rng::seed_from_u64(5)).unwrap()
}

fn positions() -> Vec<[f64; 2]> {
    (0..90).map(|n| [(n as f64).sin(), (1.7 * n as f64).cos()]).collect()
}

/// The formula, entry by entry.
fn naive(encoder: &Encoder<2>, positions: &[[f64; 2]]) -> Vec<f64> {
    let elu = |z: f64| if z > 0.0 { z } else { z.exp() - 1.0 };
    let mut parameters = encoder.parameters.iter().copied();
    let mut take = |count: usize| parameters.by_ref().take(count).collect::<Vec<f64>>();
    let scaled = |p: &[f64; 2]| [(p[0] - 0.1) / 0.7, (p[1] + 0.2) / 1.3];
    let mut a: Vec<f64> = positions.iter().flat_map(scaled).collect();
    for width in [88, 42] {
        let (weights, bias) = (take(6), take(1)[0]);
        let at = |n: usize| bias + (0..6).map(|k| weights[k] * a[2 * n + k]).sum::<f64>();
        a = (0..width).map(|n| elu(at(n))).collect();
    }
    let mut dense = |a: &[f64], outputs: usize| {
        let (weights, bias) = (take(a.len() * outputs), take(outputs));
        let z = |unit: usize| bias[unit] + (0..a.len()).map(|k| weights[unit * a.len() + k] * a[k]).sum::<f64>();
        (0..outputs).map(z).collect::<Vec<f64>>()
    };
    let hidden: Vec<f64> = dense(&a, 4).into_iter().map(elu).collect();
    dense(&hidden, 3)
}

#[test]
fn coordinates_follow_the_formula() {
    let encoder = encoder();
    let latent = encoder.encode(&positions()).unwrap();
    for (found, expected) in latent.iter().zip(naive(&encoder, &positions())) {
        assert!((found - expected).abs() < 1e-13);
    }
    assert_eq!(
        encoder.encode(&positions()[1..]),
        Err(EncoderError::Points {
            found: 89,
            expected: 90
        })
    );
}

#[test]
fn the_reverse_pass_is_that_of_finite_differences() {
    let mut encoder = encoder();
    let weights = [0.3, -1.1, 0.8];
    let objective = |encoder: &Encoder<2>| {
        let latent = naive(encoder, &positions());
        latent.iter().zip(weights).map(|(x, w)| x * w).sum::<f64>()
    };
    let mut tape = EncoderTape::default();
    encoder.forward(&positions(), &mut tape);
    let mut adjoint = vec![0.0; encoder.parameters.len()];
    encoder.reverse(&tape, &weights, &mut adjoint);
    let step = 1e-6;
    for k in 0..adjoint.len() {
        let kept = encoder.parameters[k];
        encoder.parameters[k] = kept + step;
        let plus = objective(&encoder);
        encoder.parameters[k] = kept - step;
        let minus = objective(&encoder);
        encoder.parameters[k] = kept;
        let difference = (plus - minus) / (2.0 * step);
        let size = 1.0 + difference.abs();
        assert!(
            (adjoint[k] - difference).abs() < 1e-8 * size,
            "parameter {k}: {} and {difference}",
            adjoint[k]
        );
    }
}
