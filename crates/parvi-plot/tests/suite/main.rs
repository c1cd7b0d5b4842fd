//! Figures, pages and statistics, from the outside. One theme per file.

mod cell;
mod figures;
mod heat_map;
mod page;
mod results;
mod statistics;
mod strip;
mod style;
