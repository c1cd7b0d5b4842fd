//! Closed polygons, divided into short edges.

use mpm_tensor::vector::{distance, distance_squared, is_finite};

use crate::generate::GenerationError;

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

/// Whether a point lies within an odd number of the closed polygons that segments make up.
pub fn encloses(segments: &[[[f64; 2]; 2]], point: &[f64; 2]) -> bool {
    let crossed = segments.iter().filter(|[a, b]| {
        // Upwards or downwards across the line through the point, to the right of it.
        let share = (point[1] - a[1]) / (b[1] - a[1]);
        (a[1] <= point[1]) != (b[1] <= point[1]) && a[0] + share * (b[0] - a[0]) > point[0]
    });
    crossed.count() % 2 == 1
}
