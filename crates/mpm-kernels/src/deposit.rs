//! What a particle leaves at a node.

use mpm_tensor::vector::multiply_add;

/// A scalar and a vector that travel from particles to nodes together: mass and momentum.
///
/// They lie side by side in memory, so that both are worked on by the same instruction.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Deposit<const D: usize> {
    /// The scalar.
    pub scalar: f64,
    /// The vector.
    pub vector: [f64; D],
}

impl<const D: usize> Deposit<D> {
    /// Nothing.
    pub const ZERO: Self = Self {
        scalar: 0.0,
        vector: [0.0; D],
    };

    /// `weight` `self` + `scale` `other`.
    #[inline(always)]
    pub fn combine(&self, weight: f64, other: &Self, scale: f64) -> Self {
        let mut sum = Self {
            scalar: multiply_add(weight, self.scalar, scale * other.scalar),
            vector: [0.0; D],
        };
        for a in 0..D {
            sum.vector[a] = multiply_add(weight, self.vector[a], scale * other.vector[a]);
        }
        sum
    }

    /// `self` − `other`.
    #[inline(always)]
    pub fn minus(&self, other: &Self) -> Self {
        let mut difference = *self;
        difference.scalar -= other.scalar;
        for a in 0..D {
            difference.vector[a] -= other.vector[a];
        }
        difference
    }

    /// `self` ← `self` + `other`.
    #[inline(always)]
    pub fn add(&mut self, other: &Self) {
        self.scalar += other.scalar;
        for a in 0..D {
            self.vector[a] += other.vector[a];
        }
    }
}

impl<const D: usize> Default for Deposit<D> {
    fn default() -> Self {
        Self::ZERO
    }
}
