//! `[[loads]]`.

use serde::Deserialize;

use super::ShapeTable;

/// `[[loads]]`: a force on particles that are in a region at t = 0, whether they stay there or not.
///
/// A load with a `ramp` grows in proportion to the time up to t = ramp and is constant afterwards.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum LoadTable {
    /// A total force, shared by the particles in the region in proportion to their masses.
    PointForce {
        /// The region.
        region: ShapeTable,
        /// The body that it acts on. Default: all.
        body: Option<String>,
        /// The total force.
        force: Vec<f64>,
        /// Time over which it grows. Default 0.
        #[serde(default)]
        ramp: f64,
    },
    /// A force t per area, spread over a layer of thickness ℓ below the surface: every particle in the region feels t V⁰_p / ℓ.
    Traction {
        /// The layer.
        region: ShapeTable,
        /// The body that it acts on. Default: all.
        body: Option<String>,
        /// t.
        traction: Vec<f64>,
        /// ℓ.
        thickness: f64,
        /// Time over which it grows. Default 0.
        #[serde(default)]
        ramp: f64,
    },
    /// The body force of a manufactured solution, on all particles.
    Manufactured {
        /// Its name.
        solution: String,
    },
}
