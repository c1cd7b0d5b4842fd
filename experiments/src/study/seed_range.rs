//! Consecutive seeds.

use parvi_options::Bounded;
use serde::Deserialize;

/// `{ first = 0, count = 50 }`.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SeedRange {
    /// The first.
    pub first: u32,
    /// Their number.
    pub count: Bounded<1, 1_000_000>,
}

impl SeedRange {
    /// The seeds.
    pub fn all(&self) -> impl Iterator<Item = u64> + use<> {
        (u64::from(self.first)..).take(self.count.get())
    }
}
