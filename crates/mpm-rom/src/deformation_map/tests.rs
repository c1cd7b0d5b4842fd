use super::*;
use crate::manifold::Fields;

/// A lattice of points in [-1, 1]² × [-0.5, 0.5].
fn points() -> Vec<[f64; 3]> {
    let axis = |k: usize, n: usize, half: f64| half * (2.0 * (k as f64 + 0.5) / n as f64 - 1.0);
    (0..60)
        .map(|k| [axis(k % 5, 5, 1.0), axis(k / 5 % 4, 4, 1.0), axis(k / 20, 3, 0.5)])
        .collect()
}

/// What a family adds to [`Fields`]: a way and its gradient at X.
type Bend = fn(&[f64; 3]) -> (f64, [f64; 3]);

/// X + w(X) e_2 + fields.
struct Bent(Fields<3>, Bend);

/// Nowhere the identity.
const SHIFTED: Bend = |_| (0.1, [0.0, 0.0, 0.05]);

/// Bent at rest.
const WAVY: Bend = |x| {
    let (sin, cos) = (x[0] + 2.0 * x[1]).sin_cos();
    (0.05 * sin, [0.05 * cos, 0.1 * cos, 0.0])
};

impl Manifold<3> for Bent {
    fn coordinates(&self) -> usize {
        self.0.coordinates()
    }

    fn evaluate(&self, reference: &[[f64; 3]], latent: &[f64], wanted: Wanted, out: &mut Evaluation<3>) {
        self.0.evaluate(reference, latent, wanted, out);
        for (x, g) in reference.iter().zip(&mut out.positions) {
            g[2] += (self.1)(x).0;
        }
        for (x, gradient) in reference.iter().zip(&mut out.gradients) {
            gradient.0[2] = vector::add(&gradient.0[2], &(self.1)(x).1);
        }
    }
}

#[test]
fn at_rest_every_point_is_where_it_was_and_nothing_is_deformed() {
    let (reference, mut out) = (points(), Evaluation::default());
    let bent = Bent(Fields::bending(3), SHIFTED);
    let map = DeformationMap::new(&bent, &reference, &[0.2; 3]).expect("solvable");
    let prepared = map.prepare(&reference);
    let rest = map.rest().to_vec();
    map.evaluate(&prepared, &rest, Wanted::ALL, &mut out);
    for ((g, x), gradient) in out.positions.iter().zip(&reference).zip(&out.gradients) {
        assert!(vector::distance(g, x) < 1e-15 && (*gradient - Matrix::IDENTITY).frobenius_norm() < 1e-15);
    }
    assert!(rest.iter().all(|y| y.abs() < 1e-7), "{rest:?}");
}

#[test]
fn the_gradient_is_that_of_the_map() {
    let (reference, fields) = (points(), Fields::bending(4));
    let map = DeformationMap::new(&fields, &reference, &[0.0; 4]).expect("solvable");
    let (prepared, mut out) = (map.prepare(&reference), Evaluation::default());
    // F against central differences of g in X, away from rest.
    let (latent, step) = ([0.2, -0.1, 0.05, 0.1], 1e-5);
    map.evaluate(&prepared, &latent, Wanted::GRADIENTS, &mut out);
    let gradients = out.gradients.clone();
    for b in 0..3 {
        let [above, below] = [step, -step].map(|step| {
            let moved: Vec<[f64; 3]> = reference
                .iter()
                .map(|x| std::array::from_fn(|a| x[a] + if a == b { step } else { 0.0 }))
                .collect();
            let there = map.prepare(&moved);
            map.evaluate(&there, &latent, Wanted::default(), &mut out);
            out.positions.clone()
        });
        for ((gradient, above), below) in gradients.iter().zip(&above).zip(&below) {
            for a in 0..3 {
                assert!((gradient.0[a][b] - (above[a] - below[a]) / (2.0 * step)).abs() < 1e-8);
            }
        }
    }
}

#[test]
fn a_wrong_start_is_refused() {
    let error = DeformationMap::new(&Fields::<3>::translations(), &points(), &[0.0; 2]).err();
    assert_eq!(error, Some(DeformationMapError::Coordinates { found: 2, expected: 3 }));
}

#[test]
fn a_table_gives_what_is_computed() {
    let (reference, bent) = (points(), Bent(Fields::bending(3), WAVY));
    let map = DeformationMap::new(&bent, &reference, &[0.2; 3]).expect("solvable");
    let table = map.tabulate(&reference, 0.1, 0.1).expect("small");
    // The last one is outside of the table.
    let places: Vec<[f64; 3]> = reference
        .iter()
        .map(|x| vector::scale(x, 0.97))
        .chain([[5.0; 3]])
        .collect();
    let found = map.prepare_from(&table, &places);
    let expected = map.prepare(&places);
    assert_eq!(
        (found.reference, found.offsets.len()),
        (expected.reference, places.len())
    );
    for (a, b) in found.offsets.iter().zip(&expected.offsets) {
        assert!(vector::distance(a, b) < 1e-4, "{a:?} {b:?}");
    }
    for (a, b) in found.gradient_offsets.iter().zip(&expected.gradient_offsets) {
        assert!((*a - *b).frobenius_norm() < 2e-3, "{a:?} {b:?}");
    }
    assert_eq!(found.offsets.last(), expected.offsets.last());
}
