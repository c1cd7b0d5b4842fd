//! Matrices of every kind that the decompositions must survive, and mpm-dense, which is faer, as the oracle.
#![allow(dead_code)]

use mpm_dense::DenseMatrix;
use mpm_tensor::{Matrix, SingularValues, vector};
use proptest::prelude::*;

/// Properties of random matrices, D = 1…8: a test of each check of what the strategy draws.
#[macro_export]
macro_rules! properties {
    ($($name:ident: $check:ident of $strategy:ident;)+) => {
        proptest! {
            $(#[test]
            fn $name(sample in $strategy()) {
                mpm_tensor::in_dimensions!($check(&sample)?, 1, 2, 3, 4, 5, 6, 7, 8);
            })+
        }
    };
}

/// The shape of a matrix's singular values, or that of its entries.
#[derive(Clone, Copy, Debug)]
pub enum Spectrum {
    /// Entries uniform in (−1, 1).
    Uniform,
    /// Small integers, often exactly singular.
    Integer,
    /// All singular values within 1e-12 of each other.
    Clustered,
    /// Two clusters a factor 1e6 apart.
    TwoClusters,
    /// Half of the singular values zero up to rounding.
    RankDeficient,
    /// Singular values 1, 1e-2, 1e-4, …
    Graded,
}

/// Raw material from which a matrix of any D ≤ 8 is made.
#[derive(Clone, Debug)]
pub struct Sample {
    pub spectrum: Spectrum,
    pub exponent: i32,
    pub numbers: Vec<f64>,
}

pub fn sample() -> impl Strategy<Value = Sample> {
    use Spectrum::*;
    let spectrum = prop::sample::select(vec![Uniform, Integer, Clustered, TwoClusters, RankDeficient, Graded]);
    let exponent = prop::sample::select(vec![0, 0, -40, 40, -120, 120]);
    (spectrum, exponent, prop::collection::vec(-1.0..1.0, 192)).prop_map(|(spectrum, exponent, numbers)| Sample {
        spectrum,
        exponent,
        numbers,
    })
}

/// A sample whose inverse is well determined.
pub fn regular_sample() -> impl Strategy<Value = Sample> {
    use Spectrum::*;
    let spectrum = prop::sample::select(vec![Uniform, Clustered, TwoClusters, Graded]);
    (spectrum, prop::collection::vec(-1.0..1.0, 192)).prop_map(|(spectrum, numbers)| Sample {
        spectrum,
        exponent: 0,
        numbers,
    })
}

impl Sample {
    fn block<const D: usize>(&self, index: usize) -> Matrix<D> {
        Matrix::from_fn(|i, j| self.numbers[64 * index + D * i + j])
    }

    /// The prescribed singular values.
    pub fn singular_values<const D: usize>(&self) -> [f64; D] {
        std::array::from_fn(|k| match self.spectrum {
            Spectrum::Clustered => 1.0 + 1e-12 * self.numbers[k],
            Spectrum::TwoClusters if 2 * k + 1 < D => 1.0 + 1e-12 * self.numbers[k],
            Spectrum::TwoClusters => 1e-6 * (1.0 + 1e-9 * self.numbers[k]),
            Spectrum::RankDeficient if 2 * k >= D => 0.0,
            Spectrum::Graded => 0.01f64.powi(k as i32),
            _ => 1.0,
        })
    }

    /// A general matrix.
    pub fn general<const D: usize>(&self) -> Matrix<D> {
        let matrix = match self.spectrum {
            Spectrum::Uniform => self.block(0),
            Spectrum::Integer => self.block(0).map_entries(|entry| (1.7 * entry).round()),
            _ => {
                let values = Matrix::diagonal(&self.singular_values());
                orthogonal(&self.block(1)) * values * orthogonal(&self.block::<D>(2)).transpose()
            }
        };
        matrix * 10f64.powi(self.exponent)
    }

    /// A symmetric matrix; the eigenvalues of the prescribed spectra take both signs.
    pub fn symmetric<const D: usize>(&self) -> Matrix<D> {
        let matrix = match self.spectrum {
            Spectrum::Uniform | Spectrum::Integer => return self.general().symmetric_part(),
            _ => {
                let sizes = self.singular_values::<D>();
                let values = std::array::from_fn(|k| if k % 3 == 1 { -sizes[k] } else { sizes[k] });
                let vectors = orthogonal(&self.block::<D>(1));
                vectors * Matrix::diagonal(&values) * vectors.transpose()
            }
        };
        (matrix * 10f64.powi(self.exponent)).symmetric_part()
    }

    pub fn vector<const D: usize>(&self) -> [f64; D] {
        std::array::from_fn(|i| self.numbers[100 + i])
    }
}

trait MapEntries {
    fn map_entries(self, f: impl Fn(f64) -> f64) -> Self;
}

impl<const D: usize> MapEntries for Matrix<D> {
    fn map_entries(self, f: impl Fn(f64) -> f64) -> Self {
        Self::from_fn(|i, j| f(self.0[i][j]))
    }
}

/// The orthogonal factor of Gram–Schmidt on the rows, each orthogonalised twice.
pub fn orthogonal<const D: usize>(matrix: &Matrix<D>) -> Matrix<D> {
    let mut rows = (*matrix + 2.0 * Matrix::IDENTITY).0;
    for k in 0..D {
        for _ in 0..2 {
            for l in 0..k {
                let overlap = vector::dot(&rows[k], &rows[l]);
                rows[k] = vector::add_scaled(&rows[k], -overlap, &rows[l]);
            }
        }
        rows[k] = vector::scale(&rows[k], 1.0 / vector::norm(&rows[k]));
    }
    Matrix(rows)
}

/// ‖Qᵀ Q − I‖, zero for orthonormal columns.
pub fn orthogonality_error<const D: usize>(q: &Matrix<D>) -> f64 {
    (q.transpose() * *q - Matrix::IDENTITY).frobenius_norm()
}

/// ‖A − B‖ / ‖B‖, zero if both are zero.
pub fn relative_error<const D: usize>(a: &Matrix<D>, b: &Matrix<D>) -> f64 {
    let error = (*a - *b).frobenius_norm();
    if error == 0.0 { 0.0 } else { error / b.frobenius_norm() }
}

/// σ_max / σ_min, infinite for singular matrices.
pub fn condition<const D: usize>(matrix: &Matrix<D>) -> f64 {
    let values = SingularValues::new(matrix).expect("finite entries").values;
    values[0] / values[D - 1]
}

pub fn to_dense<const D: usize>(matrix: &Matrix<D>) -> DenseMatrix {
    DenseMatrix::from_fn(D, D, |i, j| matrix.0[i][j])
}
