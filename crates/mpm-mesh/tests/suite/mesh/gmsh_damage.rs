//! `.msh` files that are refused, each with its error and the place.

use mpm_mesh::{MeshError, MshError, Place, read_msh, read_named_msh};
use proptest::prelude::*;

use super::gmsh_files::{BAR, BRICK, PLATE, QUADRANGLES};

const HEADER: &str = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
const NODES: &str = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n";
const CELLS: &str = "$Elements\n2\n1 2 2 0 1 1 2 3\n2 2 2 0 1 1 3 4\n$EndElements\n";

fn refused(text: &str) -> MshError {
    read_msh::<2>(text.as_bytes()).expect_err("not a mesh")
}

fn line(byte: usize, line: usize) -> Place {
    Place { byte, line: Some(line) }
}

fn malformed(text: &str, at: &str, expected: &'static str, found: &str) {
    let byte = text.find(at).expect("the place");
    let number = 1 + text[..byte].matches('\n').count();
    let error = MshError::Malformed {
        place: line(byte, number),
        expected,
        found: found.to_owned(),
    };
    assert_eq!(refused(text), error);
}

#[test]
fn headers() {
    let place = line(0, 1);
    let expected = "$MeshFormat";
    assert_eq!(refused(""), MshError::Truncated { place, expected });
    malformed("solid cube", "solid", "$MeshFormat", "solid");
    let version = "4".to_owned();
    assert_eq!(
        refused("$MeshFormat\n4 0 8\n"),
        MshError::UnsupportedVersion { version }
    );
    malformed("$MeshFormat\n2.2 2 8\n", "2 8", "0 for text or 1 for binary", "2");
    malformed("$MeshFormat\n4.1 0 x\n", "x", "the size of numbers", "x");
    malformed("$MeshFormat\n4.1 0 8\n$Nodes", "$Nodes", "$EndMeshFormat", "$Nodes");
    assert_eq!(
        refused("$MeshFormat\n4.1 1 4\n"),
        MshError::UnsupportedDataSize { size: 4 }
    );
    let mut marker = b"$MeshFormat\n4.1 1 8\n".to_vec();
    marker.extend([1, 1, 0, 0]);
    let error = MshError::Malformed {
        place: Place { byte: 20, line: None },
        expected: "the number one",
        found: "257".to_owned(),
    };
    assert_eq!(read_msh::<2>(&marker), Err(error));
}

#[test]
fn sections() {
    assert_eq!(refused(HEADER), MshError::MissingSection { name: "Nodes" });
    assert_eq!(
        refused(&format!("{HEADER}{NODES}")),
        MshError::MissingSection { name: "Elements" }
    );
    malformed(
        &format!("{HEADER}junk {NODES}"),
        "junk",
        "the name of a section",
        "junk",
    );
    let nodes = NODES.replace("4 0 1 0\n", "");
    malformed(
        &format!("{HEADER}{nodes}{CELLS}"),
        "$EndNodes",
        "the tag of a node",
        "$EndNodes",
    );
    let open = format!("{HEADER}$Periodic\n1 2 3");
    let place = line(open.len(), 5);
    let expected = "the end of a section";
    assert_eq!(refused(&open), MshError::Truncated { place, expected });
}

#[test]
fn numbers_of_entries_that_are_not_those_of_the_blocks() {
    let text = |nodes: &str, elements: &str| {
        format!(
            "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 {nodes} 1 3\n2 1 0 3\n1\n2\n3\n0 0 0\n1 0 0\n0 1 0\n$EndNodes\n\
             $Elements\n1 {elements} 1 1\n2 1 2 1\n1 1 2 3\n$EndElements\n"
        )
    };
    assert!(read_msh::<2>(text("3", "1").as_bytes()).is_ok());
    let nodes = text("7", "1");
    malformed(&nodes, "7 1 3", "the number of nodes in all blocks", "7");
    let elements = text("3", "9");
    malformed(&elements, "9 1 1", "the number of elements in all blocks", "9");
}

#[test]
fn a_byte_order_mark_is_passed_over() {
    let text = format!("{HEADER}{NODES}{CELLS}");
    let marked = format!("\u{feff}{text}");
    assert_eq!(read_msh::<2>(marked.as_bytes()), read_msh::<2>(text.as_bytes()));
    let nodes = NODES.replace("3 1 1 0", "3 1 one 0");
    malformed(&format!("\u{feff}{HEADER}{nodes}{CELLS}"), "one", "a coordinate", "one");
}

#[test]
fn nodes_and_elements() {
    let nodes = NODES.replace("3 1 1 0", "2 1 1 0");
    let place = line(HEADER.len() + 25, 8);
    let error = MshError::DuplicateNode { tag: 2, place };
    assert_eq!(refused(&format!("{HEADER}{nodes}{CELLS}")), error);
    let nodes = NODES.replace("3 1 1 0", "3 1 one 0");
    malformed(&format!("{HEADER}{nodes}{CELLS}"), "one", "a coordinate", "one");
    let cells = CELLS.replace("1 3 4", "1 3 5");
    let second = HEADER.len() + NODES.len() + CELLS.find("2 2 2 0").expect("it");
    let error = MshError::UnknownNode {
        tag: 5,
        element: 2,
        place: line(second, 14),
    };
    assert_eq!(refused(&format!("{HEADER}{NODES}{cells}")), error);
    let nodes = NODES.replace("3 1 1 0", "3 1 1 0.25");
    let error = MshError::OutOfPlane {
        tag: 3,
        place: line(HEADER.len() + 25, 8),
        axis: 'z',
        value: 0.25,
        expected: 0.0,
        dimension: 2,
    };
    assert_eq!(refused(&format!("{HEADER}{nodes}{CELLS}")), error);
    let nodes = NODES.replace("3 1 1 0", "3 nan 1 0");
    let error = refused(&format!("{HEADER}{nodes}{CELLS}"));
    assert_eq!(error.to_string(), "node 3 (line 8) is at [NaN, 1.0]");
    let cells = CELLS.replace("1 3 4", "1 4 3");
    let error = MshError::InvalidMesh {
        fault: MeshError::InvertedCell { cell: 1, volume: -0.5 },
        message: "element 2 (line 14) is inverted, its volume is -5e-1".to_owned(),
    };
    assert_eq!(refused(&format!("{HEADER}{NODES}{cells}")), error);
}

/// Tags with gaps, and a node before all others that no cell names: numbers counted from 0 would be none of the file's.
#[test]
fn faults_of_meshes_have_the_tags_and_lines_of_the_file() {
    let nodes = "$Nodes\n6\n5 9 9 0\n10 0 0 0\n20 1 0 0\n30 1 1 0\n40 0 1 0\n50 0.5 0.5 0\n$EndNodes\n";
    let message = |elements: &[&str]| {
        let elements: String = (7..)
            .zip(elements)
            .map(|(tag, nodes)| format!("{tag}0 2 2 0 1 {nodes}\n"))
            .collect();
        let count = elements.lines().count();
        refused(&format!("{HEADER}{nodes}$Elements\n{count}\n{elements}$EndElements\n")).to_string()
    };
    for (elements, expected) in [
        (
            ["10 20 30", "10 40 30"],
            "element 80 (line 16) is inverted, its volume is -5e-1",
        ),
        (
            ["10 20 30", "20 30 10"],
            "element 70 (line 15) and element 80 (line 16) have the same vertices",
        ),
        (
            ["10 20 30", "10 40 40"],
            "element 80 (line 16) names node 40 (line 10) twice",
        ),
        (
            ["10 20 30", "10 20 40"],
            "element 70 (line 15) and element 80 (line 16) lie on the same side of the facet of node 10 (line 7) and node 20 (line 8)",
        ),
        (
            ["10 20 30", "10 50 40"],
            "node 50 (line 11) lies on the boundary of element 70 (line 15), which it does not belong to",
        ),
    ] {
        assert_eq!(message(&elements), expected);
    }
    let unknown = message(&["10 20 30", "10 30 60"]);
    assert_eq!(unknown, "line 16: element 80 names node 60, which there is not");
}

/// A group that the file names and no element is in is known, and empty; an element of a group that is no facet, or names no node, is an error.
#[test]
fn groups_of_nothing() {
    let names = "$PhysicalNames\n2\n1 1 \"rim\"\n1 2 \"hole\"\n$EndPhysicalNames\n";
    let read = |facet: &str| {
        let cells = CELLS.replace("$Elements\n2\n", &format!("$Elements\n3\n9 1 2 1 1 {facet}\n"));
        read_named_msh::<2>(format!("{HEADER}{names}{NODES}{cells}").as_bytes())
    };
    let named = read("1 2").expect("a mesh");
    assert_eq!((named.facets["rim"].len(), named.facets["hole"].len()), (2, 0));
    let error = read("2 4").expect_err("no facet").to_string();
    assert_eq!(
        error,
        "line 18: element 9 of the physical group `rim` is no facet of a cell"
    );
    let error = read("2 7").expect_err("no node").to_string();
    assert_eq!(error, "line 18: element 9 names node 7, which there is not");
}

#[test]
fn elements_of_other_kinds() {
    let unsupported = |kind, name, dimension, place| MshError::UnsupportedElement {
        kind,
        name,
        dimension,
        place,
    };
    let text = std::str::from_utf8(QUADRANGLES).expect("text");
    let block = "2 1 3 16\n";
    let byte = text.rfind(block).expect("a block of quadrangles");
    let place = line(byte, 1 + text[..byte].matches('\n').count());
    assert_eq!(refused(text), unsupported(3, "quadrangle", 2, place));
    let message = refused(text).to_string();
    assert!(
        message.ends_with("elements of type 3 (quadrangle) in a mesh of dimension 2, whose cells are triangles with straight edges (type 2)"),
        "{message}"
    );
    let cells = CELLS.replace("2 2 2 0", "2 99 2 0");
    let place = line(HEADER.len() + NODES.len() + CELLS.find("2 2 2 0").expect("it"), 14);
    assert_eq!(
        refused(&format!("{HEADER}{NODES}{cells}")),
        unsupported(99, "unknown", 2, place)
    );
    let tetrahedra = read_msh::<2>(BRICK[0]).expect_err("three dimensions");
    assert!(
        matches!(
            tetrahedra,
            MshError::UnsupportedElement {
                kind: 4,
                dimension: 2,
                ..
            }
        ),
        "{tetrahedra}"
    );
    let name = "tetrahedron";
    assert_eq!(read_msh::<3>(PLATE[3]), Err(MshError::NoCells { name, dimension: 3 }));
    let dimension = MeshError::UnsupportedDimension { dimension: 4 };
    assert_eq!(read_msh::<4>(PLATE[3]), Err(MshError::Mesh(dimension)));
}

#[test]
fn files_that_end_too_early() {
    fn check<const D: usize>(file: &[u8]) {
        let whole = read_msh::<D>(file).expect("a mesh");
        for length in 0..file.len() {
            // Without its last line break it is complete.
            let cut = read_msh::<D>(&file[..length]);
            assert!(
                cut.is_err() || length + 1 == file.len() && cut.as_ref() == Ok(&whole),
                "{length}"
            );
        }
    }
    BAR.iter().for_each(|file| check::<1>(file));
    PLATE.iter().for_each(|file| check::<2>(file));
    BRICK.iter().for_each(|file| check::<3>(file));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    /// Whatever comes of it is a mesh or an error.
    #[test]
    fn damaged_files_do_no_harm(file in 0..4usize, damage in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..4)) {
        let mut flat = PLATE[file].to_vec();
        let mut solid = BRICK[file].to_vec();
        for (place, value) in damage {
            *place.get_mut(&mut flat) = value;
            *place.get_mut(&mut solid) = value;
        }
        let _ = read_msh::<2>(&flat);
        let _ = read_msh::<3>(&solid);
    }
}
