use proptest::prelude::*;
use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;

use super::*;

const SHAPE: NetworkShape = NetworkShape {
    coordinates: 2,
    width: 5,
    depth: 3,
};

fn scaling() -> Scaling {
    Scaling {
        centre: vec![0.3, -0.2, 0.1],
        factor: vec![1.5, 0.7, 2.0],
        mean: vec![0.1, 0.2, -0.3],
        deviation: vec![0.8, 0.5, 1.2],
    }
}

fn network() -> Network<3> {
    let mut network = Network::start(SHAPE, scaling(), &mut ChaCha8Rng::seed_from_u64(3)).unwrap();
    // Biases that are not zero, so that a test sees them.
    for (k, parameter) in network.parameters.iter_mut().enumerate() {
        *parameter += 0.1 * (k as f64).sin();
    }
    network
}

fn points(count: usize) -> Vec<[f64; 3]> {
    let at = |n: usize| [(n as f64).sin(), (1.3 * n as f64).cos(), (0.7 * n as f64).sin()];
    (0..count).map(at).collect()
}

fn evaluate(network: &Network<3>, points: &[[f64; 3]], latent: &[f64], wanted: Wanted) -> Evaluation<3> {
    let mut out = Evaluation::default();
    network.evaluate(points, latent, wanted, &mut out);
    out
}

/// The formula, one point and one unit at a time.
fn naive(network: &Network<3>, position: [f64; 3], latent: &[f64]) -> [f64; 3] {
    let s = &network.scaling;
    let mut a: Vec<f64> = (0..3).map(|k| (position[k] - s.centre[k]) * s.factor[k]).collect();
    a.extend(latent);
    for (number, layer) in network.layers.iter().enumerate() {
        let weights = &network.parameters[layer.weights.clone()];
        let bias = &network.parameters[layer.bias.clone()];
        let row = |unit: usize| (0..layer.inputs).map(move |k| (unit * layer.inputs + k, k));
        let z = |unit: usize| bias[unit] + row(unit).map(|(at, k)| weights[at] * a[k]).sum::<f64>();
        let z: Vec<f64> = (0..layer.outputs).map(z).collect();
        let last = number + 1 == network.layers.len();
        a = z
            .iter()
            .map(|&z| if last || z > 0.0 { z } else { z.exp() - 1.0 })
            .collect();
    }
    std::array::from_fn(|c| s.mean[c] + s.deviation[c] * a[c])
}

#[test]
fn values_follow_the_formula() {
    let network = network();
    let (points, latent) = (points(200), [0.4, -0.9]);
    let out = evaluate(&network, &points, &latent, Wanted::default());
    for (point, position) in points.iter().zip(&out.positions) {
        let expected = naive(&network, *point, &latent);
        for c in 0..3 {
            assert!((position[c] - expected[c]).abs() < 1e-13);
        }
    }
    assert!(out.gradients.is_empty() && out.jacobians.is_empty());
}

#[test]
fn derivatives_are_those_of_the_values() {
    let network = network();
    let (points, latent) = (points(70), [0.4, -0.9]);
    let out = evaluate(&network, &points, &latent, Wanted::ALL);
    let step = 1e-6;
    for (p, point) in points.iter().enumerate() {
        for k in 0..3 {
            let moved = |by: f64| {
                let mut moved = *point;
                moved[k] += by;
                naive(&network, moved, &latent)
            };
            let (plus, minus) = (moved(step), moved(-step));
            for c in 0..3 {
                let difference = (plus[c] - minus[c]) / (2.0 * step);
                assert!(
                    (out.gradients[p].0[c][k] - difference).abs() < 2e-8,
                    "point {p}, axis {k}"
                );
            }
        }
        for k in 0..2 {
            let moved = |by: f64| {
                let mut moved = latent;
                moved[k] += by;
                naive(&network, *point, &moved)
            };
            let (plus, minus) = (moved(step), moved(-step));
            for c in 0..3 {
                let difference = (plus[c] - minus[c]) / (2.0 * step);
                assert!(
                    (out.jacobians[p * 2 + k][c] - difference).abs() < 2e-8,
                    "point {p}, coordinate {k}"
                );
            }
        }
    }
}

#[test]
fn velocities_are_the_jacobians_along_the_rates() {
    let (network, points, latent, rates) = (network(), points(300), [0.4, -0.9], [1.7, -0.6]);
    let all = evaluate(&network, &points, &latent, Wanted::ALL);
    let mut moving = Evaluation::default();
    network.evaluate_moving(&points, &latent, &rates, &mut moving);
    assert_eq!((&moving.positions, &moving.gradients), (&all.positions, &all.gradients));
    assert_eq!((moving.velocities.len(), moving.jacobians.len()), (300, 0));
    for (velocity, columns) in moving.velocities.iter().zip(all.jacobians.chunks(2)) {
        for c in 0..3 {
            let expected = columns[0][c] * rates[0] + columns[1][c] * rates[1];
            assert!((velocity[c] - expected).abs() < 1e-13);
        }
    }
}

#[test]
fn the_number_of_threads_does_not_matter() {
    let network = network();
    let points = points(1000);
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| evaluate(&network, &points, &[0.4, -0.9], Wanted::ALL))
    };
    let (one, three) = (on(1), on(3));
    assert_eq!(one.positions, three.positions);
    assert_eq!(one.gradients, three.gradients);
    assert_eq!(one.jacobians, three.jacobians);
}

#[test]
fn what_makes_no_network_is_refused() {
    let none = NetworkShape { width: 0, ..SHAPE };
    assert_eq!(
        Network::<3>::new(none, scaling(), vec![]),
        Err(NetworkError::Shape(format!("{none:?}")))
    );
    let expected = SHAPE.parameters(3);
    assert_eq!(
        Network::<3>::new(SHAPE, scaling(), vec![0.0]),
        Err(NetworkError::Parameters { found: 1, expected })
    );
    assert!(matches!(
        Network::<2>::new(SHAPE, scaling(), vec![0.0; SHAPE.parameters(2)]),
        Err(NetworkError::Scaling(_, 2))
    ));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    /// Any shape, any place in the list, whatever is wanted: the bits of a point are its own.
    #[test]
    fn neighbours_and_shapes_do_not_matter(
        (coordinates, width, depth) in (1_usize..8, 1_usize..32, 1_usize..5),
        (count, chosen) in (1_usize..350).prop_flat_map(|count| (Just(count), 0..count)),
        length in 1_usize..64,
        (gradients, jacobians, seed) in any::<(bool, bool, u64)>(),
    ) {
        let shape = NetworkShape { coordinates, width, depth };
        let network = Network::<3>::start(shape, scaling(), &mut ChaCha8Rng::seed_from_u64(seed)).unwrap();
        let (points, latent) = (points(count), vec![0.7; coordinates]);
        let wanted = Wanted { gradients, jacobians };
        let all = evaluate(&network, &points, &latent, wanted);
        let some = chosen..(chosen + length).min(count);
        let found = evaluate(&network, &points[some.clone()], &latent, wanted);
        prop_assert_eq!(&found.positions[..], &all.positions[some.clone()]);
        if gradients {
            prop_assert_eq!(&found.gradients[..], &all.gradients[some.clone()]);
        }
        if jacobians {
            prop_assert_eq!(&found.jacobians[..], &all.jacobians[some.start * coordinates..some.end * coordinates]);
        }
    }
}
