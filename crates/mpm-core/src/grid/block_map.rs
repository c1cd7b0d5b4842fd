//! Hash map from block coordinates to block numbers 0, 1, 2, …

use hashbrown::HashTable;

/// Numbers blocks in the order in which they are first asked for. Coordinates are compared whole, so that no packing
/// limits the range: 10⁴ nodes per axis in D = 6 would need 84 bits.
#[derive(Clone, Debug, Default)]
pub struct BlockMap<const D: usize> {
    table: HashTable<u32>,
    coordinates: Vec<[i32; D]>,
}

impl<const D: usize> BlockMap<D> {
    /// Forget all blocks, keep the memory.
    pub fn clear(&mut self) {
        self.table.clear();
        self.coordinates.clear();
    }

    /// The number of a block; a new one if it has none yet.
    #[inline]
    pub fn number(&mut self, block: [i32; D]) -> u32 {
        let coordinates = &mut self.coordinates;
        let entry = self.table.entry(
            hash(&block),
            |&number| coordinates[number as usize] == block,
            |&number| hash(&coordinates[number as usize]),
        );
        *entry
            .or_insert_with(|| {
                coordinates.push(block);
                coordinates.len() as u32 - 1
            })
            .get()
    }

    /// Coordinates by number.
    pub fn coordinates(&self) -> &[[i32; D]] {
        &self.coordinates
    }

    pub fn storage_bytes(&self) -> usize {
        self.table.allocation_size() + self.coordinates.capacity() * size_of::<[i32; D]>()
    }
}

/// Multiply–rotate over the coordinates, folded once at the end: the table reads the high and the low bits.
#[inline(always)]
fn hash<const D: usize>(block: &[i32; D]) -> u64 {
    const ODD: u64 = 0x9E37_79B9_7F4A_7C15; // 2⁶⁴ / golden ratio
    let mut state = 0u64;
    for &c in block {
        state = (state.rotate_left(23) ^ u64::from(c as u32)).wrapping_mul(ODD);
    }
    state ^ (state >> 32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashMap;

    #[test]
    fn numbers_agree_with_the_standard_map() {
        let mut ours = BlockMap::<3>::default();
        let mut theirs = HashMap::new();
        for i in 0..20_000i32 {
            let block = [i % 17 - 8, (i * 7) % 29 - 14, (i * i) % 31 - 15];
            let next = theirs.len() as u32;
            let expected = *theirs.entry(block).or_insert(next);
            assert_eq!(ours.number(block), expected);
        }
        assert_eq!(ours.coordinates().len(), theirs.len());
        ours.clear();
        assert_eq!(ours.number([1, 2, 3]), 0);
    }

    #[test]
    fn neighbouring_blocks_spread_over_the_table() {
        let mut low = HashMap::<u64, u32>::new();
        for i in 0..64 {
            for j in 0..64 {
                *low.entry(hash(&[i - 32, j - 32, 0, 0, 0, 5]) % 4096).or_default() += 1;
            }
        }
        // 4096 keys over 4096 slots: Poisson(1); a slot with more than 9 has probability 1e-7 each.
        assert!(low.values().all(|&count| count <= 9));
        assert!(low.len() > 2300);
    }
}
