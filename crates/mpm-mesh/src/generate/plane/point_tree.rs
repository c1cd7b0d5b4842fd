//! Points by squares that are divided where points are dense.

use mpm_tensor::vector::distance_squared;

/// Points of a square that is not divided, at most.
const MOST_POINTS: usize = 8;

/// Divisions of a square, at most: the parts of parts are then as narrow as rounding.
const MOST_DIVISIONS: u32 = 48;

/// A quadtree: what it costs to look around a point does not hang on how much denser points are elsewhere.
pub struct PointTree {
    /// Lowest and highest coordinates of the whole.
    bounds: [[f64; 2]; 2],
    squares: Vec<Square>,
}

enum Square {
    /// Numbers of the points in it.
    Whole(Vec<u32>),
    /// Where its four parts are: the first has the lower halves of both axes, the next one the upper half of x.
    Divided(usize),
}

/// A square on the way down: its number, its bounds, and how often the whole has been divided.
type Place = (usize, [[f64; 2]; 2], u32);

impl PointTree {
    /// Of points between these lowest and highest coordinates.
    pub fn new(bounds: [[f64; 2]; 2]) -> Self {
        Self {
            bounds,
            squares: vec![Square::Whole(Vec::new())],
        }
    }

    fn whole(&self) -> Place {
        (0, self.bounds, 0)
    }

    /// Adds the point of this number, the last of `points` or one before it.
    pub fn insert(&mut self, number: u32, points: &[[f64; 2]]) {
        let (mut place, point) = (self.whole(), points[number as usize]);
        loop {
            match &mut self.squares[place.0] {
                Square::Divided(first) => place = part(place, *first, half_of(&point, &place)),
                Square::Whole(numbers) => {
                    numbers.push(number);
                    if numbers.len() > MOST_POINTS && place.2 < MOST_DIVISIONS {
                        self.divide(place, points);
                    }
                    return;
                }
            }
        }
    }

    fn divide(&mut self, place: Place, points: &[[f64; 2]]) {
        let first = self.squares.len();
        let Square::Whole(numbers) = std::mem::replace(&mut self.squares[place.0], Square::Divided(first)) else {
            return;
        };
        let mut parts: [Vec<u32>; 4] = Default::default();
        for number in numbers {
            parts[half_of(&points[number as usize], &place)].push(number);
        }
        self.squares.extend(parts.map(Square::Whole));
    }

    /// Whether one of the points is nearer than `limit` to a place.
    pub fn any_within(&self, x: &[f64; 2], limit: f64, points: &[[f64; 2]]) -> bool {
        let mut open = vec![self.whole()];
        while let Some(place) = open.pop() {
            match &self.squares[place.0] {
                Square::Whole(numbers) => {
                    let mut others = numbers.iter().map(|&number| &points[number as usize]);
                    if others.any(|other| distance_squared(other, x) < limit * limit) {
                        return true;
                    }
                }
                Square::Divided(first) => {
                    let [low, high] = [-limit, limit].map(|shift| half_of(&x.map(|c| c + shift), &place));
                    // A half of an axis is out of reach where both ends are in the other one.
                    let reached = (0..4).filter(|half| half & low == low && half | high == high);
                    open.extend(reached.map(|half| part(place, *first, half)));
                }
            }
        }
        false
    }
}

fn middle(&(_, [lower, upper], _): &Place) -> [f64; 2] {
    [0, 1].map(|axis| 0.5 * (lower[axis] + upper[axis]))
}

/// The part of a square that is on the side of a point: 1 for the upper half of x, plus 2 for that of y.
fn half_of(point: &[f64; 2], place: &Place) -> usize {
    let middle = middle(place);
    usize::from(point[0] >= middle[0]) + 2 * usize::from(point[1] >= middle[1])
}

fn part(place: Place, first: usize, half: usize) -> Place {
    let (middle, [lower, upper]) = (middle(&place), place.1);
    let bounds = |at_lower: [f64; 2], at_upper: [f64; 2]| {
        [0, 1].map(|axis| {
            if half >> axis & 1 == 1 {
                at_upper[axis]
            } else {
                at_lower[axis]
            }
        })
    };
    (
        first + half,
        [bounds(lower, middle), bounds(middle, upper)],
        place.2 + 1,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points whose distances fall off towards a corner, some of them twice, and two far outside of the stated bounds.
    #[test]
    fn it_finds_what_a_look_at_all_points_finds() {
        let spiral = |k: i32| {
            let (radius, (sine, cosine)) = (0.99f64.powi(k), (2.4 * f64::from(k)).sin_cos());
            [radius * (0.5 + 0.5 * cosine), radius * (0.5 + 0.5 * sine)]
        };
        let mut points: Vec<_> = (0..1500).map(spiral).chain((0..30).map(|_| [0.25, 0.5])).collect();
        points.extend([[-3.0, 0.5], [0.5, 7.0]]);
        let mut tree = PointTree::new([[0.0; 2], [1.0; 2]]);
        for number in 0..points.len() {
            tree.insert(number as u32, &points[..=number]);
        }
        let mut found = [0, 0];
        for k in (0..1500).step_by(7) {
            let x = spiral(k).map(|c| 1.01 * c + 1e-6);
            for limit in [1e-7, 1e-3, 0.01 * x[0], 0.3 * x[1], 4.0] {
                let expected = points.iter().any(|other| distance_squared(other, &x) < limit * limit);
                assert_eq!(tree.any_within(&x, limit, &points), expected, "{x:?}, {limit}");
                found[usize::from(expected)] += 1;
            }
        }
        assert!(found[0] > 100 && found[1] > 100, "{found:?}");
        assert!(tree.any_within(&[0.5, 7.1], 0.2, &points));
    }
}
