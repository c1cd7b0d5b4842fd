//! `.vtu` files, read as a reader finds its arrays.

use mpm_mesh::{Field, VtuError, mesh_vtu};

use super::samples;

/// The bytes of an array by its name: offset, count of bytes, bytes.
fn array<'a>(file: &'a [u8], name: &str) -> &'a [u8] {
    let marker = b"<AppendedData encoding=\"raw\">\n_";
    let begin = file.windows(marker.len()).position(|window| window == marker);
    let begin = begin.expect("a block") + marker.len();
    let text = std::str::from_utf8(&file[..begin]).expect("text");
    let element = text.lines().find(|line| line.contains(&format!("Name=\"{name}\"")));
    let (_, rest) = element.expect("the array").split_once("offset=\"").expect("an offset");
    let offset: usize = rest
        .split('"')
        .next()
        .and_then(|offset| offset.parse().ok())
        .expect("a number");
    let (length, rest) = file[begin + offset..].split_first_chunk().expect("a length");
    &rest[..u64::from_le_bytes(*length) as usize]
}

fn words<T>(file: &[u8], name: &str, read: fn([u8; 8]) -> T) -> Vec<T> {
    let words = array(file, name).chunks_exact(8);
    words.map(|word| read(word.try_into().expect("eight bytes"))).collect()
}

#[test]
fn arrays_are_found_by_their_offsets() {
    let heights = [1.0, 2.0, 3.0, 4.0];
    let flow = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let height = Field {
        name: "height",
        components: 1,
        values: &heights,
    };
    let flow_field = Field {
        name: "a < \"b\"",
        components: 3,
        values: &flow,
    };
    let file = mesh_vtu(&samples::square(), &[height], &[flow_field]).expect("a file");
    let text = String::from_utf8_lossy(&file);
    assert!(text.contains("<Piece NumberOfPoints=\"4\" NumberOfCells=\"2\">"));
    let points = words(&file, "position", f64::from_le_bytes);
    assert_eq!(points, [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.0]);
    assert_eq!(words(&file, "connectivity", i64::from_le_bytes), [0, 1, 2, 0, 2, 3]);
    assert_eq!(words(&file, "offsets", i64::from_le_bytes), [3, 6]);
    assert_eq!(array(&file, "types"), [5, 5]);
    assert_eq!(words(&file, "height", f64::from_le_bytes), heights);
    assert_eq!(words(&file, "a &lt; &quot;b&quot;", f64::from_le_bytes), flow);
    assert!(file.ends_with(b"\n</AppendedData>\n</VTKFile>\n"));
    let types = |file: Result<Vec<u8>, VtuError>| array(&file.expect("a file"), "types").to_vec();
    assert_eq!(types(mesh_vtu(&samples::unit::<1>(), &[], &[])), [3]);
    assert_eq!(types(mesh_vtu(&samples::unit::<3>(), &[], &[])), [10]);
}

#[test]
fn fields_of_another_length_are_refused() {
    let field = |components, values| Field {
        name: "t",
        components,
        values,
    };
    let error = VtuError::FieldLength {
        name: "t".into(),
        found: 4,
        expected: 2,
    };
    assert_eq!(mesh_vtu(&samples::square(), &[], &[field(1, &[0.0; 4])]), Err(error));
    let error = VtuError::NoComponents { name: "t".into() };
    assert_eq!(mesh_vtu(&samples::square(), &[field(0, &[])], &[]), Err(error));
}

/// The whole of a file but its numbers.
#[test]
fn the_text_of_a_file() {
    let file = mesh_vtu(&samples::unit::<2>(), &[], &[]).expect("a file");
    let element = |kind: &str, name: &str, components: usize, offset: usize| {
        format!(
            "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"appended\" offset=\"{offset}\"/>\n"
        )
    };
    let text = "<?xml version=\"1.0\"?>\n\
        <VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n\
        <UnstructuredGrid>\n<Piece NumberOfPoints=\"3\" NumberOfCells=\"1\">\n<Points>\n"
        .to_owned()
        + &element("Float64", "position", 3, 0)
        + "</Points>\n<Cells>\n"
        + &element("Int64", "connectivity", 1, 8 + 72)
        + &element("Int64", "offsets", 1, 80 + 8 + 24)
        + &element("UInt8", "types", 1, 112 + 8 + 8)
        + "</Cells>\n<PointData>\n</PointData>\n<CellData>\n</CellData>\n</Piece>\n</UnstructuredGrid>\n\
           <AppendedData encoding=\"raw\">\n_";
    assert!(file.starts_with(text.as_bytes()), "{}", String::from_utf8_lossy(&file));
    assert_eq!(
        file.len(),
        text.len() + 128 + 8 + 1 + "\n</AppendedData>\n</VTKFile>\n".len()
    );
}
