//! Quadratic splines on the 27 nodes of a cell that several particles share.

use mpm_tensor::Matrix;

use crate::lanes::Lanes;
use crate::spline::round;
use crate::{Interpolated, UniformGrid, Wanted};

/// Vectors at the nodes of a cell, the last axis fastest.
pub type CellLanes = [Lanes; 27];

/// How a particle sees the nodes of its cell, D = 3, in terms of *differences*: of every row v₀ v₁ v₂ along an axis, the cell has
/// e₀ = v₀ − v₁, v₁ and e₂ = v₂ − v₁, taken once for all its particles ([`differences`]).
///
/// With f = u − i₁ ∈ [−½, ½], a = ½ − f and b = ½ + f the weights are N₀ = a²/2, N₂ = b²/2 and N₁ = 1 − N₀ − N₂, so that
///
/// * Σ N v = v₁ + N₀ e₀ + N₂ e₂,
/// * h Σ N′ v = b e₂ − a e₀ (the slope),
/// * h² Σ N″ v = e₀ + e₂ (the curvature),
/// * Σ N r v = h/4 (slope + g curvature), g = 2 f a b, for the offsets r.
///
/// That is five products and sums per row, where weights, derivatives and first moments take nine, and no weights but N₀ and N₂ are
/// needed. Small weights keep their relative precision, which coefficients of polynomials would lose: a node of which a particle has hardly
/// entered the support, and whose velocity may be huge, comes with e₀ or e₂ and thus N₀ or N₂; the middle weight, nowhere computed, is at least ½.
///
/// The way back, from a particle to the sums of its cell, is the transposed of all this. It takes no fewer instructions than
/// [`Stencil::deposit`](crate::Stencil::deposit), where sums are read and written.
#[derive(Clone, Copy, Debug)]
pub struct CellStencil<const D: usize> {
    /// a, b, N₀, N₂ and g, one axis per lane.
    left: [f64; 4],
    right: [f64; 4],
    first: [f64; 4],
    last: [f64; 4],
    skew: [f64; 4],
    spacing: f64,
    inverse_spacing: f64,
}

impl<const D: usize> CellStencil<D> {
    /// The stencil of position `x` on `grid`; `None` unless D = 3.
    #[inline(always)]
    pub fn new(x: &[f64; D], grid: &UniformGrid<D>) -> Option<Self> {
        if D != 3 {
            return None;
        }
        let u = grid.coordinates(x, 0);
        let from_first = u - (round(u) - 1.0); // rounded as in `Spline::rows`
        let (left, right) = (1.5 - from_first, from_first - 0.5);
        Some(Self {
            left: left.to_array(),
            right: right.to_array(),
            first: (0.5 * left * left).to_array(),
            last: (0.5 * right * right).to_array(),
            skew: ((right - left) * left * right).to_array(),
            spacing: grid.spacing(),
            inverse_spacing: grid.inverse_spacing(),
        })
    }

    /// As [`Stencil::interpolate`](crate::Stencil::interpolate), from the [`differences`] of a cell.
    #[inline(always)]
    pub fn interpolate(&self, wanted: Wanted, differences: &CellLanes) -> Interpolated<D> {
        let zero = [Lanes::ZERO; 3];
        let (mut values, mut slopes_1, mut slopes_2) = (zero, zero, zero);
        let (mut curvatures_1, mut curvatures_2) = (zero, zero);
        for i in 0..3 {
            let (mut plane, mut slopes, mut curvatures) = (zero, zero, zero);
            for j in 0..3 {
                let first = 9 * i + 3 * j;
                let row = [differences[first], differences[first + 1], differences[first + 2]];
                (plane[j], slopes[j], curvatures[j]) = (self.value(2, &row), self.slope(2, &row), row[0] + row[2]);
            }
            (values[i], slopes_1[i], curvatures_1[i]) =
                (self.value(1, &plane), self.slope(1, &plane), plane[0] + plane[2]);
            (slopes_2[i], curvatures_2[i]) = (self.value(1, &slopes), self.value(1, &curvatures));
        }
        let slopes = [
            self.slope(0, &values),
            self.value(0, &slopes_1),
            self.value(0, &slopes_2),
        ];
        let curvatures = [
            values[0] + values[2],
            self.value(0, &curvatures_1),
            self.value(0, &curvatures_2),
        ];
        let mut skewed = slopes;
        for axis in 0..3 {
            skewed[axis] = curvatures[axis].mul_add(Lanes::splat(self.skew[axis]), slopes[axis]);
        }
        let mut seen = Interpolated::ZERO;
        seen.value = vector(self.value(0, &values));
        if wanted.gradient {
            let slopes = if wanted.least_squares { skewed } else { slopes };
            seen.gradient = from_columns(&slopes, self.inverse_spacing);
        }
        if wanted.moment {
            seen.moment = from_columns(&skewed, 0.25 * self.spacing);
        }
        seen
    }

    /// Σ N v.
    #[inline(always)]
    fn value(&self, axis: usize, differences: &[Lanes; 3]) -> Lanes {
        let (first, last) = (Lanes::splat(self.first[axis]), Lanes::splat(self.last[axis]));
        differences[2].mul_add(last, differences[0].mul_add(first, differences[1]))
    }

    /// h Σ N′ v.
    #[inline(always)]
    fn slope(&self, axis: usize, differences: &[Lanes; 3]) -> Lanes {
        let (left, right) = (Lanes::splat(self.left[axis]), Lanes::splat(self.right[axis]));
        differences[0].mul_neg_add(left, differences[2] * right)
    }
}

/// The vector of a deposit in lanes.
#[inline(always)]
fn vector<const D: usize>(lanes: Lanes) -> [f64; D] {
    let lanes = lanes.to_array();
    std::array::from_fn(|a| lanes[a + 1])
}

/// `scale` times the matrix whose columns are the vectors.
#[inline(always)]
fn from_columns<const D: usize>(columns: &[Lanes; 3], scale: f64) -> Matrix<D> {
    let mut matrix = Matrix::ZERO;
    for b in 0..D {
        let column = (columns[b] * scale).to_array();
        for a in 0..D {
            matrix.0[a][b] = column[a + 1];
        }
    }
    matrix
}

/// Nodal values of a cell ↦ their differences along all axes, in place.
pub fn differences(nodes: &mut CellLanes) {
    fn along<const STRIDE: usize>(nodes: &mut CellLanes) {
        for row in 0..9 {
            let first = row / STRIDE * STRIDE * 3 + row % STRIDE;
            let middle = nodes[first + STRIDE];
            nodes[first] -= middle;
            nodes[first + 2 * STRIDE] -= middle;
        }
    }
    along::<1>(nodes);
    along::<3>(nodes);
    along::<9>(nodes);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{NodeField, Packed, Quadratic, Stencil};

    /// One vector per node.
    struct Nodes(CellLanes);

    impl NodeField<3> for Nodes {
        fn vector(&self, index: usize) -> [f64; 3] {
            vector(self.0[index])
        }

        fn packed<const G: usize>(&self, index: usize) -> Packed<G> {
            Packed::read(&self.0[index..][..1])
        }
    }

    fn grid() -> UniformGrid<3> {
        UniformGrid::new([0.1, -0.2, 0.3], 0.7)
    }

    /// Positions all over a cell, its faces and corners among them.
    fn positions() -> impl Iterator<Item = [f64; 3]> {
        let along = [-0.5, -0.5 + 1e-9, -0.31, 0.0, 0.17, 0.42, 0.5 - 1e-9, 0.5 - 1e-16];
        (0..512).map(move |k| {
            let f = [along[k / 64], along[k / 8 % 8], along[k % 8]];
            std::array::from_fn(|a| grid().origin()[a] + 0.7 * (f[a] + 2.0 * a as f64))
        })
    }

    #[test]
    fn interpolation_is_that_of_the_stencil_also_where_nodes_with_tiny_weights_run_away() {
        for x in positions() {
            let stencil = Stencil::<3, 3>::new::<Quadratic>(&x, &grid());
            let cell = CellStencil::new(&x, &grid()).expect("three dimensions");
            let mut nodes = Nodes([Lanes::ZERO; 27]);
            stencil.for_each(|index, entry| {
                let size = 1.0 / entry.weight.sqrt().max(1e-150);
                let component = |a: usize| size * (((7 * index + 3 * a) % 11) as f64 - 5.0);
                nodes.0[index] = Lanes::new([f64::NAN, component(0), component(1), component(2)]);
            });
            let mut field = nodes.0;
            differences(&mut field);
            for bits in 0..8 {
                let wanted = Wanted {
                    gradient: bits & 1 != 0,
                    least_squares: bits & 2 != 0,
                    moment: bits & 4 != 0,
                };
                let (found, expected) = (cell.interpolate(wanted, &field), stencil.interpolate(wanted, &nodes));
                let scale = 1.0 + expected.gradient.maximum_norm() + expected.moment.maximum_norm();
                for a in 0..3 {
                    let error = (found.value[a] - expected.value[a]).abs();
                    assert!(error < 1e-12, "{x:?}: {found:?} for {expected:?}");
                }
                let error = (found.gradient - expected.gradient).maximum_norm();
                assert!(error < 1e-12 * scale, "{x:?}: {found:?} for {expected:?}");
                let error = (found.moment - expected.moment).maximum_norm();
                assert!(error < 1e-12 * scale, "{x:?}: {found:?} for {expected:?}");
            }
        }
    }
}
