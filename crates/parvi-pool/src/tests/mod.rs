//! What a run is made of.

mod folds;
mod level_set;
mod mixtures;
mod reach;
mod ridge;
