//! Which material points may touch the nodes of the sample points.

use mpm_tensor::vector;

use super::nodes::WIDTH;
use super::support::around;

/// How the material points are found that touch ℐ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Search {
    /// The position of every material point is evaluated in every step.
    All,
    /// Neighbour lists (Verlet 1967; ours): only points that were within (3 + skin) h of a sample point along every axis when the list was made are evaluated. A
    /// point that touches a node of a sample point is within 3 h of it. The list is made anew, from all points, once a point in it has moved by half the
    /// skin relative to its sample point; a point outside would have had to move by the whole skin between two who have not.
    ///
    /// Sample points that are drawn anew take the points that were near them when all points were evaluated last.
    Lists {
        /// Multiple of h, > 0.
        skin: f64,
    },
}

/// The points near sample points when the list was made.
#[derive(Clone, Debug, Default)]
pub(super) struct NeighbourList<const D: usize> {
    /// Their numbers, ascending.
    pub points: Vec<u32>,
    /// For each the nearest sample point, and where it was seen from there.
    nearest: Vec<(u32, [f64; D])>,
    /// Sample points by cells as wide as the reach.
    cells: Vec<([i64; D], u32)>,
}

impl<const D: usize> NeighbourList<D> {
    /// The list for these positions of all points and of the sample points.
    pub fn rebuild(&mut self, positions: &[[f64; D]], samples: &[[f64; D]], spacing: f64, skin: f64) {
        let reach = (WIDTH as f64 + skin) * spacing;
        let cell_of = |x: &[f64; D]| x.map(|c| (c / reach).floor() as i64);
        self.cells.clear();
        self.cells.extend(samples.iter().zip(0..).map(|(x, s)| (cell_of(x), s)));
        self.cells.sort_unstable();
        self.points.clear();
        self.nearest.clear();
        for (x, point) in positions.iter().zip(0..) {
            let mut best: Option<(f64, u32, [f64; D])> = None;
            for cell in around(cell_of(x)) {
                let start = self.cells.partition_point(|(other, _)| *other < cell);
                for &(_, s) in self.cells[start..].iter().take_while(|(other, _)| *other == cell) {
                    let offset = vector::subtract(x, &samples[s as usize]);
                    let distance = vector::maximum_norm(&offset);
                    if distance <= reach && best.is_none_or(|(least, ..)| distance < least) {
                        best = Some((distance, s, offset));
                    }
                }
            }
            if let Some((_, s, offset)) = best {
                self.points.push(point);
                self.nearest.push((s, offset));
            }
        }
    }

    /// Whether no point of the list has moved by half the skin relative to its sample point; `positions` are those of the list's points.
    pub fn holds(&self, positions: &[[f64; D]], samples: &[[f64; D]], spacing: f64, skin: f64) -> bool {
        positions.iter().zip(&self.nearest).all(|(x, (s, before))| {
            let moved = vector::subtract(&vector::subtract(x, &samples[*s as usize]), before);
            vector::maximum_norm(&moved) <= 0.5 * skin * spacing
        })
    }
}
