//! What is known about the machine: processor, memory, time of day.

use std::fs;
use std::time::{SystemTime, UNIX_EPOCH};

/// The key of the rise of the process's resident memory while it sampled; Linux only.
pub const PEAK_MEMORY_KEY: &str = "peak_memory_bytes";

/// The processor's model name; `None` where the system does not say.
pub fn processor() -> Option<String> {
    let text = fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = text.lines().find(|line| line.starts_with("model name"))?;
    Some(line.split_once(':')?.1.trim().to_owned())
}

/// The time now as an ISO 8601 string in UTC, e.g. `2026-01-31T23:59:59Z`.
pub fn utc_now() -> String {
    let elapsed = SystemTime::now().duration_since(UNIX_EPOCH);
    utc(elapsed.map_or(0, |elapsed| elapsed.as_secs()))
}

/// Seconds since 1970 as an ISO 8601 string.
fn utc(seconds: u64) -> String {
    let (days, rest) = (seconds / 86_400, seconds % 86_400);
    // Years that begin in March put the leap day last; 719 468 days lie between 0000-03-01 and 1970-01-01.
    let shifted = days + 719_468;
    let (era, day_of_era) = (shifted / 146_097, shifted % 146_097);
    let year_of_era = (day_of_era - day_of_era / 1_460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let month_from_march = (5 * day_of_year + 2) / 153;
    let day = day_of_year - (153 * month_from_march + 2) / 5 + 1;
    let month = (month_from_march + 2) % 12 + 1;
    let year = era * 400 + year_of_era + u64::from(month <= 2);
    let (hour, minute, second) = (rest / 3_600, rest / 60 % 60, rest % 60);
    format!("{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}Z")
}

/// Measures how far the resident memory of the process rises above its level at the beginning.
///
/// Only on Linux; elsewhere the answer is `None`.
pub struct MemoryGauge {
    resident_before: Option<u64>,
}

impl MemoryGauge {
    /// Resets the peak and notes the level.
    pub fn begin() -> Self {
        // "5" resets VmHWM to the resident set size (proc_pid_clear_refs(5)).
        let reset = fs::write("/proc/self/clear_refs", "5").is_ok();
        Self {
            resident_before: reset.then(|| status_bytes("VmRSS:")).flatten(),
        }
    }

    /// Bytes of the peak since [`begin`](Self::begin) above the level at that moment.
    pub fn peak_bytes(&self) -> Option<u64> {
        Some(status_bytes("VmHWM:")?.saturating_sub(self.resident_before?))
    }
}

/// An entry of /proc/self/status, which is in kibibytes.
fn status_bytes(key: &str) -> Option<u64> {
    let text = fs::read_to_string("/proc/self/status").ok()?;
    let line = text.lines().find(|line| line.starts_with(key))?;
    let kibibytes: u64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kibibytes * 1024)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_become_dates() {
        assert_eq!(utc(0), "1970-01-01T00:00:00Z");
        assert_eq!(utc(951_782_400), "2000-02-29T00:00:00Z");
        assert_eq!(utc(1_767_225_599), "2025-12-31T23:59:59Z");
    }

    #[test]
    fn the_gauge_sees_what_was_touched() {
        let gauge = MemoryGauge::begin();
        let block = vec![1u8; 64 << 20];
        let Some(peak) = gauge.peak_bytes() else { return };
        assert!(block.iter().all(|&byte| byte == 1));
        assert!(peak >= 60 << 20, "{peak}");
    }
}
