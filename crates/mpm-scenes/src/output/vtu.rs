//! Frames as VTK XML unstructured grids.

use mpm_vtk::Appended;

use crate::Snapshot;

/// A `.vtu` file of a snapshot: one vertex per particle, positions padded with zeros to three coordinates.
///
/// Arrays at the points: `displacement`, `velocity` (three components), `stress` (Cauchy, nine; along axes that the dimension leaves out where the law knows it, else 0), `pressure` (−tr σ / D), `volume_ratio` (J), `mass`, `volume`
/// (current, J V⁰), `body`, `material`, `particle` (number in the order of creation) and the internal variables of the laws. For the format see [`Appended`].
pub fn vtu(snapshot: &Snapshot) -> Vec<u8> {
    let count = snapshot.len();
    let mut appended = Appended::default();
    let points = appended.positions(snapshot.dimension, &snapshot.positions);
    let connectivity = appended.integers("connectivity", (0..count).map(|p| p as i64));
    let offsets = appended.integers("offsets", (1..=count).map(|p| p as i64));
    let types = appended.array("UInt8", "types", 1, &vec![1; count]);
    let data = point_data(snapshot, &mut appended);
    appended.file(&format!(
        "<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">{:?}</DataArray>\n</FieldData>\n\
         <Piece NumberOfPoints=\"{count}\" NumberOfCells=\"{count}\">\n\
         <Points>\n{points}</Points>\n\
         <Cells>\n{connectivity}{offsets}{types}</Cells>\n\
         <PointData Vectors=\"velocity\" Tensors=\"stress\">\n{data}</PointData>\n\
         </Piece>\n",
        snapshot.time
    ))
}

fn point_data(snapshot: &Snapshot, appended: &mut Appended) -> String {
    let dimension = snapshot.dimension;
    let moved = snapshot.positions.iter().zip(&snapshot.reference_positions);
    let displacements: Vec<f64> = moved.map(|(x, start)| x - start).collect();
    let trace = |stress: &[f64]| {
        (0..dimension)
            .filter_map(|a| stress.get(a * (dimension + 1)))
            .sum::<f64>()
    };
    let stresses = snapshot.stresses.chunks_exact((dimension * dimension).max(1));
    let pressures: Vec<f64> = stresses.map(|stress| -trace(stress) / dimension as f64).collect();
    let volumes: Vec<f64> = snapshot
        .reference_volumes
        .iter()
        .zip(&snapshot.volume_ratios)
        .map(|(v, j)| v * j)
        .collect();
    let mut text = appended.vectors("displacement", dimension, &displacements);
    text += &appended.vectors("velocity", dimension, &snapshot.velocities);
    text += &appended.matrices("stress", dimension, &snapshot.stresses, |particle| {
        snapshot.stresses_across.get(particle).copied().unwrap_or(0.0)
    });
    text += &appended.floats("pressure", 1, &pressures);
    text += &appended.floats("volume_ratio", 1, &snapshot.volume_ratios);
    text += &appended.floats("mass", 1, &snapshot.masses);
    text += &appended.floats("volume", 1, &volumes);
    text += &appended.integers("body", snapshot.bodies.iter().map(|&body| i64::from(body)));
    text += &appended.integers(
        "material",
        snapshot.materials.iter().map(|&material| i64::from(material)),
    );
    text += &appended.integers("particle", (0..snapshot.len()).map(|p| p as i64));
    for (name, values) in &snapshot.scalars {
        text += &appended.floats(name, 1, values);
    }
    text
}
