//! Checkpoints: a run that was stopped goes on to the same bits.

mod file;
mod saved;

pub(super) use file::{read, refused, write};
pub(super) use saved::{Place, Saved};
