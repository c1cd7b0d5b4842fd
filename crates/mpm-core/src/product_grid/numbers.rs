//! Numbers of the nodes that particles touch: in the order of their places in a box, where near ones are near in memory, or in the order in which they are first met.

use crate::NO_NODE;
use crate::key_map::KeyMap;

/// Places of the box around all nodes, over what particles touch, beyond which nodes are hashed: a far particle would make the box as large as it likes.
const MOST_PLACES: usize = 2;

/// Numbers by node, and nodes by number.
#[derive(Clone, Debug)]
pub(super) enum NodeNumbers<const D: usize> {
    Boxed(NodeBox<D>),
    Hashed(KeyMap<[i32; D]>),
}

/// A number, or [`NO_NODE`], for every place of a box, the last axis fastest.
#[derive(Clone, Debug)]
pub(super) struct NodeBox<const D: usize> {
    lower: [i32; D],
    extent: [usize; D],
    numbers: Vec<u32>,
    /// Places by number.
    places: Vec<u32>,
}

impl<const D: usize> Default for NodeNumbers<D> {
    fn default() -> Self {
        Self::Hashed(KeyMap::default())
    }
}

impl<const D: usize> NodeNumbers<D> {
    /// No node is known, of stencils of `width` nodes per axis that begin at these nodes.
    pub fn clear(&mut self, bases: &[[i32; D]], width: usize) {
        let touched = bases.len().saturating_mul(width.saturating_pow(D as u32));
        let (mut lower, mut upper) = ([i32::MAX; D], [i32::MIN; D]);
        for base in bases {
            for a in 0..D {
                (lower[a], upper[a]) = (lower[a].min(base[a]), upper[a].max(base[a]));
            }
        }
        let extent = std::array::from_fn(|a| (i64::from(upper[a]) - i64::from(lower[a])).max(0) as usize + width);
        let size = extent.iter().try_fold(1usize, |size, &extent| size.checked_mul(extent));
        let most = touched.saturating_mul(MOST_PLACES).min(NO_NODE as usize);
        match (size.filter(|&size| size <= most), &mut *self) {
            (Some(size), Self::Boxed(own)) => own.clear(lower, extent, size),
            (Some(size), Self::Hashed(_)) => {
                *self = Self::Boxed(NodeBox {
                    lower,
                    extent,
                    numbers: vec![NO_NODE; size],
                    places: Vec::new(),
                });
            }
            (None, Self::Boxed(_)) => *self = Self::default(),
            (None, Self::Hashed(map)) => map.clear(),
        }
    }

    /// How many nodes are known.
    pub fn len(&self) -> usize {
        match self {
            Self::Boxed(own) => own.places.len(),
            Self::Hashed(map) => map.keys().len(),
        }
    }

    /// The number of a node that is known.
    pub fn find(&self, node: &[i32; D]) -> Option<u32> {
        match self {
            Self::Boxed(own) => Some(own.numbers[own.place(node)]).filter(|&number| number != NO_NODE),
            Self::Hashed(map) => map.find(*node),
        }
    }

    /// All of them, in the order of their numbers.
    pub fn nodes(&self) -> Box<dyn Iterator<Item = [i32; D]> + '_> {
        match self {
            Self::Boxed(own) => Box::new(own.places.iter().map(|&place| own.node(place as usize))),
            Self::Hashed(map) => Box::new(map.keys().iter().copied()),
        }
    }

    pub fn storage_bytes(&self) -> usize {
        match self {
            Self::Boxed(own) => 4 * (own.numbers.capacity() + own.places.capacity()),
            Self::Hashed(map) => map.storage_bytes(),
        }
    }
}

impl<const D: usize> NodeBox<D> {
    fn clear(&mut self, lower: [i32; D], extent: [usize; D], size: usize) {
        (self.lower, self.extent) = (lower, extent);
        self.numbers.clear();
        self.numbers.resize(size, NO_NODE);
        self.places.clear();
    }

    /// The place of a node of the box.
    pub fn place(&self, node: &[i32; D]) -> usize {
        (0..D).fold(0, |place, a| {
            place * self.extent[a] + (node[a] - self.lower[a]) as usize
        })
    }

    /// The node at a place.
    fn node(&self, mut place: usize) -> [i32; D] {
        let mut node = self.lower;
        for a in (0..D).rev() {
            node[a] += (place % self.extent[a]) as i32;
            place /= self.extent[a];
        }
        node
    }

    /// Places of a stencil less that of its first node, from the nodes of one that begins at `base`.
    pub fn offsets(&self, base: &[i32; D], stencil: impl Iterator<Item = [i32; D]>) -> Vec<usize> {
        let first = self.place(base);
        stencil.map(|node| self.place(&node) - first).collect()
    }

    /// Number the nodes of the stencils that begin at `bases`.
    pub fn count(&mut self, bases: &[[i32; D]], offsets: &[usize]) {
        for base in bases {
            let first = self.place(base);
            offsets.iter().for_each(|offset| self.numbers[first + offset] = 0);
        }
        for (place, number) in self.numbers.iter_mut().enumerate() {
            if *number != NO_NODE {
                *number = self.places.len() as u32;
                self.places.push(place as u32);
            }
        }
    }

    /// The number of the counted node at a place.
    #[inline(always)]
    pub fn number(&self, place: usize) -> u32 {
        self.numbers[place]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_of_a_box_are_numbered_by_their_places() {
        let bases = [[3, -2], [4, -2], [3, 1], [5, 0]];
        let stencil = |base: [i32; 2]| (0..9).map(move |k| [base[0] + k / 3, base[1] + k % 3]);
        let mut boxed = NodeNumbers::<2>::default();
        boxed.clear(&bases, 3);
        let NodeNumbers::Boxed(own) = &mut boxed else {
            panic!("a small box")
        };
        let offsets = own.offsets(&bases[0], stencil(bases[0]));
        own.count(&bases, &offsets);
        let mut nodes: Vec<[i32; 2]> = bases.into_iter().flat_map(stencil).collect();
        nodes.sort_unstable();
        nodes.dedup();
        assert!(boxed.nodes().eq(nodes.iter().copied()) && boxed.len() == nodes.len());
        for (number, node) in nodes.iter().enumerate() {
            assert_eq!(boxed.find(node), Some(number as u32));
        }
        assert_eq!(
            boxed.find(&[3, 3]),
            Some(nodes.iter().position(|node| *node == [3, 3]).expect("a node") as u32)
        );
        assert_eq!(boxed.find(&[7, -2]), None);
        boxed.clear(&[[0, 0], [i32::MAX / 2, i32::MIN / 2]], 3);
        assert!(matches!(boxed, NodeNumbers::Hashed(_)) && boxed.len() == 0 && boxed.find(&[0, 0]).is_none());
        boxed.clear(&[], 3);
        assert_eq!(boxed.len(), 0);
    }
}
