//! Independent blocks of one and two coordinates.

use crate::{BoxedLaw, Target, TargetError, UnitCubeTransport};

/// p(x) = Π p_b(x_b) over blocks b of coordinates: planes first, then lines. Modes multiply: three planes of two pieces each
/// make eight pieces in six dimensions.
#[derive(Debug)]
pub struct ProductLaw<const D: usize> {
    planes: Vec<BoxedLaw<2>>,
    lines: Vec<BoxedLaw<1>>,
}

impl<const D: usize> ProductLaw<D> {
    /// The product of laws of two coordinates and of one coordinate.
    ///
    /// # Errors
    /// [`TargetError::Length`] unless the blocks have D coordinates together.
    pub fn new(planes: Vec<BoxedLaw<2>>, lines: Vec<BoxedLaw<1>>) -> Result<Self, TargetError> {
        let found = 2 * planes.len() + lines.len();
        if found == D {
            Ok(Self { planes, lines })
        } else {
            Err(TargetError::Length {
                field: "the coordinates of a product of laws".to_owned(),
                expected: D,
                found,
            })
        }
    }

    /// The two coordinates of a plane.
    fn of_plane(x: &[f64; D], plane: usize) -> [f64; 2] {
        [x[2 * plane], x[2 * plane + 1]]
    }

    /// The axis of the first line.
    fn first_line(&self) -> usize {
        2 * self.planes.len()
    }
}

impl<const D: usize> Target<D> for ProductLaw<D> {
    fn log_density(&self, x: &[f64; D]) -> f64 {
        let planes = self.planes.iter().enumerate();
        let in_planes: f64 = planes.map(|(b, law)| law.log_density(&Self::of_plane(x, b))).sum();
        let lines = self.lines.iter().zip(&x[self.first_line()..]);
        in_planes + lines.map(|(law, x)| law.log_density(&[*x])).sum::<f64>()
    }

    fn score(&self, x: &[f64; D]) -> [f64; D] {
        let mut score = [0.0; D];
        for (b, law) in self.planes.iter().enumerate() {
            score[2 * b..2 * b + 2].copy_from_slice(&law.score(&Self::of_plane(x, b)));
        }
        let first = self.first_line();
        for (axis, law) in (first..).zip(&self.lines) {
            [score[axis]] = law.score(&[x[axis]]);
        }
        score
    }
}

impl<const D: usize> UnitCubeTransport<D> for ProductLaw<D> {
    fn cube_dimension(&self) -> usize {
        let planes: usize = self.planes.iter().map(|law| law.cube_dimension()).sum();
        planes + self.lines.iter().map(|law| law.cube_dimension()).sum::<usize>()
    }

    fn transport(&self, u: &[f64]) -> [f64; D] {
        let mut rest = u;
        let mut take = |count: usize| {
            let (part, others) = rest.split_at(count.min(rest.len()));
            rest = others;
            part
        };
        let mut x = [0.0; D];
        for (b, law) in self.planes.iter().enumerate() {
            x[2 * b..2 * b + 2].copy_from_slice(&law.transport(take(law.cube_dimension())));
        }
        let first = self.first_line();
        for (axis, law) in (first..).zip(&self.lines) {
            [x[axis]] = law.transport(take(law.cube_dimension()));
        }
        x
    }
}
