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

/// Eqs. 46 and 47 from the half cell [½, 1] on: weight, gradient and denominator in sixteenths, by ascending powers of x. The coefficients are printed to six digits, 205.563 for 3289/16.
/// Gradients three to five are printed over the denominator with the opposite sign. The first one has the sign that continuity at x = 1 asks for, which may have been lost in print.
const PRINTED: [[&[i128]; 3]; 6] = [
    [&[0, 1, -4, 4], &[0, 8, -36, 48, -16], &[-9, 101, -220, 216, -96, 16]],
    [
        &[1, 5, -53, 136, -152, 80, -16],
        &[17, -93, 184, -168, 80, -16],
        &[17, -21, 52, -88, 64, -16],
    ],
    [
        &[676, -2353, 3289, -2372, 936, -192, 16],
        &[-442, 1077, -1052, 536, -144, 16],
        &[-658, 1653, -1604, 760, -176, 16],
    ],
    [
        &[624, -2263, 3241, -2364, 936, -192, 16],
        &[-858, 2005, -1796, 792, -176, 16],
        &[258, -725, 860, -504, 144, -16],
    ],
    [
        &[14651, -28707, 23253, -9976, 2392, -304, 16],
        &[-4067, 6685, -4392, 1448, -240, 16],
        &[4867, -7925, 5100, -1624, 256, -16],
    ],
    [
        &[196, -161, 44, -4],
        &[1568, -2072, 996, -208, 16],
        &[2507, -4613, 3396, -1240, 224, -16],
    ],
];

#[test]
fn the_printed_pieces_are_the_derived_ones() {
    let polynomial = |sixteenths: &[i128]| Polynomial::new(sixteenths.iter().map(|&n| Fraction::new(n, 16)).collect());
    for (printed, half) in PRINTED.iter().zip(1..) {
        let [weight, gradient, denominator] = printed.map(polynomial);
        let derived = piece(half);
        let equal = |printed: &Polynomial, derived_numerator: &Polynomial| {
            assert_eq!(
                printed.times(&derived.determinant),
                derived_numerator.times(&denominator),
                "half cell {half}"
            );
        };
        equal(&weight, &derived.weight);
        equal(&gradient, &derived.gradient);
    }
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
