//! Samplers, from the outside. One theme per file.

mod another_target;
mod bent_targets;
mod cached_scores;
mod calibrated;
mod calls;
mod half_lines;
mod improper;
#[cfg(feature = "nuts")]
mod nuts;
mod observed;
mod on_mesh;
mod own_targets;
mod paper_as_written;
mod paper_guards;
mod paper_materials;
mod paper_oracle;
mod paper_rest;
mod paper_watch;
mod repetition;
mod robustness;
mod samplers;
mod smc;
mod stein_thinning;
mod support;
mod support_points;
mod survey;
