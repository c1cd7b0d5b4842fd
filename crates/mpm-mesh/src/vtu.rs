//! Meshes as VTK XML unstructured grids.

use mpm_vtk::Appended;

use crate::SimplexMesh;

/// Numbers to be shown at the vertices or in the cells of a mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Field<'a> {
    /// What it is called.
    pub name: &'a str,
    /// Numbers per vertex or cell: 1 for a scalar, 3 for a vector, 9 for a tensor.
    pub components: usize,
    /// All of them, one vertex or cell after the other.
    pub values: &'a [f64],
}

/// Why a mesh was not written.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum VtuError {
    /// A field has more or fewer values than the mesh has places for.
    #[error("field {name} has length {found}, it should be {expected}")]
    FieldLength {
        /// Name of the field.
        name: String,
        /// How many there are.
        found: usize,
        /// Components times vertices or cells.
        expected: usize,
    },
    /// A field has no components.
    #[error("field {name} has no components")]
    NoComponents {
        /// Name of the field.
        name: String,
    },
}

/// A `.vtu` file of a mesh: positions padded with zeros to three coordinates, cells as VTK's lines (type 3), triangles (5) or
/// tetrahedra (10), and fields at the vertices and in the cells; for the format see [`Appended`].
///
/// # Errors
/// [`VtuError`], if a field's values are not as many as its components times the vertices or cells.
pub fn mesh_vtu<const D: usize>(
    mesh: &SimplexMesh<D>,
    at_vertices: &[Field],
    in_cells: &[Field],
) -> Result<Vec<u8>, VtuError> {
    let (point_count, cell_count) = (mesh.vertices().len(), mesh.cell_count());
    let mut appended = Appended::default();
    let points = appended.positions(D, mesh.vertices().as_flattened());
    let connectivity = appended.integers("connectivity", mesh.cells().flatten().map(|&vertex| vertex.into()));
    let offsets = appended.integers("offsets", (1..=cell_count).map(|cell| (cell * (D + 1)) as i64));
    let kind = match D {
        1 => 3,
        2 => 5,
        _ => 10,
    };
    let types = appended.array("UInt8", "types", 1, &vec![kind; cell_count]);
    let point_data = append(&mut appended, at_vertices, point_count)?;
    let cell_data = append(&mut appended, in_cells, cell_count)?;
    Ok(appended.file(&format!(
        "<Piece NumberOfPoints=\"{point_count}\" NumberOfCells=\"{cell_count}\">\n\
         <Points>\n{points}</Points>\n\
         <Cells>\n{connectivity}{offsets}{types}</Cells>\n\
         <PointData>\n{point_data}</PointData>\n\
         <CellData>\n{cell_data}</CellData>\n\
         </Piece>\n"
    )))
}

/// Adds fields of `count` places.
fn append(appended: &mut Appended, fields: &[Field], count: usize) -> Result<String, VtuError> {
    let mut text = String::new();
    for field in fields {
        let (name, expected) = (field.name.to_owned(), field.components.saturating_mul(count));
        if field.components == 0 {
            return Err(VtuError::NoComponents { name });
        }
        if field.values.len() != expected {
            let found = field.values.len();
            return Err(VtuError::FieldLength { name, found, expected });
        }
        text += &appended.floats(field.name, field.components, field.values);
    }
    Ok(text)
}
