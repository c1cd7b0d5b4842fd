//! Points drawn from a pool.

use parvi_pool::Pool;

/// So many points, of equal shares of the weights.
pub(crate) fn drawn<const D: usize>(pool: &Pool<D>, count: usize, offset: f64) -> Vec<[f64; D]> {
    let indices = drawn_indices(pool, count, offset);
    indices.into_iter().map(|index| pool.positions[index]).collect()
}

/// The same by their places in the pool.
pub(crate) fn drawn_indices<const D: usize>(pool: &Pool<D>, count: usize, offset: f64) -> Vec<usize> {
    let mut sum = 0.0;
    let mut indices = Vec::with_capacity(count);
    for (index, weight) in pool.weights.iter().enumerate() {
        sum += weight;
        while indices.len() < count && sum * count as f64 > indices.len() as f64 + offset {
            indices.push(index);
        }
    }
    indices
}
