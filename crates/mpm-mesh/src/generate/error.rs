use crate::MeshError;

/// Why a mesh was not generated.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GenerationError {
    /// A number is outside its range.
    #[error("{name} is {value}, it should be {requirement}")]
    InvalidParameter {
        /// The parameter.
        name: &'static str,
        /// What was given.
        value: f64,
        /// What it should be.
        requirement: &'static str,
    },
    /// An outline has fewer than three corners.
    #[error("outline {outline} needs three corners and has {corners}")]
    TooFewCorners {
        /// The outline.
        outline: usize,
        /// How many corners it has.
        corners: usize,
    },
    /// A corner is not finite, or too far out or too near zero for exact predicates.
    #[error("corner {corner} of outline {outline} is at {position:?}")]
    InvalidCorner {
        /// The outline.
        outline: usize,
        /// The corner.
        corner: usize,
        /// Where it is.
        position: [f64; 2],
    },
    /// Edges of outlines cross or touch, so that they do not bound a domain.
    #[error("the outlines cross or touch themselves{}", near(.position))]
    CrossingOutlines {
        /// A point near the place, where it is known.
        position: Option<[f64; 2]>,
    },
    /// The mesh would have more cells than are sensible.
    #[error("edges of {length} give about {cells:.1e} cells, the limit is {limit:.0e}")]
    TooFine {
        /// The length asked for.
        length: f64,
        /// Estimated number of cells.
        cells: f64,
        /// The limit.
        limit: f64,
    },
    /// No layer of valid cells was found outside the boundary at a vertex.
    #[error("no outer layer fits at vertex {vertex}")]
    NoLayer {
        /// The vertex.
        vertex: usize,
    },
    /// What was generated is not a valid mesh: the domain has features far smaller than the cells.
    #[error("the generated mesh is not valid: {0}")]
    Mesh(#[from] MeshError),
}

fn near(position: &Option<[f64; 2]>) -> String {
    position.map_or_else(String::new, |[x, y]| format!(" near ({x}, {y})"))
}

impl GenerationError {
    /// Errs unless `value` is positive and finite.
    pub(super) fn check_positive(name: &'static str, value: f64) -> Result<(), Self> {
        if value > 0.0 && value.is_finite() {
            return Ok(());
        }
        Err(Self::InvalidParameter {
            name,
            value,
            requirement: "positive and finite",
        })
    }

    /// Errs unless an angle is finite.
    pub(super) fn check_angle(angle: f64) -> Result<(), Self> {
        if angle.is_finite() {
            return Ok(());
        }
        Err(Self::InvalidParameter {
            name: "angle",
            value: angle,
            requirement: "finite",
        })
    }

    /// A random number, if it is one in [0, 1).
    pub(super) fn check_random(value: f64) -> Result<f64, Self> {
        if (0.0..1.0).contains(&value) {
            return Ok(value);
        }
        Err(Self::InvalidParameter {
            name: "random number",
            value,
            requirement: "at least 0 and below 1",
        })
    }

    /// Errs if a mesh would have more than 10⁸ cells.
    pub(super) fn check_count(length: f64, cells: f64) -> Result<(), Self> {
        let limit = 1e8;
        if cells <= limit {
            return Ok(());
        }
        Err(Self::TooFine { length, cells, limit })
    }
}
