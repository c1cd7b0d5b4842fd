//! Linear maps by their columns.

use mpm_tensor::Matrix;

/// A linear map M of vectors of which nothing but columns is asked, so that a map that is a multiple of the identity, or nothing, costs
/// no more than it is.
pub trait Columns<const D: usize>: Copy {
    /// M e_axis, axis < D; `None` for M = 0.
    fn column(&self, axis: usize) -> Option<[f64; D]>;

    /// s for M = s I, where the type says so.
    fn isotropic(&self) -> Option<f64>;
}

/// M = 0.
impl<const D: usize> Columns<D> for () {
    #[inline(always)]
    fn column(&self, _: usize) -> Option<[f64; D]> {
        None
    }

    #[inline(always)]
    fn isotropic(&self) -> Option<f64> {
        Some(0.0)
    }
}

/// M = s I.
impl<const D: usize> Columns<D> for f64 {
    #[inline(always)]
    fn column(&self, axis: usize) -> Option<[f64; D]> {
        let mut column = [0.0; D];
        column[axis] = *self;
        Some(column)
    }

    #[inline(always)]
    fn isotropic(&self) -> Option<f64> {
        Some(*self)
    }
}

impl<const D: usize> Columns<D> for Matrix<D> {
    #[inline(always)]
    fn column(&self, axis: usize) -> Option<[f64; D]> {
        let mut column = [0.0; D];
        for a in 0..D {
            column[a] = self.0[a][axis];
        }
        Some(column)
    }

    #[inline(always)]
    fn isotropic(&self) -> Option<f64> {
        None
    }
}
