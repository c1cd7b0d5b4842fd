//! Scalar and vector in lanes: by hand, because the compiler turns sums of four components into one instruction only now and then.

use mpm_tensor::Matrix;

use crate::Deposit;
use crate::lanes::{LANES, Lanes};

/// A [`Deposit`] whose components lie in `G` groups of four lanes, one instruction for each group; see [`groups_of`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Packed<const G: usize>([Lanes; G]);

/// Groups of lanes that a scalar and a vector of `dimension` components fill.
pub const fn groups_of(dimension: usize) -> usize {
    dimension / LANES + 1
}

impl<const G: usize> Packed<G> {
    /// Nothing.
    pub const ZERO: Self = Self([Lanes::ZERO; G]);

    /// The components `scalar` and `vector`; those that there is no lane for are lost.
    #[inline(always)]
    pub fn new<const D: usize>(scalar: f64, vector: &[f64; D]) -> Self {
        let mut packed = Self::ZERO;
        for group in 0..G {
            let component = |lane: usize| match LANES * group + lane {
                0 => scalar,
                a if a <= D => vector[a - 1],
                _ => 0.0,
            };
            packed.0[group] = Lanes::new([component(0), component(1), component(2), component(3)]);
        }
        packed
    }

    /// The same components.
    #[inline(always)]
    pub fn deposit<const D: usize>(&self) -> Deposit<D> {
        let mut deposit = Deposit::ZERO;
        for group in 0..G {
            let lanes = self.0[group].to_array();
            for lane in 0..LANES {
                match LANES * group + lane {
                    0 => deposit.scalar = lanes[0],
                    a if a <= D => deposit.vector[a - 1] = lanes[lane],
                    _ => {}
                }
            }
        }
        deposit
    }

    /// `self` + `deposit`.
    #[inline(always)]
    pub fn plus_deposit<const D: usize>(&self, deposit: &Deposit<D>) -> Self {
        self.plus(Lanes::splat(1.0), &Self::new(deposit.scalar, &deposit.vector))
    }

    /// The groups of lanes.
    #[inline(always)]
    pub fn lanes(&self) -> &[Lanes; G] {
        &self.0
    }

    /// The matrix whose columns are the vectors.
    #[inline(always)]
    pub fn matrix<const D: usize>(columns: &[Self; D]) -> Matrix<D> {
        let mut matrix = Matrix::ZERO;
        for j in 0..D {
            let column = columns[j].deposit::<D>().vector;
            for i in 0..D {
                matrix.0[i][j] = column[i];
            }
        }
        matrix
    }

    /// From the first `G` entries.
    #[inline(always)]
    pub fn read(from: &[Lanes]) -> Self {
        let mut packed = Self::ZERO;
        packed.0.copy_from_slice(&from[..G]);
        packed
    }

    /// To the first `G` entries.
    #[inline(always)]
    pub fn write(&self, to: &mut [Lanes]) {
        to[..G].copy_from_slice(&self.0);
    }

    /// `weight` `self`, all lanes of `weight` being the same.
    #[inline(always)]
    pub fn times(&self, weight: Lanes) -> Self {
        let mut product = *self;
        for group in 0..G {
            product.0[group] = self.0[group] * weight;
        }
        product
    }

    /// `self` + `weight` `other`, rounded once where the machine can; all lanes of `weight` being the same.
    #[inline(always)]
    pub fn plus(&self, weight: Lanes, other: &Self) -> Self {
        let mut sum = *self;
        for group in 0..G {
            sum.0[group] = other.0[group].mul_add(weight, self.0[group]);
        }
        sum
    }
}

/// Sums at the nodes of a stencil that a particle adds to, by place in the stencil.
pub trait NodeSink<const D: usize> {
    /// Add to a node.
    fn add(&mut self, index: usize, deposit: &Deposit<D>);

    /// Let `add` add to what it is given, and add what that has become more by.
    fn update<const G: usize>(&mut self, index: usize, add: impl FnOnce(&Packed<G>) -> Packed<G>);

    /// Add to the nodes at the [`LANES`] places from `first` on what is in the rows, a scalar and a vector; for D ≤ 3.
    #[inline(always)]
    fn add_rows(&mut self, first: usize, rows: &[Lanes; LANES]) {
        let mut window = self.window(first, LANES);
        for (place, row) in rows.iter().enumerate() {
            window.update(place, |sum: &Packed<1>| sum.plus(Lanes::splat(1.0), &Packed([*row])));
        }
    }

    /// The `length` places from `first` on, counted from 0: a sink in memory checks them here, once for all nodes of a stencil.
    #[inline(always)]
    fn window(&mut self, first: usize, _length: usize) -> impl NodeSink<D> {
        Shifted { inner: self, first }
    }
}

/// A vector field at the nodes of a stencil, by place in the stencil.
pub trait NodeField<const D: usize> {
    /// The vector at a node.
    fn vector(&self, index: usize) -> [f64; D];

    /// The same as the vector of a deposit, whose scalar has no meaning.
    fn packed<const G: usize>(&self, index: usize) -> Packed<G>;

    /// The first group of [`packed`](Self::packed): all of the vector for D ≤ 3.
    #[inline(always)]
    fn lanes(&self, index: usize) -> Lanes {
        self.packed::<1>(index).0[0]
    }

    /// The nodes of the places four by four, side by side: no meaning, then component by component; for D ≤ 3. A field that does not know how many there are has
    /// no end.
    #[inline(always)]
    fn by_fours(&self) -> impl Iterator<Item = [Lanes; LANES]> {
        let lanes = |first: usize| std::array::from_fn(|place| self.lanes(first + place));
        (0..).step_by(LANES).map(move |first| Lanes::transpose(lanes(first)))
    }

    /// The `length` places from `first` on, as [`NodeSink::window`].
    #[inline(always)]
    fn window(&self, first: usize, _length: usize) -> impl NodeField<D> {
        Shifted { inner: self, first }
    }
}

/// Places from `first` on.
struct Shifted<V> {
    inner: V,
    first: usize,
}

impl<V: NodeSink<D> + ?Sized, const D: usize> NodeSink<D> for Shifted<&mut V> {
    #[inline(always)]
    fn add(&mut self, index: usize, deposit: &Deposit<D>) {
        self.inner.add(self.first + index, deposit);
    }

    #[inline(always)]
    fn update<const G: usize>(&mut self, index: usize, add: impl FnOnce(&Packed<G>) -> Packed<G>) {
        self.inner.update(self.first + index, add);
    }
}

impl<V: NodeField<D> + ?Sized, const D: usize> NodeField<D> for Shifted<&V> {
    #[inline(always)]
    fn vector(&self, index: usize) -> [f64; D] {
        self.inner.vector(self.first + index)
    }

    #[inline(always)]
    fn packed<const G: usize>(&self, index: usize) -> Packed<G> {
        self.inner.packed(self.first + index)
    }
}
