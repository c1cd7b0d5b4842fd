//! Scores at nodes that do not move: each is evaluated once.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use mpm_core::MpmError;

/// Scores by node, as long as the grid stands (MPM-ParVI paper: the force field is time-invariant and nodes do not move).
///
/// A node is known by its position, origin + h k, which has the same bits in every step on the same grid.
#[derive(Debug, Default)]
pub struct NodeScores<const D: usize> {
    /// Origin and spacing of the grid.
    grid: Option<([f64; D], f64)>,
    known: HashMap<[u64; D], [f64; D]>,
    /// Nodes of a step that are not known yet: their places among its nodes, and their positions.
    places: Vec<usize>,
    fresh: Vec<[f64; D]>,
    scores: Vec<[f64; D]>,
}

impl<const D: usize> NodeScores<D> {
    /// Another grid has other nodes: forget those of the last one.
    pub fn stand_on(&mut self, origin: &[f64; D], spacing: f64) {
        if self.grid != Some((*origin, spacing)) {
            self.grid = Some((*origin, spacing));
            self.known.clear();
        }
    }

    /// The scores at the nodes: known ones, and those of the others from `evaluate`, in one batch. All fresh ones are forgotten if one of them is not finite.
    ///
    /// # Errors
    /// What `evaluate` says.
    pub fn evaluate(
        &mut self,
        nodes: &[[f64; D]],
        out: &mut [[f64; D]],
        evaluate: impl FnOnce(&[[f64; D]], &mut [[f64; D]]) -> Result<(), MpmError>,
    ) -> Result<(), MpmError> {
        self.places.clear();
        self.fresh.clear();
        for (place, (node, out)) in nodes.iter().zip(out.iter_mut()).enumerate() {
            match self.known.entry(key(node)) {
                Entry::Occupied(known) => *out = *known.get(),
                Entry::Vacant(_) => {
                    self.places.push(place);
                    self.fresh.push(*node);
                }
            }
        }
        self.scores.resize(self.fresh.len(), [0.0; D]);
        evaluate(&self.fresh, &mut self.scores)?;
        for ((&place, node), &fresh) in self.places.iter().zip(&self.fresh).zip(&self.scores) {
            out[place] = fresh;
            self.known.insert(key(node), fresh);
        }
        Ok(())
    }
}

/// The bits of a position, of one zero for both signs.
fn key<const D: usize>(node: &[f64; D]) -> [u64; D] {
    node.map(|c| (c + 0.0).to_bits())
}
