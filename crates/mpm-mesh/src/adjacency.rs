//! Which vertices and cells meet.

use crate::SimplexMesh;

/// Lists of numbers, one after the other in memory (compressed rows).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Lists {
    /// List i is `items[starts[i]..starts[i + 1]]`.
    starts: Vec<usize>,
    items: Vec<u32>,
}

impl Default for Lists {
    fn default() -> Self {
        Self {
            starts: vec![0],
            items: Vec::new(),
        }
    }
}

impl Lists {
    /// Number of lists.
    #[inline(always)]
    pub fn len(&self) -> usize {
        self.starts.len() - 1
    }

    /// Whether there is no list.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// List number `index`.
    #[inline(always)]
    pub fn get(&self, index: usize) -> &[u32] {
        &self.items[self.starts[index]..self.starts[index + 1]]
    }

    /// The lists in order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &[u32]> + Clone {
        self.starts.windows(2).map(|ends| &self.items[ends[0]..ends[1]])
    }

    /// Where list number `index` begins among all items, `index` ≤ `len()`.
    #[inline(always)]
    pub fn start(&self, index: usize) -> usize {
        self.starts[index]
    }

    /// All items, list after list.
    #[inline(always)]
    pub fn items(&self) -> &[u32] {
        &self.items
    }

    /// Adds a list at the end.
    pub(crate) fn push(&mut self, items: &[u32]) {
        self.items.extend_from_slice(items);
        self.starts.push(self.items.len());
    }

    /// `count` lists from (list, item), items of a list in the order in which they come: a counting sort.
    pub(crate) fn from_pairs(count: usize, pairs: impl Iterator<Item = (usize, u32)> + Clone) -> Self {
        let mut starts = vec![0; count + 1];
        for (list, _) in pairs.clone() {
            starts[list + 1] += 1;
        }
        for list in 0..count {
            starts[list + 1] += starts[list];
        }
        let mut items = vec![0; starts[count]];
        let mut cursors = starts.clone();
        for (list, item) in pairs {
            items[cursors[list]] = item;
            cursors[list] += 1;
        }
        Self { starts, items }
    }
}

/// Collects numbers that may repeat.
pub(crate) struct Union {
    /// For each number the last collection that it was in.
    seen: Vec<u32>,
    collection: u32,
    numbers: Vec<u32>,
}

impl Union {
    /// For numbers below `bound`, up to 2³² − 1 times.
    pub fn new(bound: usize) -> Self {
        Self {
            seen: vec![0; bound],
            collection: 0,
            numbers: Vec::new(),
        }
    }

    /// The numbers, each once, in ascending order.
    pub fn of(&mut self, numbers: impl Iterator<Item = u32>) -> &[u32] {
        self.collection += 1;
        self.numbers.clear();
        for number in numbers {
            if std::mem::replace(&mut self.seen[number as usize], self.collection) != self.collection {
                self.numbers.push(number);
            }
        }
        self.numbers.sort_unstable();
        &self.numbers
    }
}

impl<const D: usize> SimplexMesh<D> {
    /// For each vertex the cells that it belongs to, in ascending order.
    pub fn vertex_cells(&self) -> Lists {
        let numbered = (0u32..).zip(self.cells());
        let pairs = numbered.flat_map(|(number, cell)| cell.iter().map(move |&vertex| (vertex as usize, number)));
        Lists::from_pairs(self.vertices().len(), pairs)
    }

    /// For each vertex the vertices that an edge joins to it, in ascending order, itself not among them.
    pub fn vertex_neighbours(&self) -> Lists {
        let cells = self.vertex_cells();
        let mut lists = Lists::default();
        let mut union = Union::new(self.vertices().len());
        for (vertex, cells) in (0u32..).zip(cells.iter()) {
            let members = cells.iter().flat_map(|&cell| self.cell(cell as usize)).copied();
            lists.push(union.of(members.filter(|&other| other != vertex)));
        }
        lists
    }

    /// The edges, each once, the smaller vertex first, in ascending order.
    pub fn edges(&self) -> Vec<[u32; 2]> {
        let neighbours = self.vertex_neighbours();
        let numbered = (0u32..).zip(neighbours.iter());
        numbered
            .flat_map(|(a, others)| others.iter().filter(move |&&b| a < b).map(move |&b| [a, b]))
            .collect()
    }
}
