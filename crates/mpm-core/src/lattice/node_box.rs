//! The box of integer coordinates that a cloud's nodes lie in.

use mpm_kernels::SimplexGeometry;
use rayon::prelude::*;

use super::lanes::{LANES, lanes};

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
            lanes(xs).for_each(|lanes| range.include(&geometry.coordinates(&lanes)));
            range
        };
        let range = positions
            .par_chunks(CHUNK)
            .map(chunk)
            .reduce(|| Range::NONE, Range::with);
        let Some((low, high)) = range.ends() else {
            let inside = |x: &[f64; D]| {
                geometry
                    .coordinates(&[*x])
                    .iter()
                    .all(|u| u[0].abs() < COORDINATE_LIMIT)
            };
            return Err(positions.iter().position(|x| !inside(x)).unwrap_or(0));
        };
        let ends = geometry.bases(&std::array::from_fn(|a| [low[a], high[a]]));
        let extents = ends.map(|[low, high]| high - low + 2.0);
        let mut strides = [1.0; D];
        for a in (0..D - 1).rev() {
            strides[a] = strides[a + 1] * extents[a + 1];
        }
        let low = ends.map(|[low, _]| low);
        Ok(Self { low, extents, strides })
    }

    /// Number of points in the box.
    pub fn size(&self) -> f64 {
        self.strides[0] * self.extents[0]
    }

    /// Places of L integer points side by side, `nodes[axis][point]`.
    #[inline(always)]
    pub fn places<const L: usize>(&self, nodes: &[[f64; L]; D]) -> [f64; L] {
        let mut places = [0.0; L];
        for a in 0..D {
            for l in 0..L {
                places[l] += (nodes[a][l] - self.low[a]) * self.strides[a];
            }
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

/// Least and largest lattice coordinates.
#[derive(Clone, Copy)]
struct Range<const D: usize> {
    low: [[f64; LANES]; D],
    high: [[f64; LANES]; D],
    /// Zero, or NaN once a coordinate was not finite.
    fault: [f64; LANES],
}

impl<const D: usize> Range<D> {
    const NONE: Self = Self {
        low: [[f64::INFINITY; LANES]; D],
        high: [[f64::NEG_INFINITY; LANES]; D],
        fault: [0.0; LANES],
    };

    #[inline(always)]
    fn include(&mut self, u: &[[f64; LANES]; D]) {
        for a in 0..D {
            for l in 0..LANES {
                let c = u[a][l];
                self.low[a][l] = if c < self.low[a][l] { c } else { self.low[a][l] };
                self.high[a][l] = if c > self.high[a][l] { c } else { self.high[a][l] };
                self.fault[l] += 0.0 * c;
            }
        }
    }

    fn with(mut self, other: Self) -> Self {
        self.include(&other.low);
        self.include(&other.high);
        for l in 0..LANES {
            self.fault[l] += other.fault[l];
        }
        self
    }

    /// The ends per axis; `None` where coordinates are out of range.
    fn ends(&self) -> Option<([f64; D], [f64; D])> {
        let low = self.low.map(|row| row.into_iter().fold(f64::INFINITY, f64::min));
        let high = self.high.map(|row| row.into_iter().fold(f64::NEG_INFINITY, f64::max));
        let sound = (0..D).all(|a| low[a] > -COORDINATE_LIMIT && high[a] < COORDINATE_LIMIT);
        (sound && self.fault.iter().all(|fault| *fault == 0.0)).then_some((low, high))
    }
}
