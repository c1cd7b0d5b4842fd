//! What is known of a spline by its degree.

use mpm_kernels::{Cubic, Linear, Quadratic, UniformGrid};

/// Which spline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SplineDegree {
    /// [`Linear`], two nodes per axis.
    Linear,
    /// [`Quadratic`], three.
    Quadratic,
    /// [`Cubic`], four.
    Cubic,
}

impl SplineDegree {
    /// Nodes per axis.
    pub(super) fn width(self) -> usize {
        match self {
            Self::Linear => 2,
            Self::Quadratic => 3,
            Self::Cubic => 4,
        }
    }

    /// D_p over h² I; `None` where ∇w_ip stands for w_ip D_p⁻¹ (x_i − x_p).
    pub(super) fn second_moment(self) -> Option<f64> {
        match self {
            Self::Linear => None,
            Self::Quadratic => Some(0.25),
            Self::Cubic => Some(1.0 / 3.0),
        }
    }

    /// The first node of the stencil of a particle at x.
    pub(super) fn first_node<const D: usize>(self, nodes: &UniformGrid<D>, x: &[f64; D]) -> Option<[i32; D]> {
        match self {
            Self::Linear => nodes.first_node::<Linear, 2>(x),
            Self::Quadratic => nodes.first_node::<Quadratic, 3>(x),
            Self::Cubic => nodes.first_node::<Cubic, 4>(x),
        }
    }
}
