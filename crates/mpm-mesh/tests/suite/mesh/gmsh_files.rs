//! `.msh` files that Gmsh wrote, and round trips of our own.

use mpm_mesh::{MshError, MshFormat, SimplexMesh, read_msh, read_named_msh, write_msh};
use mpm_tensor::vector::distance;

use super::conformance;
use super::samples::{self, Sample, sample};

const FORMATS: [MshFormat; 4] = [
    MshFormat::Text22,
    MshFormat::Binary22,
    MshFormat::Text41,
    MshFormat::Binary41,
];

// Written by Gmsh 4.8.4 from the `.geo` files beside them.
pub const BAR: [&[u8]; 4] = [
    include_bytes!("../../data/bar-22-text.msh"),
    include_bytes!("../../data/bar-22-binary.msh"),
    include_bytes!("../../data/bar-41-text.msh"),
    include_bytes!("../../data/bar-41-binary.msh"),
];
pub const PLATE: [&[u8]; 4] = [
    include_bytes!("../../data/plate-22-text.msh"),
    include_bytes!("../../data/plate-22-binary.msh"),
    include_bytes!("../../data/plate-41-text.msh"),
    include_bytes!("../../data/plate-41-binary.msh"),
];
pub const BRICK: [&[u8]; 4] = [
    include_bytes!("../../data/brick-22-text.msh"),
    include_bytes!("../../data/brick-22-binary.msh"),
    include_bytes!("../../data/brick-41-text.msh"),
    include_bytes!("../../data/brick-41-binary.msh"),
];
pub const QUADRANGLES: &[u8] = include_bytes!("../../data/quads-41-text.msh");

#[test]
fn all_four_files_of_gmsh_are_the_same_mesh() {
    check_files::<1>("bar", &BAR, 1.0);
    check_files::<2>("plate", &PLATE, 3.0);
    check_files::<3>("brick", &BRICK, 0.5);
}

fn check_files<const D: usize>(name: &'static str, files: &[&[u8]; 4], volume: f64) {
    let meshes = files.map(|file| read_msh::<D>(file).unwrap_or_else(|error| panic!("{name}: {error}")));
    for mesh in &meshes {
        assert_eq!(mesh.cell_count(), meshes[0].cell_count());
        assert!(mesh.cells().zip(meshes[0].cells()).all(|(a, b)| a == b), "{name}");
        // Gmsh writes sixteen digits.
        let pairs = mesh.vertices().iter().zip(meshes[0].vertices());
        assert!(pairs.into_iter().all(|(a, b)| distance(a, b) < 1e-15), "{name}");
    }
    for mesh in meshes {
        conformance::check(&sample(name, mesh, volume, 1));
    }
}

/// The curves x = 0 and y = 0 of the plate, and the face z = 0 of the brick, in all four formats.
#[test]
fn physical_groups_are_named_facets() {
    let length = |x: &[f64; 2]| x[0].abs().min(x[1].abs());
    for file in PLATE {
        let named = read_named_msh::<2>(file).expect("a mesh");
        assert_eq!(named.facets.keys().collect::<Vec<_>>(), ["wall"]);
        let wall = &named.facets["wall"];
        assert_eq!(wall.len(), 2 * 8);
        assert!(wall.iter().all(|&v| length(&named.mesh.vertices()[v as usize]) < 1e-12));
        assert_eq!(Ok(&named.mesh), read_msh(file).as_ref());
    }
    for file in BRICK {
        let named = read_named_msh::<3>(file).expect("a mesh");
        let area = |facet: &[u32]| {
            let [a, b, c] = [0, 1, 2].map(|k| named.mesh.vertices()[facet[k] as usize]);
            assert!([a, b, c].iter().all(|x| x[2].abs() < 1e-12));
            0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs()
        };
        let total: f64 = named.facets["floor"].chunks_exact(3).map(area).sum();
        assert!((total - 1.0).abs() < 1e-12, "{total}");
    }
    assert!(read_named_msh::<1>(BAR[0]).expect("a mesh").facets.is_empty());
}

#[test]
fn groups_without_names_have_their_tags_and_strays_are_refused() {
    let file = |segment: &str| {
        format!(
            "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n5\n9 5 5 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 1 1 0\n$EndNodes\n\
             $Elements\n3\n1 2 2 6 1 1 2 3\n2 2 2 6 1 2 4 3\n{segment}\n$EndElements\n"
        )
    };
    let named = read_named_msh::<2>(file("7 1 2 3 1 4 2").as_bytes()).expect("a mesh");
    assert_eq!(named.facets["3"], [3, 1]);
    assert!(
        read_named_msh::<2>(file("7 1 2 0 1 1 4").as_bytes())
            .expect("a mesh")
            .facets
            .is_empty()
    );
    for (stray, expected) in [
        (
            "7 1 2 3 1 1 4",
            "line 16: element 7 of the physical group `3` is no facet of a cell",
        ),
        (
            "7 1 2 3 1 9 2",
            "line 16: element 7 of the physical group `3` is no facet of a cell",
        ),
        ("7 1 2 3 1 8 2", "line 16: element 7 names node 8, which there is not"),
    ] {
        let refused = read_named_msh::<2>(file(stray).as_bytes()).expect_err("a stray");
        assert_eq!(refused.to_string(), expected);
        assert!(read_msh::<2>(file(stray).as_bytes()).is_ok());
    }
}

#[test]
fn names_without_quotes_are_refused_at_their_line() {
    let text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n1 1 wall\n$EndPhysicalNames\n";
    let refused = read_msh::<2>(text.as_bytes()).expect_err("no quotes");
    assert!(refused.to_string().starts_with("line 6: `wall`"), "{refused}");
    let cut = read_msh::<2>(&text.as_bytes()[..55]).expect_err("cut");
    assert!(
        matches!(cut, MshError::Truncated { .. } | MshError::Malformed { .. }),
        "{cut}"
    );
}

#[test]
fn what_is_written_reads_back_to_the_same_bits() {
    samples::one_dimensional().iter().for_each(round_trip);
    samples::two_dimensional().iter().for_each(round_trip);
    samples::three_dimensional().iter().for_each(round_trip);
}

fn round_trip<const D: usize>(sample: &Sample<D>) {
    for format in FORMATS {
        let file = write_msh(&sample.mesh, format);
        assert_eq!(
            read_msh(&file).as_ref(),
            Ok(&sample.mesh),
            "{} as {format:?}",
            sample.name
        );
    }
}

/// A square as big-endian bytes: tags 7 and up in steps of ten, with a point and a segment besides.
#[test]
fn big_endian_files_with_gaps_in_the_tags() {
    let square = samples::square();
    let positions: Vec<u8> = square
        .vertices()
        .iter()
        .flat_map(|[x, y]| bytes(&[*x, *y, 0.5]))
        .collect();
    let ints = |list: &[i32]| list.iter().flat_map(|x| x.to_be_bytes()).collect::<Vec<u8>>();
    let sizes = |list: &[u64]| list.iter().flat_map(|x| x.to_be_bytes()).collect::<Vec<u8>>();

    let mut old = b"$MeshFormat\n2.2 1 8\n".to_vec();
    old.extend([&ints(&[1]), b"\n$EndMeshFormat\n$Nodes\n4\n".as_slice()].concat());
    for (tag, position) in [37, 7, 17, 27].into_iter().zip(positions.chunks_exact(24)) {
        old.extend([&ints(&[tag]), position].concat());
    }
    old.extend(b"\n$EndNodes\n$Elements\n4\n");
    old.extend(ints(&[15, 1, 2, 1, -5, 6, 37]));
    old.extend(ints(&[1, 1, 2, 2, 5, 6, 37, 17]));
    old.extend(ints(&[2, 2, 1, 3, 9, 37, 7, 17, 4, 9, 37, 17, 27]));
    old.extend(b"\n$EndElements\n");
    assert_eq!(read_msh(&old).as_ref(), Ok(&square));

    let mut new = b"$MeshFormat\n4.1 1 8\n".to_vec();
    new.extend([&ints(&[1]), b"\n$EndMeshFormat\n$Nodes\n".as_slice()].concat());
    // Two blocks, the first with one parameter per node.
    new.extend(sizes(&[2, 4, 7, 37]));
    new.extend([ints(&[1, 3, 1]), sizes(&[1, 37])].concat());
    new.extend([&positions[..24], &bytes(&[0.25])].concat());
    new.extend([ints(&[2, -1, 0]), sizes(&[3, 7, 17, 27]), positions[24..].to_vec()].concat());
    new.extend(b"\n$EndNodes\n$Elements\n");
    new.extend(sizes(&[2, 3, 1, 9]));
    new.extend([ints(&[1, 3, 1]), sizes(&[1, 1, 37, 17])].concat());
    new.extend([ints(&[2, -1, 2]), sizes(&[2, 2, 37, 7, 17, 9, 37, 17, 27])].concat());
    new.extend(b"\n$EndElements\n");
    assert_eq!(read_msh(&new).as_ref(), Ok(&square));
}

fn bytes(list: &[f64]) -> Vec<u8> {
    list.iter().flat_map(|x| x.to_be_bytes()).collect()
}

#[test]
fn clockwise_meshes_are_turned() {
    let square = samples::square();
    let file = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Comments\n$Nodes none\n$EndComments\n$Nodes\n4\n\
                1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n\
                $Elements\n2\n1 2 2 0 1 2 1 3\n2 2 0 3 1 4\n$EndElements\n";
    let mesh: SimplexMesh<2> = read_msh(file.as_bytes()).expect("a square");
    assert_eq!(mesh.vertices(), square.vertices());
    assert_eq!(mesh.cell(0), [0, 1, 2]);
    assert_eq!(mesh.total_volume(), 1.0);
}
