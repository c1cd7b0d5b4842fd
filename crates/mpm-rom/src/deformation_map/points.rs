//! Material points with what the map needs of them at rest.

use mpm_tensor::Matrix;

/// Reference positions and the parts of g that do not depend on x̂, one entry per point in every list.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MaterialPoints<const D: usize> {
    /// X_p, relative to the centroid at rest.
    pub reference: Vec<[f64; D]>,
    /// a(X_p).
    pub offsets: Vec<[f64; D]>,
    /// I − ∇g̃(X_p, x̂₀).
    pub gradient_offsets: Vec<Matrix<D>>,
}

impl<const D: usize> MaterialPoints<D> {
    /// The points of `all` with these numbers, in this order; numbers that there are not are left out.
    pub fn select(&mut self, all: &Self, numbers: &[u32]) {
        choose(&mut self.reference, &all.reference, numbers);
        choose(&mut self.offsets, &all.offsets, numbers);
        choose(&mut self.gradient_offsets, &all.gradient_offsets, numbers);
    }
}

fn choose<T: Copy>(out: &mut Vec<T>, all: &[T], numbers: &[u32]) {
    out.clear();
    out.extend(numbers.iter().filter_map(|&number| all.get(number as usize)));
}
