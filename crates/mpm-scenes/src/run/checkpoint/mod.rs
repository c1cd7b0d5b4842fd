//! Checkpoints: a run that was stopped goes on to the same bits.

mod file;
mod identity;
mod saved;

pub(super) use file::{read, refused, write};
pub(super) use identity::{earlier_end, identity};
pub(super) use saved::Saved;
