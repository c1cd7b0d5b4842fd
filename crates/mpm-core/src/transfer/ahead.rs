//! Values of the next particles, worked out for several at once.

use std::ops::Range;

/// Particles in a batch, unless a cell has more.
const BATCH: usize = 32;

/// What can be worked out for several particles at once. A trait and not a closure, so that nothing is left of it where nothing is wanted.
pub(crate) trait Prepare: Copy + Sync {
    /// What a particle gets.
    type Value;

    /// Whether there is anything to work out.
    const WANTED: bool;

    /// Write the values of a batch of particles.
    fn prepare(&self, particles: Range<usize>, values: &mut Vec<Self::Value>);
}

/// Nothing.
impl Prepare for () {
    type Value = ();
    const WANTED: bool = false;

    fn prepare(&self, _: Range<usize>, _: &mut Vec<()>) {}
}

/// Values of consecutive particles.
pub(super) struct Ahead<I> {
    values: Vec<I>,
    first: usize,
}

impl<I> Default for Ahead<I> {
    fn default() -> Self {
        Self {
            values: Vec::new(),
            first: 0,
        }
    }
}

impl<I> Ahead<I> {
    /// Have a batch prepared where not all `particles` of a cell have been reached; no particle is behind `end`.
    #[inline(always)]
    pub fn reach(&mut self, particles: &Range<usize>, end: usize, source: &impl Prepare<Value = I>) {
        let reached = self.first..self.first + self.values.len();
        if particles.start < reached.start || particles.end > reached.end {
            self.first = particles.start;
            let batch = particles.start..end.min(particles.start + BATCH).max(particles.end);
            source.prepare(batch, &mut self.values);
        }
    }

    /// The value of a particle.
    #[inline(always)]
    pub fn get(&self, particle: usize) -> Option<&I> {
        self.values.get(particle - self.first)
    }
}
