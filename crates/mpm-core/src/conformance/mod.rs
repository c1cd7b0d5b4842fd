//! What every [`Basis`](crate::Basis) must do, as assertions for the tests of whoever writes one. A basis that does not do it panics.

mod any_basis;
mod layout;
mod transfers;

pub use any_basis::{AnyBasis, Located, Sent};
pub use layout::layout_is_sound;
pub use transfers::transfers_are_sums;
