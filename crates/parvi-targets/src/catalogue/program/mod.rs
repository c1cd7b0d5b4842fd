//! Densities that other programs evaluate, in whatever language.

mod conversation;
mod target;

pub use target::ProgramTarget;
