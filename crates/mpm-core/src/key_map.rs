//! Hash map from integer keys to the numbers 0, 1, 2, …

use hashbrown::HashTable;

/// What names a node, a cell or a block: coordinates, whole or packed into one integer where their range allows it.
pub trait Key: Copy + Eq {
    /// 64 bits of which the table reads the high and the low ones.
    fn hash(&self) -> u64;
}

const ODD: u64 = 0x9E37_79B9_7F4A_7C15; // 2⁶⁴ / golden ratio

impl Key for u64 {
    #[inline(always)]
    fn hash(&self) -> u64 {
        let state = self.wrapping_mul(ODD);
        state ^ (state >> 32)
    }
}

/// Whole coordinates, which limit no range: 10⁴ nodes per axis in D = 6 would need 84 bits.
impl<const D: usize> Key for [i32; D] {
    /// Multiply–rotate over the coordinates, folded once at the end.
    #[inline(always)]
    fn hash(&self) -> u64 {
        let mut state = 0u64;
        for &c in self {
            state = (state.rotate_left(23) ^ u64::from(c as u32)).wrapping_mul(ODD);
        }
        state ^ (state >> 32)
    }
}

/// Numbers keys in the order in which they are first asked for.
#[derive(Clone, Debug)]
pub struct KeyMap<K> {
    table: HashTable<u32>,
    keys: Vec<K>,
}

impl<K> Default for KeyMap<K> {
    fn default() -> Self {
        Self {
            table: HashTable::new(),
            keys: Vec::new(),
        }
    }
}

impl<K: Key> KeyMap<K> {
    /// Forget all keys, keep the memory.
    pub fn clear(&mut self) {
        self.table.clear();
        self.keys.clear();
    }

    /// The number of a key; a new one if it has none yet.
    #[inline]
    pub fn number(&mut self, key: K) -> u32 {
        let keys = &mut self.keys;
        let entry = self.table.entry(
            key.hash(),
            |&number| keys[number as usize] == key,
            |&number| keys[number as usize].hash(),
        );
        *entry
            .or_insert_with(|| {
                keys.push(key);
                keys.len() as u32 - 1
            })
            .get()
    }

    /// The number of a key that has one.
    #[inline]
    pub fn find(&self, key: K) -> Option<u32> {
        let found = self.table.find(key.hash(), |&number| self.keys[number as usize] == key);
        found.copied()
    }

    /// Keys by number.
    pub fn keys(&self) -> &[K] {
        &self.keys
    }

    pub fn storage_bytes(&self) -> usize {
        self.table.allocation_size() + self.keys.capacity() * size_of::<K>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashMap;

    #[test]
    fn numbers_agree_with_the_standard_map() {
        let (mut whole, mut packed) = (KeyMap::<[i32; 3]>::default(), KeyMap::<u64>::default());
        let mut theirs = HashMap::new();
        for i in 0..20_000i32 {
            let key = [i % 17 - 8, (i * 7) % 29 - 14, (i * i) % 31 - 15];
            let next = theirs.len() as u32;
            let expected = *theirs.entry(key).or_insert(next);
            assert_eq!(whole.number(key), expected);
            let linear = key.iter().fold(0, |sum, &c| 100 * sum + (c + 50) as u64);
            assert_eq!(packed.number(linear), expected);
        }
        assert_eq!(whole.keys().len(), theirs.len());
        whole.clear();
        assert_eq!(whole.number([1, 2, 3]), 0);
    }

    #[test]
    fn neighbouring_keys_spread_over_the_table() {
        let spread = |hash: &dyn Fn(i32, i32) -> u64| {
            let mut low = HashMap::<u64, u32>::new();
            for i in 0..64 {
                for j in 0..64 {
                    *low.entry(hash(i, j) % 4096).or_default() += 1;
                }
            }
            // 4096 keys over 4096 slots: Poisson(1); a slot with more than 9 has probability 1e-7 each.
            assert!(low.values().all(|&count| count <= 9));
            assert!(low.len() > 2300);
        };
        spread(&|i, j| [i - 32, j - 32, 0, 0, 0, 5].hash());
        spread(&|i, j| (1000 * i as u64 + j as u64).hash());
    }
}
