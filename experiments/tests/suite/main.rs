//! The command `parvi` from the outside, and what is committed beside it. One theme per file.

mod evidence;
mod gaussian_studies;
#[cfg(not(any(feature = "mechanics", feature = "rom")))]
mod left_out;
mod paper_study;
mod random_targets;
#[cfg(unix)]
mod references;
mod report_tables;
#[cfg(feature = "rom")]
mod rom;
mod sample_bad_input;
mod sample_checkpoint;
mod sample_diagnostics;
mod sample_frames;
mod sample_interrupted;
mod sample_output;
mod sample_paper;
mod sample_plots;
mod sample_pool;
#[cfg(unix)]
mod sample_program;
#[cfg(feature = "mechanics")]
mod scene_studies;
#[cfg(feature = "mechanics")]
mod simulate;
mod studies;
mod study_bad_input;
mod study_resume;
mod support;
mod target_studies;
mod time_to_equal_error;
#[cfg(feature = "mechanics")]
mod validation;
