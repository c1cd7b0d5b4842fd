use std::ops::{Index, IndexMut};

use faer::Mat;

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

    /// Orthonormal columns that span what these span: Q of A = Q R by Householder reflections, with as many columns as A, or as rows if these are fewer.
    pub fn orthonormal_columns(&self) -> Self {
        Self(self.0.qr().compute_thin_Q())
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
