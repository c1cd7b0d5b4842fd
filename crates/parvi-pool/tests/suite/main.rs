//! Pools, from the outside. One theme per file.

mod box_modes;
mod common;
mod evidence;
mod hostile;
mod lost_modes;
mod needles;
mod pieces;
mod tails;
mod tape;
