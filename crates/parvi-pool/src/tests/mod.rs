//! What a run is made of.

mod folds;
mod kept_evidence;
mod level_set;
mod mixtures;
mod reach;
mod ridge;
