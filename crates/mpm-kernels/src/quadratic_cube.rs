//! Quadratic splines on 27 nodes: the interpolation written for them.

use mpm_tensor::Matrix;

use crate::lanes::Lanes;
use crate::spline::round;
use crate::{Interpolated, Layout, NodeField, UniformGrid, Wanted};

/// How a particle sees the 27 nodes of its quadratic splines, D = 3.
///
/// With f = u − i₁ ∈ [−½, ½], a = ½ − f and b = ½ + f the weights along an axis are N₀ = a²/2, N₂ = b²/2 and N₁ = 1 − N₀ − N₂. So a row v₀ v₁ v₂ with
/// the differences e₀ = v₀ − v₁ and e₂ = v₂ − v₁ gives
///
/// * Σ N v = v₁ + N₀ e₀ + N₂ e₂,
/// * h Σ N′ v = b e₂ − a e₀ (the slope),
/// * h² Σ N″ v = e₀ + e₂ (the curvature),
/// * Σ N r v = h/4 (slope + g curvature), g = 2 f a b, for the offsets r.
///
/// Those are seven instructions per row, where weights, derivatives and first moments take nine, and five coefficients per axis instead of nine, which
/// have to be kept somewhere. Small weights keep their relative precision, which coefficients of polynomials in f would lose: a node of which a particle has hardly
/// entered the support, and whose velocity may be huge, comes with e₀ or e₂ and thus N₀ or N₂; the middle weight is at least ½.
///
/// The way back, from a particle to sums at nodes, is the transposed of this. It takes no fewer instructions than
/// [`Stencil::deposit`](crate::Stencil::deposit), where sums are read and written.
#[derive(Clone, Copy, Debug)]
pub struct QuadraticCube<const D: usize> {
    /// N₀, N₁ and N₂, one axis per lane.
    weights: [[f64; 4]; 3],
    /// a, b and g.
    left: [f64; 4],
    right: [f64; 4],
    skew: [f64; 4],
    spacing: f64,
    inverse_spacing: f64,
    layout: Layout<D>,
}

impl<const D: usize> QuadraticCube<D> {
    /// What position `x` sees on `grid`, of nodes that stand as `layout` says; `None` unless D = 3.
    #[inline(always)]
    pub fn new(x: &[f64; D], grid: &UniformGrid<D>, layout: Layout<D>) -> Option<Self> {
        if D != 3 {
            return None;
        }
        let u = grid.coordinates(x, 0);
        let from_first = u - (round(u) - 1.0); // rounded as in `Spline::rows`
        let (left, right) = (1.5 - from_first, from_first - 0.5);
        let (first, last) = (0.5 * left * left, 0.5 * right * right);
        Some(Self {
            weights: [first.to_array(), (1.0 - first - last).to_array(), last.to_array()],
            left: left.to_array(),
            right: right.to_array(),
            skew: ((right - left) * left * right).to_array(),
            spacing: grid.spacing(),
            inverse_spacing: grid.inverse_spacing(),
            layout,
        })
    }

    /// As [`Stencil::interpolate`](crate::Stencil::interpolate).
    #[inline(always)]
    pub fn interpolate(&self, wanted: Wanted, nodes: &impl NodeField<D>) -> Interpolated<D> {
        let nodes = &nodes.window(self.layout.first(), self.layout.span());
        let zero = [Lanes::ZERO; 3];
        let (mut values, mut slopes_1, mut slopes_2) = (zero, zero, zero);
        let (mut curvatures_1, mut curvatures_2) = (zero, zero);
        for i in 0..3 {
            let (mut plane, mut slopes, mut curvatures) = (zero, zero, zero);
            for j in 0..3 {
                let first = i * self.layout.stride(0) + j * self.layout.stride(1);
                let v = [nodes.lanes(first), nodes.lanes(first + 1), nodes.lanes(first + 2)];
                (plane[j], slopes[j], curvatures[j]) = self.row(2, &v);
            }
            (values[i], slopes_1[i], curvatures_1[i]) = self.row(1, &plane);
            (slopes_2[i], curvatures_2[i]) = (self.value(1, &slopes), self.value(1, &curvatures));
        }
        let (value, slope, curvature) = self.row(0, &values);
        let slopes = [slope, self.value(0, &slopes_1), self.value(0, &slopes_2)];
        let curvatures = [curvature, self.value(0, &curvatures_1), self.value(0, &curvatures_2)];
        let mut skewed = slopes;
        for axis in 0..3 {
            skewed[axis] = curvatures[axis].mul_add(Lanes::splat(self.skew[axis]), slopes[axis]);
        }
        let mut seen = Interpolated::ZERO;
        seen.value = vector(value);
        if wanted.gradient {
            let slopes = if wanted.least_squares { skewed } else { slopes };
            seen.gradient = from_columns(&slopes, self.inverse_spacing);
        }
        if wanted.moment {
            seen.moment = from_columns(&skewed, 0.25 * self.spacing);
        }
        seen
    }

    /// Σ N v, h Σ N′ v and h² Σ N″ v.
    #[inline(always)]
    fn row(&self, axis: usize, v: &[Lanes; 3]) -> (Lanes, Lanes, Lanes) {
        let (before, after) = (v[0] - v[1], v[2] - v[1]);
        let (first, last) = (Lanes::splat(self.weights[0][axis]), Lanes::splat(self.weights[2][axis]));
        let (left, right) = (Lanes::splat(self.left[axis]), Lanes::splat(self.right[axis]));
        (
            after.mul_add(last, before.mul_add(first, v[1])),
            before.mul_neg_add(left, after * right),
            before + after,
        )
    }

    /// Σ N v alone.
    #[inline(always)]
    fn value(&self, axis: usize, v: &[Lanes; 3]) -> Lanes {
        let weight = |j: usize| Lanes::splat(self.weights[j][axis]);
        v[2].mul_add(weight(2), v[1].mul_add(weight(1), v[0] * weight(0)))
    }
}

/// The vector of a deposit in lanes.
#[inline(always)]
fn vector<const D: usize>(lanes: Lanes) -> [f64; D] {
    let mut vector = [0.0; D];
    vector.copy_from_slice(&lanes.to_array()[1..=D]);
    vector
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Packed, Quadratic, Stencil};

    /// One vector per node.
    struct Nodes([Lanes; 27]);

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
            let cube = QuadraticCube::new(&x, &grid(), Layout::alone(3)).expect("three dimensions");
            let mut nodes = Nodes([Lanes::ZERO; 27]);
            stencil.for_each(|index, entry| {
                let size = 1.0 / entry.weight.sqrt().max(1e-150);
                let component = |a: usize| size * (((7 * index + 3 * a) % 11) as f64 - 5.0);
                nodes.0[index] = Lanes::new([f64::NAN, component(0), component(1), component(2)]);
            });
            for bits in 0..8 {
                let wanted = Wanted {
                    gradient: bits & 1 != 0,
                    least_squares: bits & 2 != 0,
                    moment: bits & 4 != 0,
                };
                let (found, expected) = (cube.interpolate(wanted, &nodes), stencil.interpolate(wanted, &nodes));
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
