//! Arrays as raw appended data, the binary form that ParaView reads fastest.

use crate::escaped;

/// The arrays of a grid or of points: the text of a file has an element for each, which says where it begins in a block of data behind the text.
///
/// Format: VTK XML, version 1.0, little endian; every array is a 64-bit count of bytes followed by the bytes
/// (<https://docs.vtk.org/en/latest/vtk_file_formats/vtkxml_file_format.html>).
#[derive(Clone, Debug, Default)]
pub struct Appended {
    /// The arrays, each behind the count of its bytes.
    bytes: Vec<u8>,
}

impl Appended {
    /// Adds an array of VTK's type `kind` with little-endian `content`; returns the element that describes it.
    pub fn array(&mut self, kind: &str, name: &str, components: usize, content: &[u8]) -> String {
        let offset = self.bytes.len();
        self.bytes.extend((content.len() as u64).to_le_bytes());
        self.bytes.extend(content);
        let name = escaped(name);
        format!(
            "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"appended\" offset=\"{offset}\"/>\n"
        )
    }

    /// As [`array`](Self::array), of type `Float64`.
    pub fn floats(&mut self, name: &str, components: usize, values: &[f64]) -> String {
        let content: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
        self.array("Float64", name, components, &content)
    }

    /// The positions of points, D = `dimension` coordinates each: the first three, with zeros behind fewer.
    pub fn positions(&mut self, dimension: usize, values: &[f64]) -> String {
        self.floats("position", 3, &widened(dimension, 3, values))
    }

    /// Vectors of `dimension` entries each, with zeros behind fewer than three.
    pub fn vectors(&mut self, name: &str, dimension: usize, values: &[f64]) -> String {
        let wide = dimension.max(3);
        self.floats(name, wide, &widened(dimension, wide, values))
    }

    /// Matrices of `dimension` rows and columns each, row by row; of fewer than three the others are those of `diagonal` of its number times the identity.
    pub fn matrices(
        &mut self,
        name: &str,
        dimension: usize,
        values: &[f64],
        diagonal: impl Fn(usize) -> f64,
    ) -> String {
        let (d, wide) = (dimension.max(1), dimension.max(3));
        let whole = |(number, matrix): (usize, &[f64])| {
            let entry = |k: usize| match [k / wide, k % wide] {
                [i, j] if i < d && j < d => matrix[i * d + j],
                [i, j] if i == j => diagonal(number),
                _ => 0.0,
            };
            (0..wide * wide).map(entry).collect::<Vec<_>>()
        };
        let entries: Vec<f64> = values.chunks_exact(d * d).enumerate().flat_map(whole).collect();
        self.floats(name, wide * wide, &entries)
    }

    /// As [`array`](Self::array), of type `Int64` with one component.
    pub fn integers(&mut self, name: &str, values: impl Iterator<Item = i64>) -> String {
        let content: Vec<u8> = values.flat_map(i64::to_le_bytes).collect();
        self.array("Int64", name, 1, &content)
    }

    /// A file of the arrays, whose elements are in `grid`, the text between `<UnstructuredGrid>` and its end.
    pub fn file(&self, grid: &str) -> Vec<u8> {
        self.file_of("UnstructuredGrid", grid)
    }

    /// A `.vtp` file of the arrays, whose elements are in `points`, the text between `<PolyData>` and its end.
    pub fn poly_data(&self, points: &str) -> Vec<u8> {
        self.file_of("PolyData", points)
    }

    fn file_of(&self, kind: &str, content: &str) -> Vec<u8> {
        let text = format!(
            "<?xml version=\"1.0\"?>\n\
             <VTKFile type=\"{kind}\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n\
             <{kind}>\n{content}</{kind}>\n\
             <AppendedData encoding=\"raw\">\n_"
        );
        [text.as_bytes(), &self.bytes, b"\n</AppendedData>\n</VTKFile>\n"].concat()
    }
}

/// The first `wide` entries of every row of `dimension`, with zeros behind fewer.
fn widened(dimension: usize, wide: usize, values: &[f64]) -> Vec<f64> {
    let rows = values.chunks_exact(dimension.max(1));
    rows.flat_map(|row| (0..wide).map(|a| row.get(a).copied().unwrap_or(0.0)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_vectors_and_matrices_are_widened() {
        let mut appended = Appended::default();
        assert!(
            appended
                .vectors("v", 2, &[1.0, 2.0])
                .contains("NumberOfComponents=\"3\"")
        );
        assert!(appended.vectors("w", 4, &[1.0; 4]).contains("NumberOfComponents=\"4\""));
        appended.matrices("F", 2, &[1.0, 2.0, 3.0, 4.0], |_| 1.0);
        appended.positions(4, &[5.0, 6.0, 7.0, 8.0]);
        let numbers = |list: &[f64]| {
            let mut bytes = (8 * list.len() as u64).to_le_bytes().to_vec();
            bytes.extend(list.iter().flat_map(|number| number.to_le_bytes()));
            bytes
        };
        let expected = [
            numbers(&[1.0, 2.0, 0.0]),
            numbers(&[1.0; 4]),
            numbers(&[1.0, 2.0, 0.0, 3.0, 4.0, 0.0, 0.0, 0.0, 1.0]),
            numbers(&[5.0, 6.0, 7.0]),
        ];
        let file = appended.file("");
        assert!(
            file.windows(expected.concat().len())
                .any(|bytes| bytes == expected.concat())
        );
    }
}
