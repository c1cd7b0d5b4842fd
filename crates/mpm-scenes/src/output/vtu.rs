//! Frames as VTK XML unstructured grids.

use mpm_mesh::Appended;

use crate::Snapshot;

/// A `.vtu` file of a snapshot: one vertex per particle, positions padded with zeros to three coordinates.
///
/// Arrays at the points: `displacement`, `velocity` (three components), `stress` (Cauchy, nine), `pressure` (−tr σ / D), `volume_ratio` (J), `mass`, `volume`
/// (current, J V⁰), `body`, `material`, `particle` (number in the order of creation) and the internal variables of the laws. For the format see [`Appended`].
pub fn vtu(snapshot: &Snapshot) -> Vec<u8> {
    let count = snapshot.len();
    let mut appended = Appended::default();
    let points = appended.floats("position", 3, &padded(snapshot, &snapshot.positions));
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
    let stresses = snapshot.stresses.chunks_exact((dimension * dimension).max(1));
    let trace = |stress: &[f64]| {
        (0..dimension)
            .filter_map(|a| stress.get(a * (dimension + 1)))
            .sum::<f64>()
    };
    let pressures: Vec<f64> = stresses
        .clone()
        .map(|stress| -trace(stress) / dimension as f64)
        .collect();
    let volumes: Vec<f64> = snapshot
        .reference_volumes
        .iter()
        .zip(&snapshot.volume_ratios)
        .map(|(v, j)| v * j)
        .collect();
    let tensors: Vec<f64> = stresses.flat_map(|stress| padded_tensor(stress, dimension)).collect();
    let mut text = appended.floats("displacement", 3, &padded(snapshot, &displacements));
    text += &appended.floats("velocity", 3, &padded(snapshot, &snapshot.velocities));
    text += &appended.floats("stress", 9, &tensors);
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

/// Vectors with zeros behind them up to three entries.
fn padded(snapshot: &Snapshot, list: &[f64]) -> Vec<f64> {
    let vectors = list.chunks_exact(snapshot.dimension.max(1));
    vectors
        .flat_map(|v| (0..3).map(|a| v.get(a).copied().unwrap_or(0.0)))
        .collect()
}

/// A tensor of `dimension`² entries as one of nine.
fn padded_tensor(tensor: &[f64], dimension: usize) -> [f64; 9] {
    std::array::from_fn(|k| {
        let (i, j) = (k / 3, k % 3);
        let inside = i < dimension && j < dimension;
        if inside {
            tensor.get(i * dimension + j).copied().unwrap_or(0.0)
        } else {
            0.0
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn snapshot() -> Snapshot {
        Snapshot {
            dimension: 2,
            time: 0.25,
            reference_positions: vec![0.0, 1.0, 2.0, 3.0],
            positions: vec![0.5, 1.0, 2.0, 3.5],
            velocities: vec![1.0, -1.0, 0.0, 2.0],
            stresses: vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0],
            deformation_gradients: vec![1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 2.0],
            volume_ratios: vec![1.0, 2.0],
            masses: vec![0.5, 0.75],
            reference_volumes: vec![0.25, 0.5],
            bodies: vec![0, 1],
            materials: vec![1, 0],
            scalars: vec![("plastic_strain".into(), vec![0.0, 0.125])],
        }
    }

    /// The bytes of an array by its name, found as a reader finds them: offset, count of bytes, bytes.
    fn array<'a>(file: &'a [u8], name: &str) -> &'a [u8] {
        let marker = b"<AppendedData encoding=\"raw\">\n_";
        let begin = file
            .windows(marker.len())
            .position(|window| window == marker)
            .expect("a block")
            + marker.len();
        let text = std::str::from_utf8(&file[..begin]).expect("text");
        let element = text
            .lines()
            .find(|line| line.contains(&format!("Name=\"{name}\"")))
            .expect("the array");
        let offset = element
            .split_once("offset=\"")
            .and_then(|(_, rest)| rest.split_once('"'))
            .expect("an offset")
            .0;
        let data = &file[begin + offset.parse::<usize>().expect("a number")..];
        let length = u64::from_le_bytes(data[..8].try_into().expect("eight bytes")) as usize;
        &data[8..8 + length]
    }

    fn floats(file: &[u8], name: &str) -> Vec<f64> {
        let words = array(file, name).chunks_exact(8);
        words
            .map(|word| f64::from_le_bytes(word.try_into().expect("eight bytes")))
            .collect()
    }

    #[test]
    fn arrays_are_found_by_their_offsets() {
        let file = vtu(&snapshot());
        assert_eq!(floats(&file, "position"), [0.5, 1.0, 0.0, 2.0, 3.5, 0.0]);
        assert_eq!(floats(&file, "displacement"), [0.5, 0.0, 0.0, 0.0, 0.5, 0.0]);
        assert_eq!(
            floats(&file, "stress")[..9],
            [1.0, 2.0, 0.0, 3.0, 4.0, 0.0, 0.0, 0.0, 0.0]
        );
        assert_eq!(floats(&file, "pressure"), [-2.5, -6.5]);
        assert_eq!(floats(&file, "volume"), [0.25, 1.0]);
        assert_eq!(floats(&file, "plastic_strain"), [0.0, 0.125]);
        assert_eq!(array(&file, "types"), [1, 1]);
        assert_eq!(
            array(&file, "offsets"),
            [1i64.to_le_bytes(), 2i64.to_le_bytes()].as_flattened()
        );
        assert_eq!(
            array(&file, "material"),
            [1i64.to_le_bytes(), 0i64.to_le_bytes()].as_flattened()
        );
        assert!(file.ends_with(b"\n</AppendedData>\n</VTKFile>\n"));
    }
}
