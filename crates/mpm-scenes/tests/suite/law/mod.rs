//! Laws of scenes.

mod build;
mod laws;
