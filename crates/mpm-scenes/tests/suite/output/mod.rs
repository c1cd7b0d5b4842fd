//! Files of runs.

mod earlier_frames;
mod series_file;
mod vtu;
