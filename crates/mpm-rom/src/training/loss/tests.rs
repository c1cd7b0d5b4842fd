use mpm_tensor::Matrix;
use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;

use super::*;
use crate::encoder::EncoderShape;
use crate::manifold::{Evaluation, Manifold, NetworkShape, Scaling, Wanted};

const POINTS: usize = 40;

fn run() -> Run<2> {
    let frame = |n: usize| {
        let t = n as f64;
        Frame {
            // Not evenly spaced.
            time: 0.4 * t + 0.1 * t * t,
            positions: (0..POINTS)
                .map(|p| [(p as f64 + 0.3 * t).sin(), (1.7 * p as f64 - 0.2 * t).cos()])
                .collect(),
            deformation_gradients: (0..POINTS)
                .map(|p| Matrix([[1.0 + 0.1 * t, 0.2], [(p as f64).sin(), 0.9]]))
                .collect(),
            velocities: (0..POINTS).map(|p| [0.3 * (p as f64).cos(), 0.1 * t]).collect(),
        }
    };
    Run {
        parameters: vec![],
        frames: (0..3).map(frame).collect(),
    }
}

fn reference() -> Vec<[f64; 2]> {
    (0..POINTS)
        .map(|p| [(p as f64).sin(), (1.7 * p as f64).cos()])
        .collect()
}

fn start() -> (Network<2>, Encoder<2>) {
    let mut generator = ChaCha8Rng::seed_from_u64(11);
    let scaling = Scaling {
        centre: vec![0.1, -0.1],
        factor: vec![0.9, 1.2],
        mean: vec![0.05, 0.1],
        deviation: vec![0.7, 1.1],
    };
    let network = NetworkShape {
        coordinates: 2,
        width: 4,
        depth: 3,
    };
    let encoder = EncoderShape {
        points: POINTS,
        width: 5,
        coordinates: 2,
    };
    let mut network = Network::start(network, scaling.clone(), &mut generator).unwrap();
    let encoder = Encoder::start(encoder, scaling, &mut generator).unwrap();
    for (k, parameter) in network.parameters_mut().iter_mut().enumerate() {
        *parameter += 0.1 * (k as f64).sin();
    }
    (network, encoder)
}

const WEIGHTS: Weights = Weights {
    gradient: 0.7,
    velocity: 0.4,
    share: 0.02,
};

/// Eq. 31 with the public evaluation of the network.
fn naive(network: &Network<2>, encoder: &Encoder<2>, weights: &Weights, number: usize, chosen: &[usize]) -> Terms {
    let (run, length) = (run(), network.scaling().length().powi(2));
    let frame = &run.frames[number];
    let latent = encoder.encode(&frame.positions).unwrap();
    let next = run
        .frames
        .get(number + 1)
        .map(|next| (encoder.encode(&next.positions).unwrap(), next.time - frame.time));
    let (mut out, mut terms) = (Evaluation::default(), Terms::default());
    network.evaluate(&reference(), &latent, Wanted::ALL, &mut out);
    for &p in chosen {
        for c in 0..2 {
            terms.position += weights.share * (out.positions[p][c] - frame.positions[p][c]).powi(2) / length;
            for k in 0..2 {
                let residual = out.gradients[p].0[c][k] - frame.deformation_gradients[p].0[c][k];
                terms.gradient += weights.share * weights.gradient * residual.powi(2);
            }
            if let Some((next, interval)) = &next {
                let along = |k: usize| out.jacobians[2 * p + k][c] * (next[k] - latent[k]) / interval;
                let residual = along(0) + along(1) - frame.velocities[p][c];
                terms.velocity += weights.share * weights.velocity * residual.powi(2) / length;
            }
        }
    }
    terms
}

fn close(found: f64, expected: f64, tolerance: f64) -> bool {
    (found - expected).abs() <= tolerance * (1.0 + expected.abs())
}

/// Terms and the adjoint of every parameter, for one choice of weights and frame.
fn check(weights: Weights, number: usize) {
    let (mut network, mut encoder) = start();
    let chosen: Vec<usize> = (0..POINTS).step_by(3).collect();
    let mut loss = PairLoss::new(&network, &encoder);
    loss.add((&network, &encoder), &weights, &reference(), &run(), number, &chosen);
    let expected = naive(&network, &encoder, &weights, number, &chosen);
    assert!(close(loss.terms.position, expected.position, 1e-13));
    assert!(close(loss.terms.gradient, expected.gradient, 1e-13));
    assert!(close(loss.terms.velocity, expected.velocity, 1e-13));
    let step = 1e-5;
    let slope_is = |slope: f64, kept: f64, at: &mut dyn FnMut(f64) -> f64| {
        let difference = (at(kept + step) - at(kept - step)) / (2.0 * step);
        at(kept);
        assert!(close(slope, difference, 1e-7), "{slope} and {difference}");
    };
    for (k, &slope) in loss.network.iter().enumerate() {
        slope_is(slope, network.parameters()[k], &mut |value| {
            network.parameters_mut()[k] = value;
            naive(&network, &encoder, &weights, number, &chosen).total()
        });
    }
    for (k, &slope) in loss.encoder.iter().enumerate() {
        slope_is(slope, encoder.parameters()[k], &mut |value| {
            encoder.parameters_mut()[k] = value;
            naive(&network, &encoder, &weights, number, &chosen).total()
        });
    }
}

#[test]
fn all_terms_and_adjoints_are_those_of_the_formula() {
    check(WEIGHTS, 1);
}

#[test]
fn the_last_frame_has_no_velocity_term() {
    check(WEIGHTS, 2);
}

#[test]
fn terms_without_weight_are_left_out() {
    let (gradient, velocity) = (0.0, 0.0);
    check(Weights { gradient, ..WEIGHTS }, 0);
    check(Weights { velocity, ..WEIGHTS }, 0);
}
