//! `[[loads]]`.

use serde::Deserialize;

use super::ShapeTable;

/// `[[loads]]`: a force on particles that are in a region at t = 0, whether they stay there or not.
///
/// A load with a `ramp` grows in proportion to the time up to t = ramp and is constant afterwards; an `amplitude` is any function that is linear between moments.
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
        ramp: Option<f64>,
        /// Instead: times and the shares of the load then.
        amplitude: Option<Vec<[f64; 2]>>,
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
        ramp: Option<f64>,
        /// Instead: times and the shares of the load then.
        amplitude: Option<Vec<[f64; 2]>>,
    },
    /// The body force of a manufactured solution, on all particles.
    Manufactured {
        /// Its name.
        solution: String,
    },
}

/// What the loads on a part of the particles have in common.
pub(crate) struct LoadPart<'a> {
    pub region: &'a ShapeTable,
    pub body: Option<&'a String>,
    /// Force or traction, and its key.
    pub force: (&'static str, &'a [f64]),
    pub ramp: Option<f64>,
    pub amplitude: Option<&'a Vec<[f64; 2]>>,
}

impl LoadTable {
    /// What a load acts on, unless that is all particles.
    pub(crate) fn part(&self) -> Option<LoadPart<'_>> {
        let (region, body, force, ramp, amplitude) = match self {
            Self::PointForce {
                region,
                body,
                force,
                ramp,
                amplitude,
            } => (region, body, ("force", force), ramp, amplitude),
            Self::Traction {
                region,
                body,
                traction,
                ramp,
                amplitude,
                ..
            } => (region, body, ("traction", traction), ramp, amplitude),
            Self::Manufactured { .. } => return None,
        };
        Some(LoadPart {
            region,
            body: body.as_ref(),
            force: (force.0, force.1.as_slice()),
            ramp: *ramp,
            amplitude: amplitude.as_ref(),
        })
    }
}
