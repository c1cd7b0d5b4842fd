//! The stencil of a particle by its rows along the last axis.

use mpm_kernels::{Cubic, Entry, Linear, Quadratic, Row, Spline, UniformGrid};
use mpm_tensor::Matrix;
use mpm_tensor::vector::multiply_add;

use super::degree::SplineDegree;
use crate::basis::add_scaled;

/// Nodes per axis of the widest spline.
const WIDEST: usize = 4;

/// What a particle knows along every axis.
pub(super) struct Rows<const D: usize> {
    pub weights: [[f64; WIDEST]; D],
    /// Per unit of length.
    pub derivatives: [[f64; WIDEST]; D],
    /// Positions of the first nodes less that of the particle.
    pub offsets: [f64; D],
    width: usize,
    h: f64,
}

impl<const D: usize> Rows<D> {
    /// Those of a particle at x.
    pub fn of(degree: SplineDegree, nodes: &UniformGrid<D>, x: &[f64; D]) -> Self {
        let h = nodes.spacing();
        let mut rows = Self {
            weights: [[0.0; WIDEST]; D],
            derivatives: [[0.0; WIDEST]; D],
            offsets: [0.0; D],
            width: degree.width(),
            h,
        };
        for a in 0..D {
            let u = nodes.coordinate(x, a);
            let base = match degree {
                SplineDegree::Linear => rows.take(a, &Linear.row(u)),
                SplineDegree::Quadratic => rows.take(a, &Quadratic.row(u)),
                SplineDegree::Cubic => rows.take(a, &Cubic.row(u)),
            };
            rows.offsets[a] = h * (base as f64 - u);
        }
        rows
    }

    /// Take over the row along an axis; returns its first node.
    fn take<const W: usize>(&mut self, axis: usize, row: &Row<W>) -> i64 {
        for j in 0..W {
            self.weights[axis][j] = row.weights[j];
            self.derivatives[axis][j] = row.derivatives[j] / self.h;
        }
        row.base
    }

    /// Visit the rows: the place of the first node, and Π_a N_a, its gradient and the offset over the other axes, by products over the leading ones, of which only those that changed
    /// are taken again.
    #[inline(always)]
    pub fn for_each(&self, mut visit: impl FnMut(usize, &Entry<D>)) {
        let one = Entry {
            weight: 1.0,
            gradient: [0.0; D],
            offset: [0.0; D],
        };
        // The first level is that of no axis.
        let (mut levels, mut place, mut changed) = ([one; D], [0; D], 0);
        for row in 0..self.width.pow(D as u32 - 1) {
            for a in changed..D - 1 {
                let j = place[a] as usize;
                let (weight, derivative) = (self.weights[a][j], self.derivatives[a][j]);
                let mut entry = levels[a];
                for b in 0..a {
                    entry.gradient[b] *= weight;
                }
                entry.gradient[a] = entry.weight * derivative;
                entry.weight *= weight;
                entry.offset[a] = self.offsets[a] + self.h * f64::from(place[a]);
                levels[a + 1] = entry;
            }
            visit(row * self.width, &levels[D - 1]);
            changed = advance(&mut place[..D - 1], self.width as i32);
        }
    }
}

/// The next place of a stencil, the last axis fastest; returns the first axis that changed.
pub(super) fn advance(place: &mut [i32], width: i32) -> usize {
    for a in (0..place.len()).rev() {
        place[a] += 1;
        if place[a] < width {
            return a;
        }
        place[a] = 0;
    }
    0
}

/// `sum` ← `sum` + `scale` `column`, if there is one.
#[inline(always)]
pub(super) fn add_column<const D: usize>(sum: &mut [f64; D], scale: f64, column: Option<[f64; D]>) {
    if let Some(column) = column {
        add_scaled(sum, scale, &column);
    }
}

/// Σ v gᵀ over the nodes of a row: `value` gᵀ but for the last column.
#[inline(always)]
pub(super) fn add_row<const D: usize>(sum: &mut Matrix<D>, value: &[f64; D], factors: &[f64; D], last: &[f64; D]) {
    for a in 0..D {
        for b in 0..D - 1 {
            sum.0[a][b] = multiply_add(value[a], factors[b], sum.0[a][b]);
        }
        sum.0[a][D - 1] += last[a];
    }
}
