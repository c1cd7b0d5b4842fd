//! Vertices by the box of a regular grid that they lie in.

use crate::adjacency::Lists;

/// A grid over the vertices with about one of them per bin.
pub struct Bins<const D: usize> {
    lower: [f64; D],
    /// Bins per unit of length, by axis.
    density: [f64; D],
    /// Bins by axis.
    counts: [usize; D],
    vertices: Lists,
}

impl<const D: usize> Bins<D> {
    pub fn new(positions: &[[f64; D]]) -> Self {
        let fold = |start: f64, choose: fn(f64, f64) -> f64| -> [f64; D] {
            std::array::from_fn(|axis| positions.iter().fold(start, |bound, x| choose(bound, x[axis])))
        };
        let (lower, upper) = (fold(f64::INFINITY, f64::min), fold(f64::NEG_INFINITY, f64::max));
        let extents: [f64; D] = std::array::from_fn(|axis| upper[axis] - lower[axis]);
        let longest = extents.iter().fold(0f64, |a, &b| a.max(b));
        // Relative to the longest, so that the product of the extents neither overflows nor vanishes.
        let measure: f64 = extents.iter().map(|extent| (extent / longest).max(1e-9)).product();
        let width = longest * (measure / positions.len() as f64).powf(1.0 / D as f64);
        let mut counts = extents.map(|extent| ((extent / width) as usize).clamp(1, positions.len()));
        // A mesh far thinner than it is long would have more bins than vertices.
        while counts.iter().map(|&count| count as f64).product::<f64>() > 4.0 * positions.len() as f64 {
            counts = counts.map(|count| count.div_ceil(2));
        }
        let density = std::array::from_fn(|axis| {
            let density = counts[axis] as f64 / extents[axis];
            if density.is_finite() { density } else { 0.0 }
        });
        let mut bins = Self {
            lower,
            density,
            counts,
            vertices: Lists::default(),
        };
        let places: Vec<usize> = positions.iter().map(|x| bins.number(&bins.bin(x))).collect();
        bins.vertices = Lists::from_pairs(counts.iter().product(), (0u32..).zip(&places).map(|(v, &bin)| (bin, v)));
        bins
    }

    /// Calls `visit` with the vertices in the bins that meet the box from `lower` to `upper`.
    pub fn for_each_near(&self, lower: &[f64; D], upper: &[f64; D], mut visit: impl FnMut(u32)) {
        let (first, last) = (self.bin(lower), self.bin(upper));
        let mut bin = first;
        loop {
            self.vertices.get(self.number(&bin)).iter().for_each(|&v| visit(v));
            // The next bin, the last axis fastest.
            let Some(axis) = (0..D).rev().find(|&axis| bin[axis] < last[axis]) else {
                return;
            };
            bin[axis] += 1;
            bin[axis + 1..].copy_from_slice(&first[axis + 1..]);
        }
    }

    fn bin(&self, x: &[f64; D]) -> [usize; D] {
        std::array::from_fn(|axis| {
            let place = (x[axis] - self.lower[axis]) * self.density[axis];
            (place.max(0.0) as usize).min(self.counts[axis] - 1)
        })
    }

    fn number(&self, bin: &[usize; D]) -> usize {
        bin.iter()
            .zip(&self.counts)
            .fold(0, |number, (place, count)| number * count + place)
    }
}
