use super::{Bounds, Shape};

/// The inside of a closed polygon that does not cross itself, in the plane of the first two axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon {
    /// The corners in either order.
    pub corners: Vec<[f64; 2]>,
}

impl Polygon {
    /// The sides, from corner to corner and back to the first.
    fn sides(&self) -> impl Iterator<Item = ([f64; 2], [f64; 2])> {
        let next = self.corners.iter().cycle().skip(1);
        self.corners.iter().zip(next).map(|(&a, &b)| (a, b))
    }

    /// ½ Σ (x_k y_{k+1} − x_{k+1} y_k), positive for corners against the clock; x and y from the first corner, so that nothing cancels far from the origin.
    pub fn signed_area(&self) -> f64 {
        let origin = self.corners.first().copied().unwrap_or_default();
        let from = |x: [f64; 2]| [x[0] - origin[0], x[1] - origin[1]];
        let sides = self.sides().map(|(a, b)| (from(a), from(b)));
        0.5 * sides.map(|(a, b)| a[0] * b[1] - b[0] * a[1]).sum::<f64>()
    }
}

/// In other dimensions than two there are no polygons: [`build`](super::build) makes none.
impl<const D: usize> Shape<D> for Polygon {
    /// The least distance to a side; inside where a ray to the right crosses an odd number of sides.
    fn distance(&self, x: &[f64; D]) -> f64 {
        let (&px, &py) = (x.first().unwrap_or(&0.0), x.get(1).unwrap_or(&0.0));
        let (mut square, mut inside) = (f64::INFINITY, false);
        for (a, b) in self.sides() {
            let (ex, ey) = (b[0] - a[0], b[1] - a[1]);
            let (wx, wy) = (px - a[0], py - a[1]);
            let share = ((wx * ex + wy * ey) / (ex * ex + ey * ey).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
            let (dx, dy) = (wx - share * ex, wy - share * ey);
            square = square.min(dx * dx + dy * dy);
            if (a[1] > py) != (b[1] > py) && px < a[0] + (py - a[1]) / (b[1] - a[1]) * (b[0] - a[0]) {
                inside = !inside;
            }
        }
        if inside { -square.sqrt() } else { square.sqrt() }
    }

    fn bounds(&self) -> Bounds<D> {
        let coordinate = |a: usize| self.corners.iter().filter_map(move |corner| corner.get(a).copied());
        Bounds {
            lower: std::array::from_fn(|a| coordinate(a).fold(f64::INFINITY, f64::min)),
            upper: std::array::from_fn(|a| coordinate(a).fold(f64::NEG_INFINITY, f64::max)),
        }
    }

    fn volume(&self) -> Option<f64> {
        Some(self.signed_area().abs())
    }
}
