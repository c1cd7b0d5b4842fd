//! Geometry of a block: 64 nodes in any dimension, so that one `u64` says which of them are active.

/// log₂ of the block's edge per axis: six bits are dealt to the axes, the last ones first.
///
/// Edges: 64 | 8·8 | 4·4·4 | 2·2·4·4 | 2·2·2·2·4 | 2⁶ | 1·2⁶ | 1·1·2⁶ for D = 1…8.
pub const fn edge_bits<const D: usize>() -> [u32; D] {
    let mut bits = [0; D];
    let mut axis = 0;
    while axis < D {
        bits[axis] = (6 / D + (axis >= D - 6 % D) as usize) as u32;
        axis += 1;
    }
    bits
}

/// Block coordinates of a node and its place (0…63) inside the block, the last axis fastest.
#[inline(always)]
pub fn locate<const D: usize>(node: &[i32; D]) -> ([i32; D], u32) {
    let bits = const { edge_bits::<D>() };
    let mut block = [0; D];
    let mut local = 0;
    for a in 0..D {
        block[a] = node[a] >> bits[a];
        local = (local << bits[a]) | (node[a] & ((1 << bits[a]) - 1)) as u32;
    }
    (block, local)
}

/// Digits of `number` in the mixed radix `radix`, the last fastest.
pub(super) fn digits<const D: usize>(number: usize, radix: &[usize; D]) -> [usize; D] {
    let mut rest = number;
    let mut digits = [0; D];
    for a in (0..D).rev() {
        digits[a] = rest % radix[a];
        rest /= radix[a];
    }
    digits
}

/// Node coordinates of a place in a block; the inverse of [`locate`].
pub fn node_at<const D: usize>(block: &[i32; D], local: u32) -> [i32; D] {
    let bits = const { edge_bits::<D>() };
    let mut node = [0; D];
    let mut rest = local;
    for a in (0..D).rev() {
        node[a] = (block[a] << bits[a]) | (rest & ((1 << bits[a]) - 1)) as i32;
        rest >>= bits[a];
    }
    node
}

/// Blocks per axis that stencils of `width` nodes with their base in one block can touch.
pub const fn reach<const D: usize>(width: usize) -> [usize; D] {
    let bits = const { edge_bits::<D>() };
    let mut reach = [0; D];
    let mut axis = 0;
    while axis < D {
        reach[axis] = (((1 << bits[axis]) - 1 + width - 1) >> bits[axis]) + 1;
        axis += 1;
    }
    reach
}

/// Blocks that stencils of `width` nodes per axis with their base in one block can touch.
pub const fn slot_count<const D: usize>(width: usize) -> usize {
    let reach = reach::<D>(width);
    let mut count = 1;
    let mut axis = 0;
    while axis < D {
        count *= reach[axis];
        axis += 1;
    }
    count
}

#[cfg(test)]
mod tests {
    use super::*;

    fn round_trips<const D: usize>() {
        let bits = edge_bits::<D>();
        assert_eq!(bits.iter().sum::<u32>(), 6, "a block of dimension {D} has 64 nodes");
        for shift in [-1000, -7, 0, 123_456_789] {
            let node: [i32; D] = std::array::from_fn(|a| shift + 3 * a as i32);
            let (block, local) = locate(&node);
            assert!(local < 64);
            assert_eq!(node_at(&block, local), node);
        }
    }

    #[test]
    fn locate_and_node_at_are_inverse() {
        mpm_tensor::in_dimensions!(round_trips(), 1, 2, 3, 4, 5, 6, 7, 8);
    }

    #[test]
    fn reach_counts_the_blocks_a_stencil_crosses() {
        assert_eq!(reach::<1>(3), [2]);
        assert_eq!(reach::<6>(3), [2; 6]);
        assert_eq!(reach::<6>(4), [3; 6]);
        assert_eq!(reach::<8>(2), [2; 8]);
        assert_eq!(reach::<8>(3), [3, 3, 2, 2, 2, 2, 2, 2]);
    }
}
