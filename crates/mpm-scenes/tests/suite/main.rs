//! Scenes as a user writes them: what is refused, what is written, and that a run can be stopped anywhere.

mod axes;
mod bad_meshes;
mod bad_scenes;
mod budget;
mod contact;
mod damping;
mod document;
mod facets;
mod failures;
mod fill;
mod forces;
mod held_facets;
mod kinematic;
mod law;
mod limits;
mod on_meshes;
mod output;
mod placement;
mod readings;
mod refusal;
mod resume;
mod runs;
mod scenes;
mod shapes;
mod tractions;
mod volume_averaging;
