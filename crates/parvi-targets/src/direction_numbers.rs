//! Direction numbers of the Sobol' sequence.
//!
//! Source: S. Joe, F. Y. Kuo, Constructing Sobol' sequences with better two-dimensional projections, *SIAM Journal on
//! Scientific Computing* 30 (2008) 2635–2654; table `new-joe-kuo-6.21201`, its first 21 dimensions.

/// The largest number of coordinates of a [`SobolSequence`](crate::SobolSequence).
pub const SOBOL_MAXIMUM_DIMENSION: usize = 21;

/// For dimensions 2, 3, …: the inner coefficients of the primitive polynomial as bits, and the initial numbers m_k (their
/// count is the polynomial's degree).
pub(crate) const DIRECTION_NUMBERS: [(u32, &[u32]); SOBOL_MAXIMUM_DIMENSION - 1] = [
    (0, &[1]),
    (1, &[1, 3]),
    (1, &[1, 3, 1]),
    (2, &[1, 1, 1]),
    (1, &[1, 1, 3, 3]),
    (4, &[1, 3, 5, 13]),
    (2, &[1, 1, 5, 5, 17]),
    (4, &[1, 1, 5, 5, 5]),
    (7, &[1, 1, 7, 11, 19]),
    (11, &[1, 1, 5, 1, 1]),
    (13, &[1, 1, 1, 3, 11]),
    (14, &[1, 3, 5, 5, 31]),
    (1, &[1, 3, 3, 9, 7, 49]),
    (13, &[1, 1, 1, 15, 21, 21]),
    (16, &[1, 3, 1, 13, 27, 49]),
    (19, &[1, 1, 1, 15, 7, 5]),
    (22, &[1, 3, 1, 15, 13, 25]),
    (25, &[1, 1, 5, 5, 19, 61]),
    (1, &[1, 3, 7, 11, 23, 15, 103]),
    (4, &[1, 3, 7, 13, 13, 15, 69]),
];
