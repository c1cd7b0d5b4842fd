//! What a reference reads of a scene and its series.

use mpm_materials::ElasticModuli;

use super::curve::Curve;
use crate::scene::{Discretisation, MaterialTable, ShapeTable, SolidTable};
use crate::{Scene, SceneFault, Series, Snapshot, ValidationRow};

/// A finished run.
pub struct Run<'a> {
    /// What was run.
    pub scene: &'a Scene,
    /// Its time series.
    pub series: &'a Series,
    /// Its particles at the end.
    pub last: &'a Snapshot,
}

/// What a comparison gives.
pub type Rows = Result<Vec<ValidationRow>, SceneFault>;

impl Run<'_> {
    /// A column of the series over time.
    ///
    /// # Errors
    /// [`SceneFault::Value`] where there is no such column.
    pub fn curve(&self, name: &str) -> Result<Curve, SceneFault> {
        let times = self.series.column("time");
        match (times, self.series.column(name)) {
            (Some(times), Some(values)) => Ok(Curve { times, values }),
            _ => Err(unfit(self.scene, &format!("for a scene with the series column {name}"))),
        }
    }

    /// √(Σ V⁰_p |x_p − `exact`(X_p)|² / Σ V⁰_p) at the end of the run; NaN unless there are two dimensions.
    #[allow(non_snake_case)]
    pub fn position_error(&self, exact: impl Fn(&[f64; 2], f64) -> [f64; 2]) -> f64 {
        let last = self.last;
        let errors = last.reference_volumes.iter().enumerate().filter_map(|(p, &volume)| {
            let X = <[f64; 2]>::try_from(last.vector(&last.reference_positions, p)?).ok()?;
            let x = <[f64; 2]>::try_from(last.vector(&last.positions, p)?).ok()?;
            let expected = exact(&X, last.time);
            Some((volume, [x[0] - expected[0], x[1] - expected[1]]))
        });
        let (volume, sum) = errors.fold((0.0, 0.0), |(volume, sum), (v, e): (f64, [f64; 2])| {
            (volume + v, sum + v * e.iter().map(|c| c * c).sum::<f64>())
        });
        (sum / volume).sqrt()
    }
}

/// The refusal of a scene that the reference does not describe.
pub fn unfit(scene: &Scene, expected: &str) -> SceneFault {
    let name = scene.validation.as_ref().map_or("", |table| table.reference.as_str());
    SceneFault::value("validation.reference", name, expected)
}

/// The elastic solid that the only material of a scene is, with its moduli.
///
/// # Errors
/// [`SceneFault::Value`] for several materials or another law.
pub fn solid(scene: &Scene) -> Result<(SolidTable, ElasticModuli), SceneFault> {
    let mut materials = scene.materials.values();
    match (materials.next(), materials.next()) {
        (Some(MaterialTable::LinearElastic(solid) | MaterialTable::NeoHookean(solid)), None) => {
            let moduli = ElasticModuli::new(solid.young_modulus, solid.poisson_ratio);
            let moduli = moduli.map_err(|error| unfit(scene, &format!("for another material: {error}")))?;
            Ok((*solid, moduli))
        }
        _ => Err(unfit(scene, "for one linear-elastic or neo-hookean material")),
    }
}

/// The same of a scene of two dimensions.
///
/// # Errors
/// [`SceneFault::Value`] for another dimension, and as [`solid`].
pub fn plane_solid(scene: &Scene) -> Result<(SolidTable, ElasticModuli), SceneFault> {
    if scene.dimension != 2 {
        return Err(SceneFault::value("dimension", scene.dimension, "2"));
    }
    solid(scene)
}

/// Lower and upper corner of the box that the first body is.
///
/// # Errors
/// [`SceneFault::Value`] for another shape.
pub fn first_box(scene: &Scene) -> Result<(&[f64], &[f64]), SceneFault> {
    match scene.bodies.first().map(|body| &body.shape) {
        Some(ShapeTable::Box { lower, upper }) => Ok((lower, upper)),
        _ => Err(unfit(scene, "for a box as the first body")),
    }
}

/// Sides of the box that the first body is.
///
/// # Errors
/// As [`first_box`].
pub fn sides(scene: &Scene) -> Result<Vec<f64>, SceneFault> {
    let (lower, upper) = first_box(scene)?;
    Ok(lower.iter().zip(upper).map(|(low, high)| high - low).collect())
}

/// |g|.
pub fn gravity(scene: &Scene) -> f64 {
    scene.gravity.iter().map(|c| c * c).sum::<f64>().sqrt()
}

/// Spacing of the grid, or the edges that the mesh was asked for.
///
/// # Errors
/// [`SceneFault::Value`] for a mesh from a file.
pub fn spacing(scene: &Scene) -> Result<f64, SceneFault> {
    match scene.discretisation()? {
        Discretisation::Grid(grid) => Ok(grid.spacing),
        Discretisation::Mesh(mesh) => {
            let size = mesh.generate.as_ref().map(|shape| shape.size());
            size.ok_or_else(|| unfit(scene, "for a mesh that is generated"))
        }
    }
}
