//! Deposits and interpolations of stencils against sums over their entries.

use mpm_kernels::{
    Columns, Cubic, Deposit, Gimp, Linear, NodeField, NodeSink, Packed, Quadratic, SecondMoment, Spline, Stencil,
    UniformGrid, Wanted, groups_of,
};
use mpm_tensor::Matrix;
use proptest::prelude::*;

/// One sum, or one vector, per node.
struct Nodes<const D: usize>(Vec<Deposit<D>>);

impl<const D: usize> NodeSink<D> for Nodes<D> {
    fn add(&mut self, index: usize, deposit: &Deposit<D>) {
        self.0[index].add(deposit);
    }

    fn update<const G: usize>(&mut self, index: usize, add: impl FnOnce(&Packed<G>) -> Packed<G>) {
        assert_eq!(G, groups_of(D));
        let before = &self.0[index];
        self.0[index] = add(&Packed::new(before.scalar, &before.vector)).deposit();
    }
}

impl<const D: usize> NodeField<D> for Nodes<D> {
    fn vector(&self, index: usize) -> [f64; D] {
        self.0[index].vector
    }

    fn packed<const G: usize>(&self, index: usize) -> Packed<G> {
        assert_eq!(G, groups_of(D));
        Packed::new(f64::NAN, &self.0[index].vector) // the scalar must not matter
    }
}

/// M v by columns.
fn product<const D: usize>(map: &impl Columns<D>, v: &[f64; D]) -> [f64; D] {
    let mut sum = [0.0; D];
    for a in 0..D {
        for (sum, c) in sum.iter_mut().zip(map.column(a).unwrap_or([0.0; D])) {
            *sum += v[a] * c;
        }
    }
    sum
}

/// Weight, gradient, offset, w D⁻¹ (x_i − x).
type Seen<const D: usize> = (f64, [f64; D], [f64; D], [f64; D]);

/// Every entry with w D⁻¹ (x_i − x), D from its definition.
fn entries<const W: usize, const D: usize, S: Spline<W>>(stencil: &Stencil<W, D>) -> Vec<Seen<D>> {
    let mut moments = [0.0; D];
    stencil.for_each(|_, entry| {
        for a in 0..D {
            moments[a] += entry.weight * entry.offset[a] * entry.offset[a];
        }
    });
    let mut entries = Vec::new();
    stencil.for_each(|_, entry| {
        let direction = match S::SECOND_MOMENT {
            SecondMoment::Gradient => entry.gradient,
            _ => std::array::from_fn(|a| entry.weight * entry.offset[a] / moments[a]),
        };
        entries.push((entry.weight, entry.gradient, entry.offset, direction));
    });
    if let Some(stated) = stencil.second_moments() {
        for a in 0..D {
            assert!(
                (stated[a] / moments[a] - 1.0).abs() < 1e-12,
                "{}: {stated:?} for {moments:?}",
                S::NAME
            );
        }
    }
    entries
}

fn deposits<const W: usize, const D: usize, S: Spline<W>>(
    stencil: &Stencil<W, D>,
    affine: &impl Columns<D>,
    flux: &impl Columns<D>,
) {
    let value = Deposit {
        scalar: 1.7,
        vector: std::array::from_fn(|a| 0.3 + a as f64),
    };
    let start = Deposit {
        scalar: 0.25,
        vector: [-0.5; D],
    };
    let mut nodes = Nodes(vec![start; W.pow(D as u32)]);
    stencil.deposit(&value, affine, flux, &mut nodes);
    for (node, (weight, gradient, _, direction)) in nodes.0.iter().zip(entries::<W, D, S>(stencil)) {
        assert!((node.scalar - start.scalar - weight * value.scalar).abs() < 1e-14);
        let (linear, stress) = (product(affine, &direction), product(flux, &gradient));
        for a in 0..D {
            let expected = start.vector[a] + weight * value.vector[a] + linear[a] + stress[a];
            let size = 1.0 + linear[a].abs() + stress[a].abs();
            assert!(
                (node.vector[a] - expected).abs() < 1e-12 * size,
                "{}: {} for {expected}",
                S::NAME,
                node.vector[a]
            );
        }
    }
}

fn interpolations<const W: usize, const D: usize, S: Spline<W>>(stencil: &Stencil<W, D>, h: f64) {
    let vector = |i: usize| std::array::from_fn(|a| ((7 * i + 3 * a) % 11) as f64 - 5.0);
    let nodes: Vec<[f64; D]> = (0..W.pow(D as u32)).map(vector).collect();
    let field = Nodes(nodes.iter().map(|&vector| Deposit { scalar: 0.0, vector }).collect());
    let entries = entries::<W, D, S>(stencil);
    let mut value = [0.0; D];
    let (mut slope, mut least_squares, mut moment) = (Matrix::ZERO, Matrix::ZERO, Matrix::ZERO);
    for (v, (weight, gradient, offset, direction)) in nodes.iter().zip(entries) {
        for a in 0..D {
            value[a] += weight * v[a];
        }
        slope += Matrix::outer(v, &gradient);
        least_squares += Matrix::outer(v, &direction);
        moment += Matrix::outer(v, &offset) * weight;
    }
    for bits in 0..8 {
        let wanted = Wanted {
            gradient: bits & 1 != 0,
            least_squares: bits & 2 != 0,
            moment: bits & 4 != 0,
        };
        let seen = stencil.interpolate(wanted, &field);
        let gradient = if wanted.least_squares { least_squares } else { slope };
        let gradient = if wanted.gradient { gradient } else { Matrix::ZERO };
        let moment = if wanted.moment { moment } else { Matrix::ZERO };
        let scale = 1e-12 * (1.0 + gradient.maximum_norm());
        for a in 0..D {
            assert!((seen.value[a] - value[a]).abs() < 1e-12);
        }
        assert!(
            (seen.gradient - gradient).maximum_norm() < scale,
            "{}, {wanted:?}",
            S::NAME
        );
        assert!(
            (seen.moment - moment).maximum_norm() < 1e-12 * h,
            "{}, {wanted:?}",
            S::NAME
        );
    }
}

fn transfers<const W: usize, const D: usize, S: Spline<W>>(kernel: S, x: &[f64], h: f64) {
    let stencil = Stencil::<W, D>::of(&kernel, &std::array::from_fn(|a| x[a]), &UniformGrid::new([0.1; D], h));
    let affine = Matrix::from_fn(|a, b| 0.3 * h * (a as f64 - 1.5 * b as f64));
    let flux = Matrix::from_fn(|a, b| h * (0.2 + a as f64 * 0.7 - b as f64));
    deposits::<W, D, S>(&stencil, &affine, &flux);
    deposits::<W, D, S>(&stencil, &affine, &());
    deposits::<W, D, S>(&stencil, &(), &flux);
    deposits::<W, D, S>(&stencil, &(), &(0.7 * h));
    deposits::<W, D, S>(&stencil, &(), &());
    interpolations::<W, D, S>(&stencil, h);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn transfers_are_sums_over_entries(x in prop::collection::vec(-20.0..20.0f64, 6), h in 0.05..3.0f64) {
        transfers::<2, 1, _>(Linear, &x, h);
        transfers::<2, 2, _>(Linear, &x, h);
        transfers::<2, 3, _>(Linear, &x, h);
        transfers::<2, 6, _>(Linear, &x, h);
        transfers::<3, 1, _>(Quadratic, &x, h);
        transfers::<3, 2, _>(Quadratic, &x, h);
        transfers::<3, 3, _>(Quadratic, &x, h);
        transfers::<3, 4, _>(Quadratic, &x, h);
        transfers::<4, 1, _>(Cubic, &x, h);
        transfers::<4, 2, _>(Cubic, &x, h);
        transfers::<4, 3, _>(Cubic, &x, h);
        transfers::<3, 2, _>(Gimp::new(2), &x, h);
        transfers::<3, 3, _>(Gimp::new(2), &x, h);
        transfers::<3, 2, _>(Gimp::new(1), &x, h);
    }
}
