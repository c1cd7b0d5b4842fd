//! The cells of the support of ℐ.

use std::collections::HashMap;

use super::nodes::Nodes;

/// The 3ᴰ cells that touch this one, and itself; the first axis runs fastest.
pub(super) fn around<const D: usize>(cell: [i64; D]) -> impl Iterator<Item = [i64; D]> {
    let digit = |number: usize, a: usize| (number / 3usize.pow(a as u32) % 3) as i64;
    (0..3usize.pow(D as u32)).map(move |number| std::array::from_fn(|a| cell[a] + digit(number, a) - 1))
}

/// The 3ᴰ cells around every active node, each once, with their places in the list of the step before.
#[derive(Default)]
pub(super) struct Support<const D: usize> {
    /// Which places of the nodes' box are in the list.
    marked: Vec<bool>,
    marked_places: Vec<usize>,
    /// The nodes in the middle of the cells, and where these cells were.
    pub cells: Vec<([i64; D], Option<usize>)>,
    numbers: HashMap<[i64; D], usize>,
}

impl<const D: usize> Support<D> {
    /// The cells of this step.
    pub fn find(&mut self, nodes: &Nodes<D>) {
        self.numbers.clear();
        let numbered = self.cells.iter().zip(0..);
        self.numbers.extend(numbered.map(|((node, _), number)| (*node, number)));
        self.cells.clear();
        for &place in &self.marked_places {
            if let Some(marked) = self.marked.get_mut(place) {
                *marked = false;
            }
        }
        self.marked_places.clear();
        self.marked.resize(nodes.box_size(), false);
        for &active in &nodes.places {
            for cell in around(nodes.node(active)) {
                if let Some(place) = nodes.place(&cell)
                    && let Some(marked) = self.marked.get_mut(place)
                    && !*marked
                {
                    *marked = true;
                    self.marked_places.push(place);
                    self.cells.push((cell, self.numbers.get(&cell).copied()));
                }
            }
        }
    }
}
