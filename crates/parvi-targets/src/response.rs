//! What a regression observes: a yes or no, or a count.

use std::fmt::Debug;

use statrs::function::factorial::ln_factorial;

use crate::{Link, Logarithm, Logit};

/// A response y and how it enters the log likelihood of a row x: a(y) xᵀβ + ℓ(b(y) xᵀβ) + c(y), with the [`Link`]'s ℓ.
///
/// Two kinds exist. For a yes or no (`bool`) the sign b = ±1 makes one ℓ serve both answers; a = c = 0. For a count (`u32`)
/// with mean e^t, log p(y) = y t − e^t − log y!: a = y, b = 1, c = −log y!.
pub trait Response: Copy + Debug + PartialEq + Send + Sync + 'static {
    /// The link by which the data of such responses are checked; whether a flat prior gives a proper posterior depends on
    /// the data only.
    type Canonical: Link<Response = Self>;

    /// What a number has to be to be such a response, in words.
    const ALLOWED: &'static str;

    /// The response that a number stands for.
    fn from_number(value: f64) -> Option<Self>;

    /// b(y), 1 or −1.
    fn sign(self) -> f64;

    /// a(y).
    fn linear(self) -> f64;

    /// c(y).
    fn constant(self) -> f64;

    /// The sign of the far end of b(y) xᵀβ towards which the likelihood of the row does not fall, where there is one. A
    /// direction of β in which no row falls is one in which a flat prior leaves the posterior improper.
    fn free_side(self) -> Option<f64>;
}

impl Response for bool {
    type Canonical = Logit;

    const ALLOWED: &'static str = "0 or 1";

    fn from_number(value: f64) -> Option<Self> {
        (value == 0.0 || value == 1.0).then_some(value == 1.0)
    }

    fn sign(self) -> f64 {
        if self { 1.0 } else { -1.0 }
    }

    fn linear(self) -> f64 {
        0.0
    }

    fn constant(self) -> f64 {
        0.0
    }

    fn free_side(self) -> Option<f64> {
        Some(1.0)
    }
}

impl Response for u32 {
    type Canonical = Logarithm;

    const ALLOWED: &'static str = "a whole number from 0 to 4294967295";

    fn from_number(value: f64) -> Option<Self> {
        let count = value as u32;
        (f64::from(count) == value).then_some(count)
    }

    fn sign(self) -> f64 {
        1.0
    }

    fn linear(self) -> f64 {
        f64::from(self)
    }

    fn constant(self) -> f64 {
        -ln_factorial(u64::from(self))
    }

    /// No events: the mean may fall to 0.
    fn free_side(self) -> Option<f64> {
        (self == 0).then_some(-1.0)
    }
}
