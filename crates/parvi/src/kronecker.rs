//! The Kronecker sequence of the generalised golden ratio: where the lattice goes in every step, and how wide it is.

use rand::{Rng, RngExt};

/// Points u_n = frac(u_0 + n (φ⁻¹, φ⁻², …)) of the unit cube in D + 1 dimensions, φ the positive root of φ^{D+2} = φ + 1; of low
/// discrepancy for every number of points (Roberts 2018, "The unreasonable effectiveness of quasirandom sequences").
///
/// D coordinates are for the origin, the last one is for the spacing: one sequence, so that both together are even.
#[derive(Clone, Debug)]
pub(crate) struct Kronecker<const D: usize> {
    start: ([f64; D], f64),
    phi: f64,
    count: u64,
}

impl<const D: usize> Kronecker<D> {
    /// A sequence that starts at a random point.
    pub fn new(generator: &mut impl Rng) -> Self {
        let mut phi = 2.0f64;
        for _ in 0..60 {
            phi = (1.0 + phi).powf(1.0 / (D as f64 + 2.0));
        }
        Self {
            start: (std::array::from_fn(|_| generator.random()), generator.random()),
            phi,
            count: 0,
        }
    }

    /// The next point of the sequence: D coordinates and the last one.
    pub fn next_point(&mut self) -> ([f64; D], f64) {
        self.count += 1;
        let coordinate =
            |start: f64, axis: usize| (start + self.count as f64 * self.phi.powi(-(axis as i32) - 1)).fract();
        let origin = std::array::from_fn(|a| coordinate(self.start.0[a], a));
        (origin, coordinate(self.start.1, D))
    }
}

#[cfg(test)]
mod tests {
    use rand::{SeedableRng, rngs::ChaCha8Rng};

    use super::*;

    fn covers_the_cube_evenly<const D: usize>(largest_deviation: i32) {
        let mut sequence = Kronecker::<D>::new(&mut ChaCha8Rng::seed_from_u64(3));
        let (cells, per_cell) = (2 << D, 100);
        let mut counts = vec![0i32; cells];
        for _ in 0..cells * per_cell {
            let (u, last) = sequence.next_point();
            assert!(u.iter().all(|c| (0.0..1.0).contains(c)) && (0.0..1.0).contains(&last));
            let upper = u.iter().chain([&last]);
            counts[upper.fold(0, |index, &c| 2 * index + usize::from(c >= 0.5))] += 1;
        }
        let even = |&count: &i32| (count - 100).abs() <= largest_deviation;
        assert!(counts.iter().all(even), "{counts:?}");
    }

    /// Independent points would be off by 12, 15 and 20 in the worst cell. With four coordinates (D = 3) a near relation among them
    /// leaves the sequence no evener than that in halves, though it is in each coordinate.
    #[test]
    fn origins_and_spacings_together_cover_the_cube_evenly() {
        covers_the_cube_evenly::<1>(6);
        covers_the_cube_evenly::<2>(9);
        covers_the_cube_evenly::<3>(24);
    }
}
