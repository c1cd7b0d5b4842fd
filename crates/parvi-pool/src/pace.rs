//! How many points are evaluated at a time: by how long they take, of which no value depends.

use std::time::Duration;

/// How long one task is to take: long beside what it takes to begin one.
const TASK: Duration = Duration::from_millis(1);

/// The pace of one kind of evaluation, at first of points that take no time.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Pace {
    /// Time that a point takes one thread.
    point: Duration,
}

impl Pace {
    /// Points of one task, at least one.
    pub fn task(self) -> usize {
        times(TASK, self.point)
    }

    /// Points that all threads together evaluate within a time, at least one each.
    pub fn within(self, time: Duration) -> usize {
        times(time, self.point).saturating_mul(mpm_parallel::threads())
    }

    /// So many points, in tasks of so many, took so long.
    pub fn took(&mut self, points: usize, task: usize, time: Duration) {
        let side_by_side = points.div_ceil(task).min(mpm_parallel::threads());
        let [points, side_by_side] = [points, side_by_side].map(|count| u32::try_from(count).unwrap_or(u32::MAX));
        self.point = time.saturating_mul(side_by_side) / points.max(1);
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

    #[test]
    fn of_what_takes_long_there_is_little_at_a_time() {
        let threads = mpm_parallel::threads();
        let mut pace = Pace::default();
        assert!(pace.task() >= 1_000_000);
        // 2,000 points of 50 µs.
        pace.took(2000, 2000, Duration::from_millis(100));
        assert_eq!((pace.task(), pace.within(TASK)), (20, 20 * threads));
        pace.took(3, 1, Duration::from_secs(3));
        assert_eq!((pace.task(), pace.within(TASK)), (1, threads));
    }
}
