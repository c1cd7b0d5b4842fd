//! When something is written: at multiples of an interval, and at the end.

/// Times k · interval, k = 1, 2, …, and the end of the run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Schedule {
    interval: f64,
    end: f64,
}

/// Times this close, relative to the interval, are the same: 3 · 0.1 and 1 · 0.3 are not to the bit.
pub(super) const SAME: f64 = 1e-9;

impl Schedule {
    pub fn new(interval: f64, end: f64) -> Self {
        Self { interval, end }
    }

    /// The time of event number k; that of number 0 is 0, and none is after the end.
    pub fn time(&self, k: u64) -> f64 {
        let time = k as f64 * self.interval;
        if time > self.end - SAME * self.interval {
            self.end
        } else {
            time
        }
    }

    /// Number of the first event after this time.
    pub fn next(&self, time: f64) -> u64 {
        let after = time + SAME * self.interval;
        let guess = (time / self.interval).floor().max(0.0) as u64;
        let mut later = guess.saturating_sub(1)..;
        later
            .find(|&k| self.time(k) > after || self.time(k) >= self.end)
            .unwrap_or(guess)
    }

    /// Number of the event that is at this time, if there is one.
    pub fn at(&self, time: f64) -> Option<u64> {
        let guess = (time / self.interval).round().max(0.0) as u64;
        (guess.saturating_sub(1)..=guess + 1).find(|&k| (self.time(k) - time).abs() <= SAME * self.interval)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn events_are_multiples_and_the_end() {
        let schedule = Schedule::new(0.3, 1.0);
        let times: Vec<f64> = (0..6).map(|k| schedule.time(k)).collect();
        assert_eq!(times, [0.0, 0.3, 0.6, 0.3 * 3.0, 1.0, 1.0]);
        let mut time = 0.0;
        let mut seen = Vec::new();
        while time < 1.0 {
            let next = schedule.next(time);
            time = schedule.time(next);
            assert_eq!(schedule.at(time), Some(next));
            seen.push(next);
        }
        assert_eq!(seen, [1, 2, 3, 4]);
        assert_eq!(schedule.at(0.1), None);
    }

    #[test]
    fn a_multiple_that_rounding_puts_beside_the_end_is_the_end() {
        let schedule = Schedule::new(0.1, 0.3);
        assert_eq!(schedule.time(3), 0.3);
        assert_eq!(schedule.next(schedule.time(2)), 3);
        assert_eq!(schedule.at(0.3), Some(3));
    }

    #[test]
    fn events_of_two_schedules_that_rounding_parts_are_one() {
        let (tenths, thirds) = (Schedule::new(0.1, 1.0), Schedule::new(0.3, 1.0));
        assert!(tenths.time(3) > thirds.time(1));
        assert_eq!(tenths.at(thirds.time(1)), Some(3));
        assert_eq!(tenths.next(thirds.time(1)), 4);
    }
}
