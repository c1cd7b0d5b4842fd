use std::ops::{Index, IndexMut};

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::householder::{
    apply_block_householder_sequence_on_the_left_in_place_scratch as applied_scratch,
    apply_block_householder_sequence_on_the_left_in_place_with_conj as apply_reflections,
};
use faer::linalg::qr::no_pivoting::factor;
use faer::{Conj, Mat, Par};

/// A matrix of real numbers, stored by columns.
#[derive(Clone, Debug, PartialEq)]
pub struct DenseMatrix(pub(crate) Mat<f64>);

impl DenseMatrix {
    /// A matrix of zeros.
    pub fn zeros(rows: usize, columns: usize) -> Self {
        Self(Mat::zeros(rows, columns))
    }

    /// I.
    pub fn identity(size: usize) -> Self {
        Self(Mat::identity(size, size))
    }

    /// The matrix of these entries, which are asked for column by column.
    pub fn from_fn(rows: usize, columns: usize, mut entry: impl FnMut(usize, usize) -> f64) -> Self {
        let mut matrix = Self::zeros(rows, columns);
        for j in 0..columns {
            for (i, value) in matrix.column_mut(j).iter_mut().enumerate() {
                *value = entry(i, j);
            }
        }
        matrix
    }

    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.0.nrows()
    }

    /// The number of columns.
    pub fn columns(&self) -> usize {
        self.0.ncols()
    }

    /// Column j.
    pub fn column(&self, j: usize) -> &[f64] {
        self.0.col_as_slice(j)
    }

    /// Column j, to be changed.
    pub fn column_mut(&mut self, j: usize) -> &mut [f64] {
        self.0.col_as_slice_mut(j)
    }

    /// All entries, column by column.
    pub fn entries(&self) -> impl Iterator<Item = &f64> {
        (0..self.columns()).flat_map(|j| self.column(j))
    }

    /// All entries, column by column, to be changed.
    pub fn entries_mut(&mut self) -> impl Iterator<Item = &mut f64> {
        self.0.col_iter_mut().flat_map(|column| column.iter_mut())
    }

    /// Orthonormal columns that span what these span: Q of A = Q R by Householder reflections, with as many columns as A, or as rows if these are fewer. On one thread: with more, sums are taken in another order, and the bits would hang on their number.
    pub fn orthonormal_columns(&self) -> Self {
        let (rows, columns) = (self.rows(), self.columns());
        let size = rows.min(columns);
        let block = factor::recommended_block_size::<f64>(rows, columns);
        let mut reflections = self.0.clone();
        let mut coefficients = Mat::zeros(block, size);
        let factoring = factor::qr_in_place_scratch::<f64>(rows, columns, block, Par::Seq, Default::default());
        let applying = applied_scratch::<f64>(rows, block, size);
        let mut scratch = MemBuffer::new(factoring.or(applying));
        let stack = MemStack::new(&mut scratch);
        let factors = reflections.as_mut();
        factor::qr_in_place(factors, coefficients.as_mut(), Par::Seq, stack, Default::default());
        let mut columns = Mat::identity(rows, size);
        apply_reflections(
            reflections.get(.., ..size),
            coefficients.as_ref(),
            Conj::No,
            columns.as_mut(),
            Par::Seq,
            stack,
        );
        Self(columns)
    }
}

impl Index<(usize, usize)> for DenseMatrix {
    type Output = f64;

    #[inline]
    fn index(&self, (row, column): (usize, usize)) -> &f64 {
        &self.0[(row, column)]
    }
}

impl IndexMut<(usize, usize)> for DenseMatrix {
    #[inline]
    fn index_mut(&mut self, (row, column): (usize, usize)) -> &mut f64 {
        &mut self.0[(row, column)]
    }
}
