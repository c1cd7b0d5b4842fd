//! How many points are evaluated at a time: by how long they take, of which no value depends.

use std::time::Duration;

/// Points of one task at most.
pub(super) const BATCH: usize = 256;

/// How long one task is to take: long beside what it takes to begin one.
const TASK: Duration = Duration::from_millis(1);

/// A point may take so many times as long in a smaller task as in a larger one. Where it takes longer twice on end, batches are cheaper than their parts (matrix products); once it may be
/// for other reasons (a program that begins).
const DEARER: u32 = 2;

/// The pace of a density, at first of points that take no time.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pace {
    /// Time that a point takes one thread.
    point: Duration,
    /// Points of one task at least.
    least: usize,
    /// Whether the last time was longer than it should have been.
    is_doubtful: bool,
}

impl Pace {
    /// Of a density that has not been evaluated.
    pub fn unknown() -> Self {
        Self {
            point: Duration::ZERO,
            least: 1,
            is_doubtful: false,
        }
    }

    /// Points of one task, a power of two: batches are padded to such.
    pub fn task(self) -> usize {
        let task = times(TASK, self.point).clamp(self.least, BATCH);
        1 << task.ilog2()
    }

    /// Points that all threads together evaluate within a time, at least a task each.
    pub fn within(self, time: Duration) -> usize {
        times(time, self.point)
            .max(self.task())
            .saturating_mul(mpm_parallel::threads())
    }

    /// So many points, in tasks of so many, took so long. What a part of a task takes says nothing of a point.
    pub fn took(&mut self, points: usize, task: usize, time: Duration) {
        if points < task {
            return;
        }
        let side_by_side = points.div_ceil(task).min(mpm_parallel::threads());
        let [count, side_by_side] = [points, side_by_side].map(|count| u32::try_from(count).unwrap_or(u32::MAX));
        let point = time.saturating_mul(side_by_side) / count.max(1);
        let is_dearer = task < BATCH && point > DEARER * self.point;
        if is_dearer && self.is_doubtful {
            self.least = BATCH;
        }
        if !is_dearer {
            self.point = point;
        }
        self.is_doubtful = is_dearer;
    }
}

/// How many times one goes into the other, at least once.
fn times(whole: Duration, part: Duration) -> usize {
    let times = whole.as_nanos() / part.as_nanos().max(1);
    usize::try_from(times).unwrap_or(usize::MAX).max(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a task takes on one thread, for a number of points that fills all.
    fn timed(pace: &mut Pace, task: Duration) {
        let (points, threads) = (pace.task() * mpm_parallel::threads(), mpm_parallel::threads());
        assert_eq!(points.div_ceil(pace.task()), threads);
        pace.took(points, pace.task(), task);
    }

    #[test]
    fn of_what_takes_long_there_is_little_at_a_time() {
        let mut pace = Pace::unknown();
        assert_eq!(pace.task(), BATCH);
        // 50 µs a point.
        timed(&mut pace, Duration::from_micros(50 * 256));
        assert_eq!((pace.task(), pace.within(TASK)), (16, 20 * mpm_parallel::threads()));
        timed(&mut pace, Duration::from_micros(50 * 16));
        assert_eq!(pace.task(), 16);
        // Part of a batch.
        pace.took(3, 16, Duration::from_secs(1));
        assert_eq!(pace.task(), 16);
    }

    #[test]
    fn a_batch_that_is_cheaper_than_its_parts_stays_whole() {
        let mut pace = Pace::unknown();
        let batch = Duration::from_millis(20);
        timed(&mut pace, batch);
        assert!(pace.task() < BATCH);
        // As long for fewer points.
        timed(&mut pace, batch);
        assert!(pace.task() < BATCH);
        timed(&mut pace, batch);
        assert_eq!(pace.task(), BATCH);
        timed(&mut pace, batch);
        assert_eq!(pace.task(), BATCH);
    }
}
