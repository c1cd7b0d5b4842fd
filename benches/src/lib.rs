//! Scenes that benchmarks share. Criterion benchmarks live in `benches/benches`, plain ones in `benches/src/bin`, built
//! without parvi and criterion, in seconds.

pub mod arguments;
pub mod elastic_block;
pub mod mesh_block;
pub mod processor_time;
mod say;

pub use say::say;
