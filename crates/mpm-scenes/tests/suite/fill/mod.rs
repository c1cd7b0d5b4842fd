//! Particles that fill shapes.

mod random;
mod regular;
mod rings;
