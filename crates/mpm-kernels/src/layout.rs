//! Where the nodes of a stencil stand in an array of nodes.

/// The place of node j = (j_0, …, j_{D−1}) of a stencil: `first` + Σ_a j_a `strides`_a. The last axis is the fastest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout<const D: usize> {
    first: usize,
    strides: [usize; D],
    span: usize,
}

impl<const D: usize> Layout<D> {
    /// A stencil of `width` nodes along each axis whose first node is the first in a box of nodes, `edges` along each axis. To be evaluated at compile time, so that
    /// loops over a stencil unroll.
    pub const fn in_box(width: usize, edges: &[usize; D]) -> Self {
        let (mut strides, mut span, mut axis) = ([1; D], width, D - 1);
        while axis > 0 {
            strides[axis - 1] = strides[axis] * edges[axis];
            span += (width - 1) * strides[axis - 1];
            axis -= 1;
        }
        Self {
            first: 0,
            strides,
            span,
        }
    }

    /// The nodes of a stencil alone, `width` along each axis.
    pub const fn alone(width: usize) -> Self {
        Self::in_box(width, &[width; D])
    }

    /// The same steps from another first node.
    #[inline(always)]
    pub const fn from(self, first: usize) -> Self {
        Self { first, ..self }
    }

    /// Place of the first node.
    #[inline(always)]
    pub const fn first(&self) -> usize {
        self.first
    }

    /// How far the place moves with one node along `axis`.
    #[inline(always)]
    pub const fn stride(&self, axis: usize) -> usize {
        self.strides[axis]
    }

    /// Places from the first to the last node, both included.
    #[inline(always)]
    pub const fn span(&self) -> usize {
        self.span
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_count_the_nodes_of_a_box() {
        let layout = Layout::in_box(3, &[9, 4, 6]).from(5);
        assert_eq!([0, 1, 2].map(|axis| layout.stride(axis)), [24, 6, 1]);
        assert_eq!((layout.first(), layout.span()), (5, 2 * 24 + 2 * 6 + 2 + 1));
        assert_eq!(Layout::<4>::alone(3).span(), 81);
    }
}
