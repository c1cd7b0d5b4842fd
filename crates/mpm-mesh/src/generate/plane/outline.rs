//! Closed polygons, divided into short edges.

use mpm_tensor::vector::{distance, distance_squared, is_finite};

use super::size_field::SizeField;
use crate::adjacency::Lists;
use crate::generate::GenerationError;

/// Parts of an edge's way, per edge that it takes, in which a size field is summed.
const PARTS: f64 = 16.0;

/// The boundary of a domain: points, and edges between them of about the target length.
pub struct Outline {
    pub points: Vec<[f64; 2]>,
    pub edges: Vec<[usize; 2]>,
}

impl Outline {
    /// Divides an edge of length L into max(1, ⌈L / h − 0.2⌉) equal parts.
    pub fn new(outlines: &[Vec<[f64; 2]>], target: f64) -> Result<Self, GenerationError> {
        let mut outline = Self {
            points: Vec::new(),
            edges: Vec::new(),
        };
        for (number, corners) in outlines.iter().enumerate() {
            check(number, corners)?;
            let first = outline.points.len();
            let following = corners.iter().skip(1).chain(&corners[..1]);
            for (a, b) in corners.iter().zip(following) {
                let parts = (distance(a, b) / target - 0.2).ceil().max(1.0);
                GenerationError::check_count(target, parts)?;
                let point = |k: usize| std::array::from_fn(|axis| a[axis] + (b[axis] - a[axis]) * (k as f64 / parts));
                outline.points.extend((0..parts as usize).map(point));
            }
            let last = outline.points.len() - 1;
            outline.edges.extend((first..last).map(|k| [k, k + 1]));
            outline.edges.push([last, first]);
        }
        Ok(outline)
    }

    /// Divides every edge into parts of the same ∫ ds / h, as many as in [`new`](Self::new) where h is constant.
    pub fn graded(outlines: &[Vec<[f64; 2]>], size: &SizeField) -> Result<Self, GenerationError> {
        let mut divided = Vec::with_capacity(outlines.len());
        for (number, corners) in outlines.iter().enumerate() {
            check(number, corners)?;
            let mut points = Vec::new();
            let following = corners.iter().skip(1).chain(&corners[..1]);
            for (a, b) in corners.iter().zip(following) {
                let steps = (PARTS * distance(a, b) / size.least()).ceil().max(1.0);
                GenerationError::check_count(size.least(), steps / PARTS)?;
                // There may be more sums than memory has room for, where a small part of the domain is fine.
                let sums = || size.edges_along(a, b, steps as usize);
                let edges = sums().last().unwrap_or(0.0);
                let parts = (edges - 0.2).ceil().max(1.0);
                let (mut part, mut before) = (0.0, 0.0);
                for (step, sum) in sums().enumerate() {
                    let is_last = step + 1 == steps as usize;
                    while part < parts && (is_last || edges * part / parts < sum) {
                        let share = (step as f64 + (edges * part / parts - before) / (sum - before)) / steps;
                        points.push(std::array::from_fn(|axis| a[axis] + share * (b[axis] - a[axis])));
                        part += 1.0;
                    }
                    before = sum;
                }
            }
            divided.push(points);
        }
        Self::undivided(&divided)
    }

    /// Every edge as it is.
    pub fn undivided(outlines: &[Vec<[f64; 2]>]) -> Result<Self, GenerationError> {
        Self::new(outlines, f64::INFINITY)
    }

    /// Lowest and highest coordinates.
    pub fn bounds(&self) -> [[f64; 2]; 2] {
        let fold = |start: f64, choose: fn(f64, f64) -> f64| {
            [0, 1].map(|axis| {
                self.points
                    .iter()
                    .fold(start, |bound, point| choose(bound, point[axis]))
            })
        };
        [fold(f64::INFINITY, f64::min), fold(f64::NEG_INFINITY, f64::max)]
    }

    /// Area of the bounding box.
    pub fn box_area(&self) -> f64 {
        let [lower, upper] = self.bounds();
        (upper[0] - lower[0]) * (upper[1] - lower[1])
    }

    /// The edges as pairs of points.
    pub fn segments(&self) -> impl Iterator<Item = [[f64; 2]; 2]> {
        self.edges.iter().map(|&[a, b]| [self.points[a], self.points[b]])
    }
}

fn check(outline: usize, corners: &[[f64; 2]]) -> Result<(), GenerationError> {
    if corners.len() < 3 {
        return Err(GenerationError::TooFewCorners {
            outline,
            corners: corners.len(),
        });
    }
    match corners.iter().position(|corner| !is_finite(corner)) {
        Some(corner) => Err(GenerationError::InvalidCorner {
            outline,
            corner,
            position: corners[corner],
        }),
        None => Ok(()),
    }
}

/// Squared distance of a point to the segment from a to b.
pub fn squared_distance_to_segment(point: &[f64; 2], a: &[f64; 2], b: &[f64; 2]) -> f64 {
    let edge = [b[0] - a[0], b[1] - a[1]];
    let along = (point[0] - a[0]) * edge[0] + (point[1] - a[1]) * edge[1];
    let share = along / (edge[0] * edge[0] + edge[1] * edge[1]).max(f64::MIN_POSITIVE);
    let share = share.clamp(0.0, 1.0);
    distance_squared(point, &[a[0] + share * edge[0], a[1] + share * edge[1]])
}

/// The segments of closed polygons by the stripe across y that they pass through, to tell fast what is inside.
pub struct Rows<'a> {
    segments: &'a [[[f64; 2]; 2]],
    lower: f64,
    height: f64,
    stripes: Lists,
}

impl<'a> Rows<'a> {
    /// Stripes of a height, or of a larger one that makes no more of them than there are segments.
    pub fn new(segments: &'a [[[f64; 2]; 2]], height: f64) -> Self {
        let ys = || segments.iter().flatten().map(|end| end[1]);
        let (lower, upper) = (
            ys().fold(f64::INFINITY, f64::min),
            ys().fold(f64::NEG_INFINITY, f64::max),
        );
        let height = height.max((upper - lower) / segments.len() as f64);
        let stripe = |y: f64| ((y - lower) / height) as usize;
        let pairs: Vec<(usize, u32)> = (0u32..)
            .zip(segments)
            .flat_map(|(number, [a, b])| {
                (stripe(a[1].min(b[1]))..=stripe(a[1].max(b[1]))).map(move |stripe| (stripe, number))
            })
            .collect();
        Self {
            segments,
            lower,
            height,
            stripes: Lists::from_pairs(stripe(upper) + 1, pairs.into_iter()),
        }
    }

    /// As [`encloses`], of the segments in the point's stripe.
    pub fn encloses(&self, point: &[f64; 2]) -> bool {
        let stripe = (point[1] - self.lower) / self.height;
        if !(stripe >= 0.0 && (stripe as usize) < self.stripes.len()) {
            return false;
        }
        let near = self.stripes.get(stripe as usize).iter();
        near.filter(|&&number| crosses(&self.segments[number as usize], point))
            .count()
            % 2
            == 1
    }
}

/// Whether a point lies within an odd number of the closed polygons that segments make up.
pub fn encloses(segments: &[[[f64; 2]; 2]], point: &[f64; 2]) -> bool {
    segments.iter().filter(|segment| crosses(segment, point)).count() % 2 == 1
}

/// Whether a segment crosses the line from a point to the right, upwards or downwards.
fn crosses([a, b]: &[[f64; 2]; 2], point: &[f64; 2]) -> bool {
    let share = (point[1] - a[1]) / (b[1] - a[1]);
    (a[1] <= point[1]) != (b[1] <= point[1]) && a[0] + share * (b[0] - a[0]) > point[0]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A height far below that of the segments makes no more stripes than there are of these, and the answers of all segments.
    #[test]
    fn stripes_are_no_more_than_segments() {
        let corner = |k: u32| {
            let (sine, cosine) = (0.37 + f64::from(k) * std::f64::consts::TAU / 40.0).sin_cos();
            let radius = 1.0 + f64::from(k % 2);
            [radius * cosine, radius * sine]
        };
        let segments: Vec<_> = (0..40).map(|k| [corner(k), corner(k + 1)]).collect();
        let rows = Rows::new(&segments, 1e-5);
        assert!(rows.stripes.len() <= 41, "{}", rows.stripes.len());
        let points = (0..50 * 50).map(|k| [f64::from(k % 50), f64::from(k / 50)].map(|c| 0.1 * c - 2.45));
        let corners = segments.iter().map(|segment| segment[0]);
        for point in points.chain(corners) {
            assert_eq!(rows.encloses(&point), encloses(&segments, &point), "{point:?}");
        }
    }
}
