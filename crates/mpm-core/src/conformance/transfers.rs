//! Deposits and interpolations against the entries of a basis.

use mpm_kernels::{Deposit, Wanted};
use mpm_tensor::Matrix;

use super::{AnyBasis, Located};

/// What a particle at `x`, in a cell of so many `places`, sends to its nodes and reads from them: the sums over [`Basis::for_each_node`](crate::Basis::for_each_node), to rounding.
///
/// # Panics
///
/// Where that is not so, with `what` in the message.
pub fn transfers_are_sums<const D: usize>(
    basis: &dyn AnyBasis<D>,
    particle: usize,
    x: &[f64; D],
    places: usize,
    what: &str,
) {
    let (h, schedule) = (basis.spacing(), basis.schedule());
    let mut cells = 0..schedule.cell_count();
    let Some(cell) = cells.find(|&cell| schedule.cell(cell).contains(&particle)) else {
        panic!("{what}: particle {particle} is in no cell");
    };
    let member = Located { cell, particle, x };
    let vector = |i: usize| std::array::from_fn(|a| ((7 * i + 3 * a) % 11) as f64 - 5.0);
    let field: Vec<Deposit<D>> = (0..places)
        .map(|i| Deposit {
            scalar: 0.0,
            vector: vector(i),
        })
        .collect();
    let affine = Matrix::from_fn(|a, b| 0.3 * h * (a as f64 - 1.5 * b as f64));
    let flux = Matrix::from_fn(|a, b| h * (0.2 + a as f64 * 0.7 - b as f64));
    let value = field[0];
    let (mut sent, mut pressed) = (vec![Deposit::ZERO; field.len()], vec![Deposit::ZERO; field.len()]);
    let (mut mean, mut size) = ([0.0; D], 1.0f64);
    let (mut slope, mut least_squares, mut moment) = (Matrix::ZERO, Matrix::ZERO, Matrix::ZERO);
    basis.for_each_node(particle, x, &mut |i, entry| {
        let direction = basis.affine_direction(particle, x, entry);
        let gradient = |scale: f64, map: &Matrix<D>, v: &[f64; D]| Deposit {
            scalar: 0.0,
            vector: map.apply(v).map(|c| scale * c),
        };
        sent[i] = value.combine(entry.weight, &gradient(1.0, &affine, &direction), 1.0);
        sent[i].add(&gradient(1.0, &flux, &entry.gradient));
        pressed[i] = value.combine(
            entry.weight,
            &gradient(0.7 * h, &Matrix::IDENTITY, &entry.gradient),
            1.0,
        );
        size = size.max(h * direction.iter().fold(0.0, |most: f64, c| most.max(c.abs())));
        for a in 0..D {
            mean[a] += entry.weight * field[i].vector[a];
        }
        slope += Matrix::outer(&field[i].vector, &entry.gradient);
        least_squares += Matrix::outer(&field[i].vector, &direction);
        moment += Matrix::outer(&field[i].vector, &entry.offset) * entry.weight;
    });
    let close = |found: &[Deposit<D>], expected: &[Deposit<D>]| {
        for (found, expected) in found.iter().zip(expected) {
            let error = found.minus(expected);
            let largest = error
                .vector
                .iter()
                .fold(error.scalar.abs(), |most, c| most.max(c.abs()));
            assert!(largest < 1e-11 * size, "{what}: deposit {found:?} for {expected:?}");
        }
    };
    let mut nodes = vec![Deposit::ZERO; field.len()];
    basis.deposit_matrices(member, &value, &affine, &flux, &mut nodes);
    close(&nodes, &sent);
    nodes.fill(Deposit::ZERO);
    basis.deposit_pressure(member, &value, 0.7 * h, &mut nodes);
    close(&nodes, &pressed);

    let (mut first, mut second) = (vec![1.0; field.len()], vec![0.0; field.len()]);
    basis.deposit_scalars(member, [0.7, -2.0], [&mut first, &mut second]);
    let mut expected = vec![[1.0, 0.0]; field.len()];
    basis.for_each_node(particle, x, &mut |i, entry| {
        expected[i] = [1.0 + 0.7 * entry.weight, -2.0 * entry.weight];
    });
    for ((first, second), expected) in first.iter().zip(&second).zip(&expected) {
        let error = (first - expected[0]).abs().max((second - expected[1]).abs());
        assert!(error < 1e-14, "{what}: scalars {first}, {second} for {expected:?}");
    }
    let scalars: Vec<f64> = field.iter().map(|node| node.vector[0]).collect();
    let seen = basis.interpolate_scalar(member, &scalars);
    assert!((seen - mean[0]).abs() < 1e-12, "{what}: scalar");

    for bits in 0..8 {
        let wanted = Wanted {
            gradient: bits & 1 != 0,
            least_squares: bits & 2 != 0,
            moment: bits & 4 != 0,
        };
        let seen = basis.interpolate(member, wanted, &field);
        let gradient = if wanted.least_squares { least_squares } else { slope };
        let gradient = if wanted.gradient { gradient } else { Matrix::ZERO };
        let moment = if wanted.moment { moment } else { Matrix::ZERO };
        assert!((0..D).all(|a| (seen.value[a] - mean[a]).abs() < 1e-12), "{what}: value");
        assert!(
            (seen.gradient - gradient).maximum_norm() < 1e-11 * size / h,
            "{what}: {wanted:?}"
        );
        assert!((seen.moment - moment).maximum_norm() < 1e-11 * h, "{what}: {wanted:?}");
    }
}
