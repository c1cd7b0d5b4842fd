use mpm_core::Amplitude;

/// An acceleration of chosen particles.
#[derive(Clone, Debug, PartialEq)]
pub struct DirectLoad<const D: usize> {
    /// The full acceleration f_p / m_p, by the particle's number; zero for particles that it does not act on.
    pub accelerations: Vec<[f64; D]>,
    /// The share of it that acts.
    pub amplitude: Amplitude,
}
