//! A tile: the cells of a block and of a rim around it, and all nodes that stencils with their first node there touch. Particles add to
//! it and read from it at fixed steps from their first node, and stay in it until they have crossed the rim.

use mpm_kernels::{Lanes, Layout};

use super::block::{digits, edge_bits, locate};

/// Cells around a block that its particles may have moved to.
pub const RIM: i32 = 1;

/// Whether the cells of the schedule are tiles. Beyond three dimensions a tile has more nodes than particles, and the cells are those of
/// the grid. Asked in a `const` block, so that the other way is not even compiled.
pub const fn has_tiles<const D: usize>() -> bool {
    D <= 3
}

/// Nodes per axis of a tile, or of a cell, for stencils with `width` nodes per axis.
pub const fn edges<const D: usize>(width: usize) -> [usize; D] {
    let (bits, mut edges) = (edge_bits::<D>(), [width; D]);
    let mut axis = 0;
    while axis < D {
        if has_tiles::<D>() {
            edges[axis] += (1 << bits[axis]) + 2 * RIM as usize - 1;
        }
        axis += 1;
    }
    edges
}

/// Nodes of a tile, or of a cell.
pub const fn size<const D: usize>(width: usize) -> usize {
    let (edges, mut size, mut axis) = (edges::<D>(width), 1, 0);
    while axis < D {
        size *= edges[axis];
        axis += 1;
    }
    size
}

/// Words of a set of places: of the tile's nodes, or of the block's 64 cells.
pub const fn words<const D: usize>(width: usize) -> usize {
    if has_tiles::<D>() {
        size::<D>(width).div_ceil(64)
    } else {
        1
    }
}

/// A tile in use; coordinates of nodes are lanes, one axis each.
#[derive(Clone, Copy)]
pub struct Tile {
    /// Its first node.
    start: Lanes,
    /// The first nodes of stencils lie from here to below there.
    lower: Lanes,
    upper: Lanes,
}

impl Tile {
    /// No node is in it.
    pub const NONE: Self = Self {
        start: Lanes::ZERO,
        lower: Lanes::new([f64::NAN; 4]),
        upper: Lanes::new([f64::NAN; 4]),
    };

    /// The tile of a block that holds particles up to `rim` cells outside of it.
    pub fn new<const D: usize>(block: &[i32; D], rim: i32) -> Self {
        let bits = edge_bits::<D>();
        let (mut start, mut lower, mut upper) = ([0.0; 4], [f64::NEG_INFINITY; 4], [f64::INFINITY; 4]);
        for a in 0..D {
            let first = block[a] << bits[a];
            start[a] = f64::from(first - RIM);
            lower[a] = f64::from(first - rim);
            upper[a] = f64::from(first + (1 << bits[a]) + rim);
        }
        Self {
            start: Lanes::new(start),
            lower: Lanes::new(lower),
            upper: Lanes::new(upper),
        }
    }

    /// Whether it holds stencils that begin at this node.
    #[inline(always)]
    pub fn holds(&self, node: Lanes) -> bool {
        (node.simd_ge(self.lower) & node.simd_lt(self.upper)).all()
    }

    /// Place in it of a node that it holds.
    #[inline(always)]
    pub fn place<const D: usize>(&self, node: Lanes, layout: &Layout<D>) -> usize {
        const TO_BITS: f64 = (1u64 << 52) as f64; // the integer stands in the low bits of the sum
        let stride = |a: usize| if a < D { layout.stride(a) as f64 } else { 0.0 };
        let strides = Lanes::new([stride(0), stride(1), stride(2), stride(3)]);
        let place = ((node - self.start) * strides).reduce_add();
        usize::from((place + TO_BITS).to_bits() as u16)
    }
}

/// Offsets, in blocks, of all blocks that a tile touches, and for every node of the tile the number of its block among them and its place there.
pub fn nodes<const D: usize>(width: usize) -> (Vec<[i32; D]>, Vec<(u16, u8)>) {
    let edges = edges::<D>(width);
    let mut blocks = Vec::new();
    let nodes = (0..size::<D>(width)).map(|place| {
        let (block, local) = locate(&digits(place, &edges).map(|digit| digit as i32 - RIM));
        let slot = blocks.iter().position(|known| *known == block).unwrap_or_else(|| {
            blocks.push(block);
            blocks.len() - 1
        });
        (slot as u16, local as u8)
    });
    let nodes = nodes.collect();
    (blocks, nodes)
}

/// From the places of the first nodes of stencils to those of all their nodes.
pub fn dilate<const D: usize>(places: &mut [u64], width: usize) {
    let (edges, mut stride) = (edges::<D>(width), 1);
    for axis in (0..D).rev() {
        for _ in 1..width {
            add_shifted(places, stride);
        }
        stride *= edges[axis];
    }
}

/// Add to a set the places `shift` further on.
fn add_shifted(places: &mut [u64], shift: usize) {
    let (whole, bits) = (shift / 64, shift % 64);
    for word in (whole..places.len()).rev() {
        let from = word - whole;
        let mut moved = places[from] << bits;
        if bits > 0 && from > 0 {
            moved |= places[from - 1] >> (64 - bits);
        }
        places[word] |= moved;
    }
}

/// The members of a set.
#[inline(always)]
pub fn members(places: &[u64]) -> impl Iterator<Item = usize> {
    places.iter().enumerate().flat_map(|(word, &bits)| {
        let mut rest = bits;
        std::iter::from_fn(move || {
            let place = 64 * word + rest.trailing_zeros() as usize;
            let any = rest != 0;
            rest &= rest.wrapping_sub(1);
            any.then_some(place)
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn dilation_is_that_of_stencils<const D: usize>(width: usize) {
        let edges = edges::<D>(width);
        let last_cell = edges.map(|edge| edge - width);
        for cell in [[0; D], last_cell, last_cell.map(|c| c / 2)] {
            let place = |node: &[usize; D]| (0..D).fold(0, |place, a| place * edges[a] + node[a]);
            let mut places = vec![0; words::<D>(width)];
            places[place(&cell) / 64] |= 1 << (place(&cell) % 64);
            dilate::<D>(&mut places, width);
            let stencil = (0..width.pow(D as u32)).map(|index| {
                let step = digits(index, &[width; D]);
                place(&std::array::from_fn(|a| cell[a] + step[a]))
            });
            let mut expected: Vec<usize> = stencil.collect();
            expected.sort_unstable();
            assert!(members(&places).eq(expected), "D = {D}, {width} nodes, cell {cell:?}");
        }
    }

    #[test]
    fn stencils_stay_in_their_tile() {
        for width in [2, 3, 4] {
            mpm_tensor::in_dimensions!(dilation_is_that_of_stencils(width), 1, 2, 3);
        }
    }

    #[test]
    fn a_tile_touches_the_blocks_around_its_own() {
        let (blocks, nodes) = nodes::<3>(3);
        assert_eq!((blocks.len(), nodes.len()), (27, 512));
        assert!(blocks.iter().flatten().all(|offset| (-1..=1).contains(offset)));
    }
}
