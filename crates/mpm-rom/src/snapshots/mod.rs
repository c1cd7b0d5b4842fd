//! Snapshots of full-order runs: what a deformation map is trained on and measured against.

mod error;
mod file;

pub use error::{Place, SnapshotsError};

use mpm_tensor::Matrix;

use crate::least_squares::squared_distance;

/// Snapshots of one body in several runs of full-order MPM that differ in their parameters.
///
/// Every position is relative to the body's centroid at rest; row p of every list belongs to the same material point.
#[derive(Clone, Debug, PartialEq)]
pub struct Snapshots<const D: usize> {
    body: Body<D>,
    runs: Vec<Run<D>>,
}

/// What all runs share.
#[derive(Clone, Debug, PartialEq)]
pub struct Body<const D: usize> {
    /// The scene's name; a model remembers on which it was trained.
    pub scene: String,
    /// X_p, reference positions relative to the centroid (m).
    pub reference: Vec<[f64; D]>,
    /// The centroid at rest in the scene's own coordinates (m).
    pub centroid: [f64; D],
    /// Time between two frames of the scene (s), > 0; snapshots may hold more frames than these.
    pub interval: f64,
    /// ρ₀, density at rest (kg/m^D), > 0.
    pub density: f64,
    /// Names of the parameters in which runs differ.
    pub parameters: Vec<String>,
}

/// One run: frames in the order of time; frame 0 is the initial state at t = 0, so that its velocities are V₀.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Run<const D: usize> {
    /// Values of the parameters, in the order of [`Body::parameters`].
    pub parameters: Vec<f64>,
    /// The frames.
    pub frames: Vec<Frame<D>>,
}

/// All points at one instant.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame<const D: usize> {
    /// t (s).
    pub time: f64,
    /// φ_p, deformed positions relative to the centroid at rest (m).
    pub positions: Vec<[f64; D]>,
    /// F_p, deformation gradients, det F_p > 0.
    pub deformation_gradients: Vec<Matrix<D>>,
    /// v_p, velocities (m/s).
    pub velocities: Vec<[f64; D]>,
}

impl<const D: usize> Snapshots<D> {
    /// Snapshots of a body.
    ///
    /// # Errors
    /// [`SnapshotsError`]: no point, run or frame; lists of other lengths than the body's; a value that is NaN or infinite; det F ≤ 0; Δt or
    /// ρ₀ not positive.
    pub fn new(body: Body<D>, runs: Vec<Run<D>>) -> Result<Self, SnapshotsError> {
        body.check()?;
        if runs.is_empty() {
            return Err(SnapshotsError::Empty { what: "runs" });
        }
        for (number, run) in runs.iter().enumerate() {
            run.check(number, &body)?;
        }
        Ok(Self { body, runs })
    }

    /// What all runs share.
    pub fn body(&self) -> &Body<D> {
        &self.body
    }

    /// X_p, reference positions relative to the centroid at rest (m).
    pub fn reference(&self) -> &[[f64; D]] {
        &self.body.reference
    }

    /// The runs.
    pub fn runs(&self) -> &[Run<D>] {
        &self.runs
    }

    /// The frames of all runs, one run after the other.
    pub fn frames(&self) -> impl Iterator<Item = &Frame<D>> + Clone {
        self.runs.iter().flat_map(|run| &run.frames)
    }

    /// Number of material points.
    pub fn points(&self) -> usize {
        self.body.reference.len()
    }
}

impl<const D: usize> Body<D> {
    fn check(&self) -> Result<(), SnapshotsError> {
        if self.reference.is_empty() {
            return Err(SnapshotsError::Empty { what: "points" });
        }
        let place = Place::default();
        for (field, value) in [("interval", self.interval), ("density", self.density)] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(place.refuse(field, value, "positive and finite"));
            }
        }
        for (point, position) in self.reference.iter().chain([&self.centroid]).enumerate() {
            let point = Some(point);
            all_finite(Place { point, ..place }, "reference", position)?;
        }
        Ok(())
    }
}

impl<const D: usize> Run<D> {
    fn check(&self, run: usize, body: &Body<D>) -> Result<(), SnapshotsError> {
        let place = Place {
            run: Some(run),
            ..Place::default()
        };
        place.require_length("parameters", self.parameters.len(), body.parameters.len())?;
        for (name, value) in body.parameters.iter().zip(&self.parameters) {
            all_finite(place, name, std::slice::from_ref(value))?;
        }
        if self.frames.is_empty() {
            return Err(SnapshotsError::Empty { what: "frames" });
        }
        let mut before = f64::NEG_INFINITY;
        for (number, frame) in self.frames.iter().enumerate() {
            let (time, number) = (frame.time, Some(number));
            let frame_place = Place { frame: number, ..place };
            if !(time > before && time.is_finite()) {
                return Err(frame_place.refuse("time", time, "finite and later than that of the frame before"));
            }
            before = time;
            frame.check(frame_place, body.reference.len())?;
        }
        Ok(())
    }
}

impl<const D: usize> Frame<D> {
    /// Σ_p |x_p − y_p|², y_p the positions of another frame.
    pub(crate) fn moved_from(&self, other: &Self) -> f64 {
        squared_distance(&self.positions, &other.positions)
    }

    fn check(&self, place: Place, points: usize) -> Result<(), SnapshotsError> {
        place.require_length("positions", self.positions.len(), points)?;
        place.require_length("deformation_gradients", self.deformation_gradients.len(), points)?;
        place.require_length("velocities", self.velocities.len(), points)?;
        for point in 0..points {
            let (gradient, number) = (&self.deformation_gradients[point], Some(point));
            let place = Place { point: number, ..place };
            all_finite(place, "positions", &self.positions[point])?;
            all_finite(place, "deformation_gradients", gradient.0.as_flattened())?;
            all_finite(place, "velocities", &self.velocities[point])?;
            let determinant = gradient.determinant();
            if determinant.is_nan() || determinant <= 0.0 {
                return Err(place.refuse("det F", determinant, "positive"));
            }
        }
        Ok(())
    }
}

/// Whether all numbers of a field are finite.
fn all_finite(place: Place, field: &str, numbers: &[f64]) -> Result<(), SnapshotsError> {
    match numbers.iter().find(|value| !value.is_finite()) {
        Some(&value) => Err(place.refuse(field, value, "finite")),
        None => Ok(()),
    }
}
