//! The uniform mesh in one dimension against rational functions, in exact arithmetic (Cao et al. 2024, Appendix C).

use crate::basis_scenes::line;
use crate::kernel_polynomial::{Fraction, Polynomial};
use mpm_mesh::MeshBasis;

/// The node that is looked at.
const NODE: i128 = 2;

/// Weight and gradient numerators and their common denominator on one half of a cell, for unit cells with nodes at the integers.
struct Piece {
    weight: Polynomial,
    gradient: Polynomial,
    determinant: Polynomial,
}

/// Derived from the definitions: the half cell from `half` / 2 to (`half` + 1) / 2.
fn piece(half: i128) -> Piece {
    let (x, cell) = (Polynomial::x(), half.div_euclid(2));
    let constant = |c: i128| Polynomial::constant(Fraction::new(c, 1));
    let middle = Fraction::new(2 * half + 1, 4);
    // b of the left vertex is cell + 1 − x, of the right one x − cell.
    let sample = |i: i128| {
        let share = match i - cell {
            -1 => constant(cell + 1).minus(&x),
            0 | 1 => constant(1),
            2 => x.minus(&constant(cell)),
            _ => constant(0),
        };
        let r = constant(i).minus(&x);
        let at_middle = Fraction::new(i, 1).minus(middle);
        let spline = if at_middle.size_is_below(Fraction::new(1, 2)) {
            Polynomial::constant(Fraction::new(3, 4)).minus(&r.times(&r))
        } else if at_middle.size_is_below(Fraction::new(3, 2)) {
            // |r| = ± r with the sign that it has on the whole piece.
            let size = if at_middle.is_negative() {
                constant(0).minus(&r)
            } else {
                r
            };
            let rest = Polynomial::constant(Fraction::new(3, 2)).minus(&size);
            rest.times(&rest).times(&Polynomial::constant(Fraction::new(1, 2)))
        } else {
            constant(0)
        };
        share.times(&spline)
    };
    let moment = |power: usize| {
        let terms = (cell - 1..=cell + 2).map(|i| {
            let r = constant(i).minus(&x);
            (0..power).fold(sample(i), |product, _| product.times(&r))
        });
        terms.fold(constant(0), |sum, term| sum.plus(&term))
    };
    let (zeroth, first, second) = (moment(0), moment(1), moment(2));
    let r = constant(NODE).minus(&x);
    Piece {
        weight: sample(NODE).times(&second.minus(&first.times(&r))),
        gradient: sample(NODE).times(&zeroth.times(&r).minus(&first)),
        determinant: zeroth.times(&second).minus(&first.times(&first)),
    }
}

fn basis() -> MeshBasis<1> {
    let nodes: Vec<f64> = (-4..9).map(f64::from).collect();
    MeshBasis::new(&line(&nodes)).unwrap()
}

/// Weight and gradient of the node at `x`.
fn found(basis: &MeshBasis<1>, x: f64) -> (f64, f64) {
    let weights = basis.weights_at(&[x]).unwrap();
    let of_node = |vertex: u32| (basis.mesh().vertices()[vertex as usize][0] - NODE as f64).abs() < 1e-9;
    let entry = weights
        .iter()
        .find(|weight| of_node(weight.vertex))
        .map(|weight| weight.entry);
    entry.map_or((0.0, 0.0), |entry| (entry.weight, entry.gradient[0]))
}

#[test]
fn all_pieces_are_those_of_exact_arithmetic() {
    let basis = basis();
    for half in -2..10 {
        let piece = piece(half);
        for k in 0..=64 {
            let x = Fraction::new(64 * half + k, 128);
            let (weight, gradient) = found(&basis, x.to_f64());
            let determinant = piece.determinant.at(x).to_f64();
            let expected = (
                piece.weight.at(x).to_f64() / determinant,
                piece.gradient.at(x).to_f64() / determinant,
            );
            let what = format!("x = {}", x.to_f64());
            assert!(
                (weight - expected.0).abs() < 1e-12,
                "{what}: weight {weight} for {}",
                expected.0
            );
            assert!(
                (gradient - expected.1).abs() < 1e-12,
                "{what}: gradient {gradient} for {}",
                expected.1
            );
        }
    }
}

#[test]
fn the_first_printed_piece_is_the_derived_one() {
    let polynomial =
        |ascending: &[(i128, i128)]| Polynomial::new(ascending.iter().map(|&(n, d)| Fraction::new(n, d)).collect());
    let weight = polynomial(&[(1, 16), (5, 16), (-53, 16), (17, 2), (-19, 2), (5, 1), (-1, 1)]);
    let gradient = polynomial(&[(17, 16), (-93, 16), (23, 2), (-21, 2), (5, 1), (-1, 1)]);
    let common = polynomial(&[(17, 16), (-21, 16), (13, 4), (-11, 2), (4, 1), (-1, 1)]);
    let derived = piece(2);
    assert_eq!(weight.times(&derived.determinant), derived.weight.times(&common));
    assert_eq!(gradient.times(&derived.determinant), derived.gradient.times(&common));
}

#[test]
fn the_node_is_symmetric_and_reaches_from_a_half_to_three_and_a_half() {
    let basis = basis();
    for k in 0..=1000 {
        let x = 2.0 + 0.002 * f64::from(k);
        let (right, left) = (found(&basis, x), found(&basis, 4.0 - x));
        assert!(
            (right.0 - left.0).abs() < 1e-14 && (right.1 + left.1).abs() < 1e-13,
            "x = {x}"
        );
        assert_eq!(right.0.abs() > 0.0, x < 3.5, "x = {x}");
    }
}

#[test]
fn the_diffuse_gradient_is_not_that_of_the_weight() {
    let basis = basis();
    let (x, step) = (1.3, 1e-6);
    let slope = (found(&basis, x + step).0 - found(&basis, x - step).0) / (2.0 * step);
    let gradient = found(&basis, x).1;
    assert!((gradient - 0.924).abs() < 5e-4, "{gradient}");
    assert!((slope - 0.828).abs() < 5e-4, "{slope}");
}
