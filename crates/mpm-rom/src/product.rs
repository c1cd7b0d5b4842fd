//! Products of the small matrices in a network.
//!
//! Every entry is one chain of fused products in a fixed order, so that a point has the same bits whatever stands beside it (a general
//! matrix product switches its order of summation with the shape). Lists of columns are unit × column and a multiple of [`LANES`] long.

use wide::f64x4;

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

    /// The entries of `ROWS` rows from `row` on, column after column.
    fn pack<const ROWS: usize>(&self, row: usize) -> Vec<[f64; ROWS]> {
        let entry = |k: usize, i: usize| self.entries[(row + k) * self.row_stride + i * self.column_stride];
        (0..self.columns)
            .map(|i| std::array::from_fn(|k| entry(k, i)))
            .collect()
    }
}

/// Rows whose sums fit into the registers: 6 × 2 of 16.
const TALL: usize = 6;

/// Z_o = Σ_i W_oi A_i for the `length` entries of every unit.
pub(crate) fn multiply(z: &mut [f64], weights: Weights<'_>, a: &[f64], length: usize) {
    let (a, blocks) = (a.as_chunks::<LANES>().0, length / LANES);
    let z = z.as_chunks_mut::<LANES>().0;
    let tall: Vec<_> = (0..weights.rows / TALL)
        .map(|n| weights.pack::<TALL>(n * TALL))
        .collect();
    let low: Vec<_> = (tall.len() * TALL..weights.rows)
        .map(|row| weights.pack::<1>(row))
        .collect();
    // Block by block, because its columns then stay in the first-level cache for all rows.
    for block in 0..blocks {
        for (n, rows) in tall.iter().enumerate() {
            multiply_rows(z, rows, a, blocks, block, n * TALL);
        }
        for (n, rows) in low.iter().enumerate() {
            multiply_rows(z, rows, a, blocks, block, tall.len() * TALL + n);
        }
    }
}

#[inline(always)]
fn multiply_rows<const ROWS: usize>(
    z: &mut [[f64; LANES]],
    rows: &[[f64; ROWS]],
    a: &[[f64; LANES]],
    blocks: usize,
    block: usize,
    row: usize,
) {
    let mut sums = [[f64x4::ZERO; 2]; ROWS];
    for (i, weights) in rows.iter().enumerate() {
        let [a0, a1, a2, a3, a4, a5, a6, a7] = a[i * blocks + block];
        let (lower, upper) = (f64x4::new([a0, a1, a2, a3]), f64x4::new([a4, a5, a6, a7]));
        for k in 0..ROWS {
            let weight = f64x4::splat(weights[k]);
            sums[k][0] = lower.mul_add(weight, sums[k][0]);
            sums[k][1] = upper.mul_add(weight, sums[k][1]);
        }
    }
    for (k, [lower, upper]) in sums.into_iter().enumerate() {
        let (s, t) = (lower.to_array(), upper.to_array());
        z[(row + k) * blocks + block] = [s[0], s[1], s[2], s[3], t[0], t[1], t[2], t[3]];
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
    let mut sums = [[f64x4::ZERO; COLUMNS]; ROWS];
    let z: [&[[f64; HALF]]; ROWS] = std::array::from_fn(|k| &z[(row + k) * blocks..(row + k + 1) * blocks]);
    let a: [&[[f64; HALF]]; COLUMNS] = std::array::from_fn(|j| &a[(column + j) * blocks..(column + j + 1) * blocks]);
    for block in 0..blocks {
        let a: [f64x4; COLUMNS] = std::array::from_fn(|j| f64x4::new(a[j][block]));
        for k in 0..ROWS {
            let z = f64x4::new(z[k][block]);
            for j in 0..COLUMNS {
                sums[k][j] = z.mul_add(a[j], sums[k][j]);
            }
        }
    }
    for k in 0..ROWS {
        for j in 0..COLUMNS {
            let [s0, s1, s2, s3] = sums[k][j].to_array();
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
