//! What a stencil knows along each of four axes side by side.

use crate::lanes::Lanes;
use crate::{SecondMoment, Spline};

/// One row of `W` nodes along each of four axes, one axis per lane.
pub(crate) struct AxisGroup<const W: usize> {
    /// First node.
    pub base: Lanes,
    /// N.
    pub weights: [Lanes; W],
    /// N′ / h.
    pub derivatives: [Lanes; W],
    /// r = x_i − x_p along the axis.
    pub offsets: [Lanes; W],
    /// N r.
    pub first_moments: [Lanes; W],
    /// N r / m, m the second moment; N′ / h for [`SecondMoment::Gradient`].
    pub directions: [Lanes; W],
    /// m = Σ N r².
    pub second_moments: Lanes,
}

impl<const W: usize> AxisGroup<W> {
    /// The rows touched from the grid coordinates `u` on a grid of spacing h.
    #[inline(always)]
    pub fn new<S: Spline<W>>(kernel: &S, u: Lanes, h: f64, inverse_h: f64) -> Self {
        let rows = kernel.rows(u);
        let first = rows.base - u;
        let zero = [Lanes::ZERO; W];
        let (mut offsets, mut first_moments, mut derivatives, mut directions) = (zero, zero, zero, zero);
        for j in 0..W {
            offsets[j] = (first + j as f64) * h;
            first_moments[j] = rows.weights[j] * offsets[j];
            derivatives[j] = rows.derivatives[j] * inverse_h;
        }
        let second_moments = match S::SECOND_MOMENT {
            SecondMoment::Constant(moment) => Lanes::splat(moment * h * h),
            _ => (0..W).fold(Lanes::ZERO, |sum, j| first_moments[j].mul_add(offsets[j], sum)),
        };
        for j in 0..W {
            directions[j] = match S::SECOND_MOMENT {
                SecondMoment::Gradient => derivatives[j],
                SecondMoment::Constant(moment) => first_moments[j] * (inverse_h * inverse_h / moment),
                SecondMoment::Varies => first_moments[j] / second_moments,
            };
        }
        Self {
            base: rows.base,
            weights: rows.weights,
            derivatives,
            offsets,
            first_moments,
            directions,
            second_moments,
        }
    }
}
