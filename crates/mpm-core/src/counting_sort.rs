//! Sorting particles by a small integer key.

use std::ops::Range;

/// Keys below which one thread does it all.
const PARALLEL_THRESHOLD: usize = 1 << 14;

/// Stable counting sort: afterwards `order` lists the indices of `keys` by ascending key, and `starts[k]..starts[k + 1]` are
/// the places in it of those with key k < `bins`.
///
/// Threads share the bins, not the keys: each reads all keys and handles those of its own bins, whose places are a stretch
/// of its own.
pub fn counting_sort(keys: &[u32], bins: usize, starts: &mut Vec<u32>, order: &mut Vec<u32>, cursors: &mut Vec<u32>) {
    starts.clear();
    starts.resize(bins + 1, 0);
    let threads = rayon::current_num_threads();
    let depth = if keys.len() < PARALLEL_THRESHOLD {
        0
    } else {
        threads.next_power_of_two().ilog2()
    };
    count(keys, 0..bins, &mut starts[1..], depth);
    let mut total = 0;
    for start in starts.iter_mut() {
        total += *start;
        *start = total;
    }
    order.resize(keys.len(), 0);
    cursors.clear();
    cursors.extend_from_slice(&starts[..bins]);
    place(keys, starts, 0..bins, cursors, order, depth);
}

/// Count the keys that lie in `bins`.
fn count(keys: &[u32], bins: Range<usize>, counts: &mut [u32], depth: u32) {
    if depth > 0 && bins.len() > 1 {
        let middle = bins.start + bins.len() / 2;
        let (left, right) = counts.split_at_mut(middle - bins.start);
        rayon::join(
            || count(keys, bins.start..middle, left, depth - 1),
            || count(keys, middle..bins.end, right, depth - 1),
        );
        return;
    }
    for &key in keys {
        if let Some(count) = counts.get_mut((key as usize).wrapping_sub(bins.start)) {
            *count += 1;
        }
    }
}

/// Write the indices of the keys in `bins` to `order`, which begins at the first place of the first bin.
fn place(keys: &[u32], starts: &[u32], bins: Range<usize>, cursors: &mut [u32], order: &mut [u32], depth: u32) {
    let first = starts[bins.start];
    if depth > 0 && bins.len() > 1 {
        let half = first + order.len() as u32 / 2;
        let middle = bins.start + starts[bins.start..bins.end].partition_point(|&start| start < half);
        let middle = middle.clamp(bins.start + 1, bins.end - 1);
        let (left_cursors, right_cursors) = cursors.split_at_mut(middle - bins.start);
        let (left, right) = order.split_at_mut((starts[middle] - first) as usize);
        rayon::join(
            || place(keys, starts, bins.start..middle, left_cursors, left, depth - 1),
            || place(keys, starts, middle..bins.end, right_cursors, right, depth - 1),
        );
        return;
    }
    for (index, &key) in keys.iter().enumerate() {
        if let Some(cursor) = cursors.get_mut((key as usize).wrapping_sub(bins.start)) {
            order[(*cursor - first) as usize] = index as u32;
            *cursor += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_the_standard_stable_sort() {
        for (length, bins) in [(0, 1), (1, 1), (100, 7), (50_000, 3), (50_000, 1000), (20_000, 60_000)] {
            let keys: Vec<u32> = (0..length).map(|i: u32| i.wrapping_mul(2_654_435_761) % bins).collect();
            let mut expected: Vec<u32> = (0..length).collect();
            expected.sort_by_key(|&i| keys[i as usize]);
            for threads in [1, 3] {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                let (mut starts, mut order, mut cursors) = (vec![9; 5], vec![9; 5], vec![9; 5]);
                pool.install(|| counting_sort(&keys, bins as usize, &mut starts, &mut order, &mut cursors));
                assert_eq!(order, expected);
                for bin in 0..bins {
                    let range = starts[bin as usize] as usize..starts[bin as usize + 1] as usize;
                    assert!(order[range].iter().all(|&i| keys[i as usize] == bin));
                }
            }
        }
    }
}
