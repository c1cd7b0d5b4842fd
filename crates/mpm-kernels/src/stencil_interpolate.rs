//! Nodes of a tensor-product stencil → particle.

use mpm_tensor::Matrix;
use mpm_tensor::vector::multiply_add;

use crate::lanes::Lanes;
use crate::packed::groups_of;
use crate::{Entry, NodeField, Packed, Stencil};

/// What of a nodal vector field v_i is asked for beside its value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Wanted {
    /// The gradient.
    pub gradient: bool,
    /// The gradient by moving least squares, Σ_i v_i w_ip (D_p⁻¹ (x_i − x_p))ᵀ, in the place of Σ_i v_i ∇w_ipᵀ.
    pub least_squares: bool,
    /// The first moment.
    pub moment: bool,
}

/// A nodal vector field v_i as a particle sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interpolated<const D: usize> {
    /// Σ_i w_ip v_i.
    pub value: [f64; D],
    /// Σ_i v_i ∇w_ipᵀ, or that by moving least squares; zero where it was not asked for.
    pub gradient: Matrix<D>,
    /// Σ_i w_ip v_i (x_i − x_p)ᵀ; zero where it was not asked for.
    pub moment: Matrix<D>,
}

impl<const D: usize> Interpolated<D> {
    /// Nothing.
    pub const ZERO: Self = Self {
        value: [0.0; D],
        gradient: Matrix::ZERO,
        moment: Matrix::ZERO,
    };

    /// Add what one node with the vector `v` contributes; `direction` is w_ip D_p⁻¹ (x_i − x_p).
    #[inline(always)]
    pub fn add(&mut self, wanted: Wanted, entry: &Entry<D>, direction: &[f64; D], v: &[f64; D]) {
        let slope = if wanted.least_squares {
            direction
        } else {
            &entry.gradient
        };
        for a in 0..D {
            self.value[a] = multiply_add(entry.weight, v[a], self.value[a]);
            for b in 0..D {
                if wanted.gradient {
                    self.gradient.0[a][b] = multiply_add(v[a], slope[b], self.gradient.0[a][b]);
                }
                if wanted.moment {
                    self.moment.0[a][b] = multiply_add(entry.weight * v[a], entry.offset[b], self.moment.0[a][b]);
                }
            }
        }
    }
}

impl<const W: usize, const D: usize> Stencil<W, D> {
    /// Σ_i w_ip v_i and what is `wanted` beside it; v_i is the vector of `nodes` at i, i counting as in [`for_each`](Self::for_each).
    ///
    /// Sum factorisation: along the last axis, W nodes become Σ N v, Σ N′ v and Σ N r v; along the axis before, W of those
    /// become Σ N (…) each, and Σ N′ and Σ N r of the first; and so on.
    #[inline(always)]
    pub fn interpolate(&self, wanted: Wanted, nodes: &impl NodeField<D>) -> Interpolated<D> {
        match const { groups_of(D) } {
            1 => self.interpolate_in::<1>(wanted, nodes),
            2 => self.interpolate_in::<2>(wanted, nodes),
            3 => self.interpolate_in::<3>(wanted, nodes),
            _ => self.interpolate_in::<4>(wanted, nodes),
        }
    }

    #[inline(always)]
    fn interpolate_in<const G: usize>(&self, wanted: Wanted, nodes: &impl NodeField<D>) -> Interpolated<D> {
        // By least squares the gradient is the moment times D_p⁻¹: one follows from the other.
        let both = wanted.gradient && wanted.moment && wanted.least_squares && self.second_moments().is_some();
        let wanted = Wanted {
            moment: wanted.moment && !both,
            ..wanted
        };
        let (layout, mut total) = (self.layout, Level::<G, D>::ZERO);
        let nodes = &nodes.window(layout.first(), layout.span());
        match D {
            1 => total = self.row(wanted, 0, nodes),
            2 => {
                for i in 0..W {
                    let row = self.row(wanted, i * layout.stride(0), nodes);
                    total.take(wanted, 0, &row, self.factors(wanted, 0, i));
                }
            }
            3 => total = self.cube(wanted, nodes),
            _ => {
                let mut levels = [Level::ZERO; D];
                for row in 0..W.pow(D as u32 - 1) {
                    let first = self.row_place(row);
                    let (mut sum, mut rest) = (self.row(wanted, first, nodes), row);
                    for axis in (0..D - 1).rev() {
                        levels[axis].take(wanted, axis, &sum, self.factors(wanted, axis, rest % W));
                        if rest % W < W - 1 {
                            break;
                        }
                        sum = std::mem::replace(&mut levels[axis], Level::ZERO);
                        rest /= W;
                    }
                    total = sum;
                }
            }
        }
        let gradient = Packed::matrix(&total.slopes);
        Interpolated {
            value: total.value.deposit::<D>().vector,
            gradient,
            moment: match self.second_moments() {
                Some(moments) if both => Matrix::from_fn(|i, j| gradient.0[i][j] * moments[j]),
                _ => Packed::matrix(&total.moments),
            },
        }
    }
}

impl<const W: usize, const D: usize> Stencil<W, D> {
    /// The sum over all nodes for D = 3, written out: arrays of sums would stay in memory.
    #[inline(always)]
    fn cube<const G: usize>(&self, wanted: Wanted, nodes: &impl NodeField<D>) -> Level<G, D> {
        let zero = Packed::<G>::ZERO;
        let (mut value, mut slope_0, mut slope_1, mut slope_2) = (zero, zero, zero, zero);
        let (mut moment_0, mut moment_1, mut moment_2) = (zero, zero, zero);
        for i in 0..W {
            let (mut plane, mut plane_slope_1, mut plane_slope_2) = (zero, zero, zero);
            let (mut plane_moment_1, mut plane_moment_2) = (zero, zero);
            for j in 0..W {
                let (mut row, mut row_slope, mut row_moment) = (zero, zero, zero);
                for k in 0..W {
                    let v = nodes.packed::<G>(i * self.layout.stride(0) + j * self.layout.stride(1) + k);
                    let [weight, slope, moment] = self.factors(wanted, 2, k);
                    row = row.plus(weight, &v);
                    row_slope = row_slope.plus(slope, &v);
                    row_moment = row_moment.plus(moment, &v);
                }
                let [weight, slope, moment] = self.factors(wanted, 1, j);
                plane = plane.plus(weight, &row);
                plane_slope_1 = plane_slope_1.plus(slope, &row);
                plane_slope_2 = plane_slope_2.plus(weight, &row_slope);
                plane_moment_1 = plane_moment_1.plus(moment, &row);
                plane_moment_2 = plane_moment_2.plus(weight, &row_moment);
            }
            let [weight, slope, moment] = self.factors(wanted, 0, i);
            value = value.plus(weight, &plane);
            slope_0 = slope_0.plus(slope, &plane);
            slope_1 = slope_1.plus(weight, &plane_slope_1);
            slope_2 = slope_2.plus(weight, &plane_slope_2);
            moment_0 = moment_0.plus(moment, &plane);
            moment_1 = moment_1.plus(weight, &plane_moment_1);
            moment_2 = moment_2.plus(weight, &plane_moment_2);
        }
        let mut total = Level::ZERO;
        total.value = value;
        if wanted.gradient {
            (total.slopes[0], total.slopes[1], total.slopes[2]) = (slope_0, slope_1, slope_2);
        }
        if wanted.moment {
            (total.moments[0], total.moments[1], total.moments[2]) = (moment_0, moment_1, moment_2);
        }
        total
    }

    /// Place of the first node of a row along the last axis, from that of the stencil; rows count with the last but one axis fastest.
    #[inline(always)]
    fn row_place(&self, mut row: usize) -> usize {
        let mut place = 0;
        for axis in (0..D - 1).rev() {
            place += row % W * self.layout.stride(axis);
            row /= W;
        }
        place
    }

    /// The sum over W nodes along the last axis.
    #[inline(always)]
    fn row<const G: usize>(&self, wanted: Wanted, first: usize, nodes: &impl NodeField<D>) -> Level<G, D> {
        let last = D - 1;
        let mut level = Level::ZERO;
        for k in 0..W {
            let v = nodes.packed::<G>(first + k);
            let [weight, slope, moment] = self.factors(wanted, last, k);
            level.value = level.value.plus(weight, &v);
            if wanted.gradient {
                level.slopes[last] = level.slopes[last].plus(slope, &v);
            }
            if wanted.moment {
                level.moments[last] = level.moments[last].plus(moment, &v);
            }
        }
        level
    }

    /// Of node j in a row along `axis`: N, the factor of a slope, and N r.
    #[inline(always)]
    fn factors(&self, wanted: Wanted, axis: usize, j: usize) -> [Lanes; 3] {
        let axis = &self.axes[axis];
        let slope = if wanted.least_squares {
            axis.directions[j]
        } else {
            axis.derivatives[j]
        };
        [
            Lanes::splat(axis.weights[j]),
            Lanes::splat(slope),
            Lanes::splat(axis.first_moments[j]),
        ]
    }
}

/// Sums over all axes from one on, matrices by columns.
#[derive(Clone, Copy)]
struct Level<const G: usize, const D: usize> {
    value: Packed<G>,
    slopes: [Packed<G>; D],
    moments: [Packed<G>; D],
}

impl<const G: usize, const D: usize> Level<G, D> {
    const ZERO: Self = Self {
        value: Packed::ZERO,
        slopes: [Packed::ZERO; D],
        moments: [Packed::ZERO; D],
    };

    /// Add what the axes behind `axis` gave, taken over to `axis` with these factors.
    #[inline(always)]
    fn take(&mut self, wanted: Wanted, axis: usize, behind: &Self, [weight, slope, moment]: [Lanes; 3]) {
        self.value = self.value.plus(weight, &behind.value);
        if wanted.gradient {
            self.slopes[axis] = self.slopes[axis].plus(slope, &behind.value);
        }
        if wanted.moment {
            self.moments[axis] = self.moments[axis].plus(moment, &behind.value);
        }
        for b in 0..D {
            if b > axis && wanted.gradient {
                self.slopes[b] = self.slopes[b].plus(weight, &behind.slopes[b]);
            }
            if b > axis && wanted.moment {
                self.moments[b] = self.moments[b].plus(weight, &behind.moments[b]);
            }
        }
    }
}
