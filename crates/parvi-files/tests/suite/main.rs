//! Files of runs. One theme per file.

mod errors;
#[cfg(feature = "npy")]
mod frames;
mod pictures;
