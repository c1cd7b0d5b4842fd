//! The points of a body that readings know.

use rayon::prelude::*;

use crate::nearest::nearest;

/// Which points of a body stand for the points of readings.
#[derive(Clone, Debug, PartialEq)]
pub struct KnownPoints {
    /// For every point of the readings its number in the body.
    numbers: Vec<u32>,
    /// For every point of the body the first point of the readings that it stands for.
    places: Vec<Option<u32>>,
}

impl KnownPoints {
    /// All of so many points: readings of the body itself.
    pub fn all(points: usize) -> Self {
        Self::new((0..points as u32).collect(), points)
    }

    /// For each position at rest the nearest point of the body, the first of equals: readings of a part of the body, or of one with other points.
    pub fn nearest<const D: usize>(reference: &[[f64; D]], positions: &[[f64; D]]) -> Self {
        if reference == positions {
            return Self::all(positions.len());
        }
        let numbers = positions.par_iter().map(|x| nearest(x, reference) as u32);
        Self::new(numbers.collect(), reference.len())
    }

    fn new(numbers: Vec<u32>, points: usize) -> Self {
        let mut places = vec![None; points];
        for (place, &number) in numbers.iter().enumerate() {
            if let Some(own) = places.get_mut(number as usize) {
                own.get_or_insert(place as u32);
            }
        }
        Self { numbers, places }
    }

    /// For every point of the readings its number in the body.
    pub fn numbers(&self) -> &[u32] {
        &self.numbers
    }

    /// Points of the body.
    pub fn points_of_body(&self) -> usize {
        self.places.len()
    }

    /// The point of the readings that a point of the body stands for.
    pub fn place(&self, number: u32) -> Option<usize> {
        self.places.get(number as usize)?.map(|place| place as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_of_a_body_is_found_again_and_points_between_take_the_nearest() {
        let line: Vec<[f64; 1]> = (0..10).map(|k| [f64::from(k)]).collect();
        let known = KnownPoints::nearest(&line, &[[7.0], [2.4], [7.1]]);
        assert_eq!(known.numbers(), [7, 2, 7]);
        assert_eq!(
            (known.place(7), known.place(2), known.place(3)),
            (Some(0), Some(1), None)
        );
        assert_eq!(KnownPoints::nearest(&line, &line), KnownPoints::all(10));
        let nearly: Vec<[f64; 1]> = line.iter().map(|[x]| [x + 0.1]).collect();
        assert_eq!(KnownPoints::nearest(&line, &nearly), KnownPoints::all(10));
    }
}
