/// A box with sides along the axes; empty where `lower` is above `upper`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds<const D: usize> {
    /// Lowest corner.
    pub lower: [f64; D],
    /// Highest corner.
    pub upper: [f64; D],
}

impl<const D: usize> Bounds<D> {
    /// All of space.
    pub const EVERYWHERE: Self = Self {
        lower: [f64::NEG_INFINITY; D],
        upper: [f64::INFINITY; D],
    };

    /// From −1 to 1 along every axis.
    pub(crate) const UNIT: Self = Self {
        lower: [-1.0; D],
        upper: [1.0; D],
    };

    /// The smallest box around some points.
    pub fn around(points: &[[f64; D]]) -> Self {
        let fold = |start: f64, choose: fn(f64, f64) -> f64| {
            std::array::from_fn(|a| points.iter().fold(start, |bound, x| choose(bound, x[a])))
        };
        Self {
            lower: fold(f64::INFINITY, f64::min),
            upper: fold(f64::NEG_INFINITY, f64::max),
        }
    }

    /// Its lengths along the axes.
    pub(crate) fn sides(&self) -> [f64; D] {
        std::array::from_fn(|a| self.upper[a] - self.lower[a])
    }

    /// The smallest box that holds both.
    pub fn hull(&self, other: &Self) -> Self {
        Self {
            lower: std::array::from_fn(|a| self.lower[a].min(other.lower[a])),
            upper: std::array::from_fn(|a| self.upper[a].max(other.upper[a])),
        }
    }

    /// What is in both.
    pub fn overlap(&self, other: &Self) -> Self {
        Self {
            lower: std::array::from_fn(|a| self.lower[a].max(other.lower[a])),
            upper: std::array::from_fn(|a| self.upper[a].min(other.upper[a])),
        }
    }

    /// Whether a point is inside or on the border; never for NaN.
    pub fn contains(&self, x: &[f64; D]) -> bool {
        (0..D).all(|a| self.lower[a] <= x[a] && x[a] <= self.upper[a])
    }

    /// This box, with the sides of `other` where its own are infinite.
    pub fn finite_within(&self, other: &Self) -> Self {
        let or = |own: f64, other: f64| if own.is_finite() { own } else { other };
        Self {
            lower: std::array::from_fn(|a| or(self.lower[a], other.lower[a])),
            upper: std::array::from_fn(|a| or(self.upper[a], other.upper[a])),
        }
    }
}
