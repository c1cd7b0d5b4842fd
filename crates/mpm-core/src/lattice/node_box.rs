//! The box of integer coordinates that a cloud's nodes lie in.

use mpm_kernels::{LANES, Lanes, SimplexGeometry, groups};

/// Lattice coordinates beyond ±2³⁰ are refused.
const COORDINATE_LIMIT: f64 = (1u64 << 30) as f64;

/// Particles of one piece of work.
const CHUNK: usize = 1 << 13;

/// All integer points between the lowest base and the highest top of the simplices of a cloud, counted with the last axis
/// fastest. Numbers are kept as `f64`: exact up to 2⁵³, and without an upper end where nobody asks for exactness.
#[derive(Clone, Copy, Debug)]
pub struct NodeBox<const D: usize> {
    low: [f64; D],
    extents: [f64; D],
    /// Distance, in places, between neighbours along an axis.
    pub strides: [f64; D],
}

impl<const D: usize> Default for NodeBox<D> {
    fn default() -> Self {
        Self {
            low: [0.0; D],
            extents: [0.0; D],
            strides: [0.0; D],
        }
    }
}

impl<const D: usize> NodeBox<D> {
    /// The box of a cloud, or the first particle whose coordinates are out of range.
    pub fn around(positions: &[[f64; D]], geometry: &SimplexGeometry<D>) -> Result<Self, usize> {
        if positions.is_empty() {
            return Ok(Self::default());
        }
        let chunk = |xs: &[[f64; D]]| {
            let mut range = Range::NONE;
            groups(xs).for_each(|group| range.include(&geometry.coordinates(&group)));
            range
        };
        let ranges = mpm_parallel::map(positions.chunks(CHUNK), &chunk);
        let range = ranges.into_iter().fold(Range::NONE, Range::with);
        let Some((low, high)) = range.ends() else {
            let inside = |x: &[f64; D]| {
                let u = geometry.coordinates(&[*x; LANES]);
                u.iter().all(|&u| first(u).abs() < COORDINATE_LIMIT)
            };
            return Err(positions.iter().position(|x| !inside(x)).unwrap_or(0));
        };
        let low = geometry.bases(&low.map(Lanes::splat)).map(first);
        let high = geometry.bases(&high.map(Lanes::splat)).map(first);
        let extents = std::array::from_fn(|a| high[a] - low[a] + 2.0);
        let mut strides = [1.0; D];
        for a in (0..D - 1).rev() {
            strides[a] = strides[a + 1] * extents[a + 1];
        }
        Ok(Self { low, extents, strides })
    }

    /// Number of points in the box.
    pub fn size(&self) -> f64 {
        self.strides[0] * self.extents[0]
    }

    /// Places of integer points side by side, `nodes[axis]`.
    #[inline(always)]
    pub fn places(&self, nodes: &[Lanes; D]) -> Lanes {
        let mut places = Lanes::ZERO;
        for a in 0..D {
            places = (nodes[a] - self.low[a]).mul_add(Lanes::splat(self.strides[a]), places);
        }
        places
    }

    /// The integer point at a place.
    pub fn node(&self, place: u64) -> [f64; D] {
        let mut rest = place;
        let mut node = self.low;
        for a in (0..D).rev() {
            let extent = self.extents[a] as u64;
            node[a] += (rest % extent) as f64;
            rest /= extent;
        }
        node
    }
}

/// Of points side by side, the first.
fn first(lanes: Lanes) -> f64 {
    lanes.to_array()[0]
}

/// Least and largest lattice coordinates.
#[derive(Clone, Copy)]
struct Range<const D: usize> {
    low: [Lanes; D],
    high: [Lanes; D],
    /// Zero, or NaN once a coordinate was not finite.
    fault: Lanes,
}

impl<const D: usize> Range<D> {
    const NONE: Self = Self {
        low: [Lanes::splat(f64::INFINITY); D],
        high: [Lanes::splat(f64::NEG_INFINITY); D],
        fault: Lanes::ZERO,
    };

    #[inline(always)]
    fn include(&mut self, u: &[Lanes; D]) {
        for a in 0..D {
            self.low[a] = u[a].fast_min(self.low[a]);
            self.high[a] = u[a].fast_max(self.high[a]);
            self.fault = u[a].mul_add(Lanes::ZERO, self.fault);
        }
    }

    fn with(mut self, other: Self) -> Self {
        for a in 0..D {
            self.low[a] = self.low[a].fast_min(other.low[a]);
            self.high[a] = self.high[a].fast_max(other.high[a]);
        }
        self.fault += other.fault;
        self
    }

    /// The ends per axis; `None` where coordinates are out of range.
    fn ends(&self) -> Option<([f64; D], [f64; D])> {
        let low = self
            .low
            .map(|row| row.to_array().into_iter().fold(f64::INFINITY, f64::min));
        let high = self
            .high
            .map(|row| row.to_array().into_iter().fold(f64::NEG_INFINITY, f64::max));
        let sound = (0..D).all(|a| low[a] > -COORDINATE_LIMIT && high[a] < COORDINATE_LIMIT);
        (sound && self.fault.reduce_add() == 0.0).then_some((low, high))
    }
}
