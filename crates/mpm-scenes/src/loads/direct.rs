/// An acceleration of chosen particles that grows over a time and then stays.
#[derive(Clone, Debug, PartialEq)]
pub struct DirectLoad<const D: usize> {
    /// The full acceleration f_p / m_p, by the particle's number; zero for particles that it does not act on.
    pub accelerations: Vec<[f64; D]>,
    /// Time over which it grows in proportion to t; 0: it is there at once.
    pub ramp: f64,
}

impl<const D: usize> DirectLoad<D> {
    /// Share of the full load at time t: min(t / ramp, 1).
    pub fn share(&self, time: f64) -> f64 {
        if time < self.ramp { time / self.ramp } else { 1.0 }
    }
}
