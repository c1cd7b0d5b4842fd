//! A mesh whose inner vertices have been moved at random.

use crate::mesh::signed_volume;
use crate::{MeshError, SimplexMesh};

/// No cell becomes smaller than this share of what it was.
const SMALLEST_SHARE: f64 = 0.2;

/// Halvings of a move that is too long, before the vertex stays where it is.
const HALVINGS: u32 = 4;

/// A number that is in its range.
fn within(valid: bool, name: &'static str, value: f64, requirement: &'static str) -> Result<f64, MeshError> {
    let error = MeshError::InvalidParameter {
        name,
        value,
        requirement,
    };
    valid.then_some(value).ok_or(error)
}

impl<const D: usize> SimplexMesh<D> {
    /// The same cells, every vertex that is not on the boundary moved part of the way to a random point of a random one of its cells.
    ///
    /// `random` gives numbers in [0, 1). A vertex goes up to `amplitude` ∈ [0, 1] of the way, as far as no cell shrinks below a fifth of its volume.
    ///
    /// # Errors
    /// [`MeshError::InvalidParameter`] for an amplitude outside [0, 1] or a random number outside [0, 1); other ones where the moved mesh is refused, which
    /// volumes above zero exclude up to rounding.
    pub fn jittered(&self, amplitude: f64, mut random: impl FnMut() -> f64) -> Result<Self, MeshError> {
        within((0.0..=1.0).contains(&amplitude), "amplitude", amplitude, "from 0 to 1")?;
        let mut draw = || {
            let number = random();
            within(
                (0.0..1.0).contains(&number),
                "random number",
                number,
                "at least 0 and below 1",
            )
        };
        let mut vertices = self.vertices().to_vec();
        let cells: Vec<u32> = self.cells().flatten().copied().collect();
        let (at_boundary, around) = (self.on_boundary(), self.vertex_cells());
        for vertex in (0..vertices.len()).filter(|&vertex| !at_boundary[vertex]) {
            let near = around.get(vertex);
            let cell = near[((draw()? * near.len() as f64) as usize).min(near.len() - 1)];
            let mut weights = vec![0.0; D + 1];
            for weight in &mut weights {
                *weight = -(1.0 - draw()?).ln();
            }
            let total: f64 = weights.iter().sum();
            let start = vertices[vertex];
            let goal: [f64; D] = std::array::from_fn(|a| {
                let corners = self.cell(cell as usize).iter().zip(&weights);
                corners
                    .map(|(&corner, weight)| weight / total * vertices[corner as usize][a])
                    .sum()
            });
            let mut share = amplitude;
            let mut halvings = 0;
            loop {
                vertices[vertex] = std::array::from_fn(|a| start[a] + share * (goal[a] - start[a]));
                let keeps_its_size = |&cell: &u32| {
                    let volume = signed_volume(&vertices, self.cell(cell as usize));
                    volume >= SMALLEST_SHARE * self.volume(cell as usize)
                };
                if near.iter().all(keeps_its_size) {
                    break;
                }
                halvings += 1;
                share = if halvings > HALVINGS { 0.0 } else { 0.5 * share };
                if share == 0.0 {
                    vertices[vertex] = start;
                    break;
                }
            }
        }
        Self::new(vertices, cells)
    }
}
