//! Node numbers by place in a box: one byte a place says whether it is active.

use std::sync::atomic::{AtomicU8, Ordering::Relaxed};

/// Marks first, from any thread; then numbers, in the order of the places.
#[derive(Debug, Default)]
pub struct DenseTable {
    marks: Vec<AtomicU8>,
    /// Number of an active place; of no meaning elsewhere, so that nothing has to be cleared.
    numbers: Vec<u32>,
}

/// Places that are looked at together when numbers are given: most of a large box is empty.
const STRETCH: usize = 32;

impl DenseTable {
    /// A table of `size` places, none of them active.
    pub fn clear(&mut self, size: usize) {
        self.marks.clear();
        self.marks
            .resize_with(size.next_multiple_of(STRETCH), AtomicU8::default);
        if self.numbers.len() < size {
            self.numbers.resize(size, 0);
        }
    }

    /// The marks by place: whatever is not zero is active.
    pub fn marks(&self) -> &[AtomicU8] {
        &self.marks
    }

    /// Number the active places; returns how many there are.
    pub fn number(&mut self) -> usize {
        let mut count = 0;
        for (stretch, marks) in self.marks.chunks_exact_mut(STRETCH).enumerate() {
            if marks.iter_mut().fold(0, |any, mark| any | *mark.get_mut()) == 0 {
                continue;
            }
            for (place, mark) in marks.iter_mut().enumerate() {
                if *mark.get_mut() != 0 {
                    self.numbers[STRETCH * stretch + place] = count;
                    count += 1;
                }
            }
        }
        count as usize
    }

    /// Numbers by place, of no meaning where a place is not active.
    pub fn numbers(&self) -> &[u32] {
        &self.numbers
    }

    /// The active places, in the order of their numbers.
    pub fn active(&self) -> impl Iterator<Item = u64> {
        let active = |&(_, mark): &(usize, &AtomicU8)| mark.load(Relaxed) != 0;
        self.marks
            .iter()
            .enumerate()
            .filter(active)
            .map(|(place, _)| place as u64)
    }

    pub fn storage_bytes(&self) -> usize {
        self.marks.capacity() + 4 * self.numbers.capacity()
    }
}
