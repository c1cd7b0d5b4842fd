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
    /// All points, and the sample points, by cells as wide as the reach.
    sorted: Vec<([i64; D], u32)>,
    cells: Vec<([i64; D], u32)>,
    /// The sample points of the 3ᴰ cells around one, and the list in the order of cells.
    close: Vec<u32>,
    found: Vec<(u32, (u32, [f64; D]))>,
}

fn cell_of<const D: usize>(x: &[f64; D], width: f64) -> [i64; D] {
    x.map(|c| (c / width).floor() as i64)
}

/// The numbers of points in the order of their cells, in the place of what is there.
fn sort_by_cell<const D: usize>(sorted: &mut Vec<([i64; D], u32)>, points: &[[f64; D]], width: f64) {
    sorted.clear();
    sorted.extend(points.iter().zip(0..).map(|(x, point)| (cell_of(x, width), point)));
    sorted.sort_unstable();
}

impl<const D: usize> NeighbourList<D> {
    /// The list for these positions of all points and of the sample points.
    pub fn rebuild(&mut self, positions: &[[f64; D]], samples: &[[f64; D]], spacing: f64, skin: f64) {
        sort_by_cell(&mut self.sorted, positions, (WIDTH as f64 + skin) * spacing);
        self.relist(positions, samples, spacing, skin);
    }

    /// The list of other sample points, for the same positions of all points as when it was [made](Self::rebuild).
    pub fn relist(&mut self, positions: &[[f64; D]], samples: &[[f64; D]], spacing: f64, skin: f64) {
        let reach = (WIDTH as f64 + skin) * spacing;
        sort_by_cell(&mut self.cells, samples, reach);
        self.found.clear();
        for members in self.sorted.chunk_by(|a, b| a.0 == b.0) {
            self.close.clear();
            for cell in around(members[0].0) {
                let start = self.cells.partition_point(|(other, _)| *other < cell);
                let there = self.cells[start..].iter().take_while(|(other, _)| *other == cell);
                self.close.extend(there.map(|(_, s)| *s));
            }
            for &(_, point) in members {
                let mut best: Option<(f64, u32, [f64; D])> = None;
                for &s in &self.close {
                    let offset = vector::subtract(&positions[point as usize], &samples[s as usize]);
                    let distance = vector::maximum_norm(&offset);
                    if distance <= reach && best.is_none_or(|(least, ..)| distance < least) {
                        best = Some((distance, s, offset));
                    }
                }
                if let Some((_, s, offset)) = best {
                    self.found.push((point, (s, offset)));
                }
            }
        }
        self.found.sort_unstable_by_key(|(point, _)| *point);
        self.points.clear();
        self.nearest.clear();
        for &(point, nearest) in &self.found {
            self.points.push(point);
            self.nearest.push(nearest);
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
