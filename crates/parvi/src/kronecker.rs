//! The Kronecker sequence of the generalised golden ratio: where the grid's origin goes in every step.

/// Points u_n = frac(u_0 + n (φ⁻¹, φ⁻², …)), φ the positive root of φ^{K+1} = φ + 1; of low discrepancy in K dimensions
/// for every number of points (Roberts 2018, "The unreasonable effectiveness of quasirandom sequences").
#[derive(Clone, Debug)]
pub(crate) struct Kronecker<const K: usize> {
    start: [f64; K],
    step: [f64; K],
    count: u64,
}

impl<const K: usize> Kronecker<K> {
    /// A sequence that starts at `start`, a point of the unit cube.
    pub fn new(start: [f64; K]) -> Self {
        let mut phi = 2.0f64;
        for _ in 0..60 {
            phi = (1.0 + phi).powf(1.0 / (K as f64 + 1.0));
        }
        Self {
            start,
            step: std::array::from_fn(|a| phi.powi(-(a as i32) - 1)),
            count: 0,
        }
    }

    /// The next point of the sequence.
    pub fn next_point(&mut self) -> [f64; K] {
        self.count += 1;
        std::array::from_fn(|a| (self.start[a] + self.count as f64 * self.step[a]).fract())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn golden_ratio_in_one_dimension() {
        let mut sequence = Kronecker::new([0.0]);
        assert!((sequence.next_point()[0] - 0.618_033_988_749_894_9).abs() < 1e-14);
    }

    #[test]
    fn covers_the_cube_evenly() {
        let mut sequence = Kronecker::<3>::new([0.2, 0.5, 0.9]);
        let mut counts = [0; 8];
        for _ in 0..800 {
            let u = sequence.next_point();
            assert!(u.iter().all(|c| (0.0..1.0).contains(c)));
            counts[(0..3).fold(0, |index, a| 2 * index + (u[a] >= 0.5) as usize)] += 1;
        }
        // Independent points would scatter by 9 in every octant; the largest of eight deviations would be about 16.
        assert!(counts.iter().all(|&count: &i32| (count - 100).abs() <= 8), "{counts:?}");
    }
}
