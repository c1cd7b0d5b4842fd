//! Products of the small matrices in a network.
//!
//! Every entry is one chain of fused products in a fixed order, so that a point has the same bits whatever stands beside it (a general
//! matrix product switches its order of summation with the shape). Lists of columns are unit × column and a multiple of [`LANES`] long.

use mpm_tensor::vector::multiply_add;

/// Entries that are worked on together.
pub(crate) const LANES: usize = 8;

/// A matrix of weights seen as (row, column), possibly transposed.
#[derive(Clone, Copy)]
pub(crate) struct Weights<'a> {
    entries: &'a [f64],
    rows: usize,
    columns: usize,
    row_stride: usize,
    column_stride: usize,
}

impl<'a> Weights<'a> {
    /// A row-major matrix.
    pub fn new(entries: &'a [f64], rows: usize, columns: usize) -> Self {
        Self {
            entries,
            rows,
            columns,
            row_stride: columns,
            column_stride: 1,
        }
    }

    pub fn transpose(self) -> Self {
        Self {
            rows: self.columns,
            columns: self.rows,
            row_stride: self.column_stride,
            column_stride: self.row_stride,
            ..self
        }
    }
}

/// Z_o = Σ_i W_oi A_i for the `length` entries of every unit.
pub(crate) fn multiply(z: &mut [f64], weights: Weights<'_>, a: &[f64], length: usize) {
    let (a, blocks) = (a.as_chunks::<LANES>().0, length / LANES);
    let z = z.as_chunks_mut::<LANES>().0;
    for block in 0..blocks {
        let mut row = 0;
        while row + 6 <= weights.rows {
            multiply_rows::<6>(z, weights, a, blocks, block, row);
            row += 6;
        }
        while row + 3 <= weights.rows {
            multiply_rows::<3>(z, weights, a, blocks, block, row);
            row += 3;
        }
        while row < weights.rows {
            multiply_rows::<1>(z, weights, a, blocks, block, row);
            row += 1;
        }
    }
}

#[inline(always)]
fn multiply_rows<const ROWS: usize>(
    z: &mut [[f64; LANES]],
    weights: Weights<'_>,
    a: &[[f64; LANES]],
    blocks: usize,
    block: usize,
    row: usize,
) {
    let mut sums = [[0.0; LANES]; ROWS];
    let starts: [usize; ROWS] = std::array::from_fn(|k| (row + k) * weights.row_stride);
    for i in 0..weights.columns {
        let a = &a[i * blocks + block];
        for k in 0..ROWS {
            let weight = weights.entries[starts[k] + i * weights.column_stride];
            for lane in 0..LANES {
                sums[k][lane] = multiply_add(a[lane], weight, sums[k][lane]);
            }
        }
    }
    for (k, sum) in sums.into_iter().enumerate() {
        z[(row + k) * blocks + block] = sum;
    }
}

/// Lanes of a scalar product; two registers' worth would not leave room for 3 × 3 of them.
const HALF: usize = 4;

/// G_oi += Z_o · A_i, a row-major matrix of as many rows as there are units in `z`.
pub(crate) fn add_products(g: &mut [f64], z: &[f64], a: &[f64], length: usize) {
    let (z, a, blocks) = (z.as_chunks::<HALF>().0, a.as_chunks::<HALF>().0, length / HALF);
    let (rows, columns) = (z.len() / blocks.max(1), a.len() / blocks.max(1));
    let mut row = 0;
    while row < rows {
        let tall = row + 3 <= rows;
        let mut column = 0;
        while column < columns {
            let wide = column + 3 <= columns;
            let at = [row, column, columns, blocks];
            match (tall, wide) {
                (true, true) => add_block::<3, 3>(g, z, a, at),
                (true, false) => add_block::<3, 1>(g, z, a, at),
                (false, true) => add_block::<1, 3>(g, z, a, at),
                (false, false) => add_block::<1, 1>(g, z, a, at),
            }
            column += if wide { 3 } else { 1 };
        }
        row += if tall { 3 } else { 1 };
    }
}

#[inline(always)]
fn add_block<const ROWS: usize, const COLUMNS: usize>(
    g: &mut [f64],
    z: &[[f64; HALF]],
    a: &[[f64; HALF]],
    [row, column, columns, blocks]: [usize; 4],
) {
    let mut sums = [[[0.0; HALF]; COLUMNS]; ROWS];
    let z: [&[[f64; HALF]]; ROWS] = std::array::from_fn(|k| &z[(row + k) * blocks..(row + k + 1) * blocks]);
    let a: [&[[f64; HALF]]; COLUMNS] = std::array::from_fn(|j| &a[(column + j) * blocks..(column + j + 1) * blocks]);
    for block in 0..blocks {
        for k in 0..ROWS {
            for j in 0..COLUMNS {
                for lane in 0..HALF {
                    sums[k][j][lane] = multiply_add(z[k][block][lane], a[j][block][lane], sums[k][j][lane]);
                }
            }
        }
    }
    for k in 0..ROWS {
        for j in 0..COLUMNS {
            let [s0, s1, s2, s3] = sums[k][j];
            g[(row + k) * columns + column + j] += (s0 + s1) + (s2 + s3);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn list(length: usize, seed: f64) -> Vec<f64> {
        (0..length).map(|n| (seed * (n + 1) as f64).sin()).collect()
    }

    #[test]
    fn products_are_those_of_the_formulas() {
        for (rows, columns, length) in [(30, 30, 40), (3, 30, 16), (5, 4, 8), (1, 7, 24), (8, 2, 8)] {
            let (weights, a, z) = (
                list(rows * columns, 0.7),
                list(columns * length, 1.3),
                list(rows * length, 2.1),
            );
            let mut product = vec![f64::NAN; rows * length];
            multiply(&mut product, Weights::new(&weights, rows, columns), &a, length);
            let mut adjoint = vec![f64::NAN; columns * length];
            multiply(
                &mut adjoint,
                Weights::new(&weights, rows, columns).transpose(),
                &z,
                length,
            );
            let mut outer = list(rows * columns, 0.3);
            add_products(&mut outer, &z, &a, length);
            let close = |found: f64, expected: f64| assert!((found - expected).abs() < 1e-13, "{found} {expected}");
            for p in 0..length {
                for o in 0..rows {
                    let sum: f64 = (0..columns).map(|i| weights[o * columns + i] * a[i * length + p]).sum();
                    close(product[o * length + p], sum);
                }
                for i in 0..columns {
                    let sum: f64 = (0..rows).map(|o| weights[o * columns + i] * z[o * length + p]).sum();
                    close(adjoint[i * length + p], sum);
                }
            }
            let before = list(rows * columns, 0.3);
            for o in 0..rows {
                for i in 0..columns {
                    let sum: f64 = (0..length).map(|p| z[o * length + p] * a[i * length + p]).sum();
                    close(outer[o * columns + i], before[o * columns + i] + sum);
                }
            }
        }
    }
}
