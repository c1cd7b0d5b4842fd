//! What the mechanics promise, one theme per file.

#[macro_use]
mod scenes;

mod basis_conformance;
mod basis_gradients;
mod boundaries;
mod conservation;
mod contact;
mod deformation;
mod determinism;
mod dissipation;
mod energy_budget;
mod errors;
mod force_identities;
mod golden_counters;
mod grid_oracle;
mod moments;
mod naive_step;
mod narrow_rooms;
mod optional_fields;
mod product_grid;
mod sparse_memory;
mod step_control;
mod step_oracle;
mod velocity_filter;
