//! The background: a grid or a mesh.

use crate::scene::{
    Discretisation, GradientName, KernelName, MeshShapeTable, MeshTable, RotationTable, Scene, WidthName,
};
use crate::shape::Bounds;
use crate::values::{finite, not_negative, positive, vector, within};
use crate::{SceneFault, rotation};

impl Scene {
    /// What the scene is computed on.
    ///
    /// # Errors
    /// [`SceneFault::Missing`] where there is neither a grid nor a mesh, [`SceneFault::TwoBackgrounds`] where there are both.
    pub fn discretisation(&self) -> Result<Discretisation<'_>, SceneFault> {
        match (&self.grid, &self.mesh) {
            (Some(grid), None) => Ok(Discretisation::Grid(grid)),
            (None, Some(mesh)) => Ok(Discretisation::Mesh(mesh)),
            (None, None) => Err(SceneFault::missing("grid", "given unless there is a [mesh]")),
            (Some(_), Some(_)) => Err(SceneFault::TwoBackgrounds),
        }
    }

    pub(super) fn check_discretisation<const D: usize>(&self) -> Result<(), SceneFault> {
        match (self.discretisation()?, &self.domain) {
            (Discretisation::Grid(_), None) => {
                return Err(SceneFault::missing("domain", "given with a [grid]"));
            }
            (_, Some(domain)) => {
                let Bounds { lower, upper } = domain.room::<D>()?;
                let (above, list) = ((0..D).all(|a| lower[a] < upper[a]), &domain.upper);
                within("domain.upper", list, above, &format!("above domain.lower = {lower:?}"))?;
            }
            (Discretisation::Mesh(_), None) => {}
        }
        match self.discretisation()? {
            Discretisation::Grid(grid) => {
                positive("grid.spacing", grid.spacing)?;
                let sides = self
                    .domain
                    .iter()
                    .flat_map(|domain| domain.lower.iter().zip(&domain.upper));
                let longest = sides.map(|(lower, upper)| upper - lower).fold(0.0, f64::max);
                let expected = format!("at most {longest}, the longest side of the domain");
                within("grid.spacing", grid.spacing, grid.spacing <= longest, &expected).map(drop)
            }
            Discretisation::Mesh(mesh) => check_mesh::<D>(mesh),
        }
    }

    /// Whether a table of a rotation can be used.
    pub(super) fn check_rotation<const D: usize>(field: &str, table: Option<&RotationTable>) -> Result<(), SceneFault> {
        rotation::build::<D>(field, table).map(|_| ())
    }
}

/// Rounds of smoothing, at most.
const MOST_SWEEPS: usize = 1000;

fn check_mesh<const D: usize>(mesh: &MeshTable) -> Result<(), SceneFault> {
    match (&mesh.file, &mesh.generate) {
        (Some(_), None) => {}
        (None, Some(shape)) => {
            positive("mesh.generate.size", shape.size())?;
            let dimension = shape.dimension();
            let expected = format!("a mesh of dimension {D}, that of the scene");
            within("mesh.generate", shape, dimension == D, &expected)?;
            if let MeshShapeTable::Ring { inner, outer, .. } = shape {
                positive("mesh.generate.inner", *inner)?;
                let fits = inner < outer && outer.is_finite();
                within("mesh.generate.outer", *outer, fits, "finite and above inner")?;
            }
        }
        (file, _) => return Err(SceneFault::one_of("mesh", ["file", "generate"], file.is_some())),
    }
    let needed = mesh.kernel != KernelName::Hat || !mesh.positive_weights;
    let expected = "left out with mesh.kernel = \"hat\", whose weights are positive";
    within("mesh.positive_weights", mesh.positive_weights, needed, expected)?;
    let needed = mesh.kernel != KernelName::Hat || mesh.gradient == GradientName::Diffuse;
    let expected = "left out with mesh.kernel = \"hat\", whose gradient of the fit is that of the weight";
    within("mesh.gradient", mesh.gradient, needed, expected)?;
    let needed = mesh.kernel != KernelName::Hat || mesh.width == WidthName::LongestEdge;
    let expected = "left out with mesh.kernel = \"hat\", which is as wide as the cells around a vertex";
    within("mesh.width", mesh.width, needed, expected)?;
    check_points_inside(mesh)?;
    Scene::check_rotation::<D>("mesh.rotation", mesh.rotation.as_ref())?;
    not_negative("mesh.reach", mesh.reach).map(drop)
}

/// Random or turned points are a matter of the plane kinds between polygons.
fn check_points_inside(mesh: &MeshTable) -> Result<(), SceneFault> {
    finite("mesh.angle", mesh.angle)?;
    let polygons = mesh.generate.as_ref().is_some_and(MeshShapeTable::is_between_polygons);
    let of_polygons = "left out unless mesh.generate is a rectangle, polygon, disk, ring or channel";
    within("mesh.angle", mesh.angle, polygons || mesh.angle == 0.0, of_polygons)?;
    let Some(delaunay) = &mesh.delaunay else { return Ok(()) };
    within("mesh.delaunay", delaunay, polygons, of_polygons)?;
    let (sweeps, expected) = (delaunay.sweeps, format!("at most {MOST_SWEEPS}"));
    within("mesh.delaunay.sweeps", sweeps, sweeps <= MOST_SWEEPS, &expected)?;
    for (index, place) in delaunay.refine.iter().enumerate() {
        let field = |key: &str| format!("mesh.delaunay.refine[{index}].{key}");
        positive(&field("size"), place.size)?;
        positive(&field("growth"), place.growth)?;
        not_negative(&field("radius"), place.radius)?;
        vector::<2>(&field("centre"), &place.centre)?;
    }
    Ok(())
}
