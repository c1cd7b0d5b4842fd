//! Elements of several physical groups, and groups of partitioned meshes.

use mpm_mesh::{MshError, NamedMesh, read_msh, read_named_msh};

use super::samples;

const NODES: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];

/// Number, type, tags and nodes of an element.
type Element = (i32, i32, [i32; 2], &'static [i32]);

/// Version 2.2 as text.
fn text(elements: &[Element]) -> Vec<u8> {
    let words = |list: &[i32]| list.iter().map(|x| format!(" {x}")).collect::<String>();
    let nodes: String = (1..)
        .zip(NODES)
        .map(|(k, [x, y, z])| format!("{k} {x} {y} {z}\n"))
        .collect();
    let lines = elements
        .iter()
        .map(|(number, kind, tags, nodes)| format!("{number} {kind} 2{}{}\n", words(tags), words(nodes)));
    let (lines, count) = (lines.collect::<String>(), elements.len());
    let names = "$PhysicalNames\n4\n1 10 \"floor\"\n1 11 \"outside\"\n2 1 \"left\"\n2 3 \"all\"\n$EndPhysicalNames\n";
    format!("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n{names}$Nodes\n4\n{nodes}$EndNodes\n$Elements\n{count}\n{lines}$EndElements\n").into_bytes()
}

/// The same as bytes, a header for every run of elements of a type.
fn binary(elements: &[Element]) -> Vec<u8> {
    let ints = |list: &[i32]| list.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<u8>>();
    let mut file = b"$MeshFormat\n2.2 1 8\n".to_vec();
    file.extend(
        [
            &ints(&[1]),
            b"\n$EndMeshFormat\n$PhysicalNames\n2\n1 10 \"floor\"\n1 11 \"outside\"\n$EndPhysicalNames\n$Nodes\n4\n"
                .as_slice(),
        ]
        .concat(),
    );
    for (tag, position) in (1..).zip(NODES) {
        file.extend(ints(&[tag]));
        file.extend(position.iter().flat_map(|x| x.to_le_bytes()));
    }
    file.extend(format!("\n$EndNodes\n$Elements\n{}\n", elements.len()).as_bytes());
    for run in elements.chunk_by(|a, b| a.1 == b.1) {
        file.extend(ints(&[run[0].1, run.len() as i32, 2]));
        for (number, _, tags, nodes) in run {
            file.extend([ints(&[*number]), ints(tags), ints(nodes)].concat());
        }
    }
    file.extend(b"\n$EndElements\n");
    file
}

/// A square whose left triangle and lower side are in two groups each. Gmsh counts on for each group, or, told to preserve numbers, repeats that of the element.
fn square(preserved: bool) -> Vec<Element> {
    let numbers = if preserved {
        [1, 1, 2, 5, 5, 6]
    } else {
        [1, 2, 3, 4, 5, 6]
    };
    vec![
        (numbers[0], 1, [10, 1], &[1, 2]),
        (numbers[1], 1, [11, 1], &[1, 2]),
        (numbers[2], 1, [11, 2], &[2, 3]),
        (numbers[3], 2, [1, 7], &[1, 2, 3]),
        (numbers[4], 2, [3, 7], &[1, 2, 3]),
        (numbers[5], 2, [3, 8], &[1, 3, 4]),
    ]
}

#[test]
fn in_version_2_an_element_that_comes_once_for_each_group_is_one() {
    for elements in [square(false), square(true)] {
        for file in [text(&elements), binary(&elements)] {
            let NamedMesh { mesh, facets } = read_named_msh::<2>(&file).expect("a mesh");
            assert_eq!(mesh, samples::square());
            assert_eq!(facets["floor"], [0, 1]);
            assert_eq!(facets["outside"], [0, 1, 1, 2]);
            assert_eq!(read_msh::<2>(&file).as_ref(), Ok(&mesh));
        }
    }
}

#[test]
fn a_group_with_two_names_is_refused() {
    let file = String::from_utf8(text(&square(false))).expect("text");
    let twice = file.replace("1 11 \"outside\"", "1 10 \"outside\"");
    let error = read_msh::<2>(twice.as_bytes()).expect_err("two names");
    assert_eq!(
        error.to_string(),
        "line 7: `outside` stands where the name that the group has already should be"
    );
}

/// What is there twice without being in two groups is still one cell too many.
#[test]
fn other_repeated_cells_are_refused() {
    let message = |change: fn(&mut [Element])| {
        let mut elements = square(false);
        change(&mut elements);
        let errors = [text(&elements), binary(&elements)].map(|file| read_msh::<2>(&file).expect_err("a cell twice"));
        assert!(
            errors.iter().all(|error| matches!(error, MshError::InvalidMesh { .. })),
            "{errors:?}"
        );
        errors[0].to_string()
    };
    let expected = "element 4 (line 23) and element 5 (line 24) have the same vertices";
    assert_eq!(message(|list| list[4].2 = [1, 7]), expected, "the same group");
    assert_eq!(message(|list| list[4].2 = [0, 7]), expected, "no group");
    assert_eq!(message(|list| list[3].2 = [0, 7]), expected, "no group at first");
    assert_eq!(
        message(|list| list[4].2 = [3, 8]),
        expected,
        "another part of the geometry"
    );
    assert_eq!(message(|list| list[4].3 = &[2, 3, 1]), expected, "another order");
    let expected = "element 4 (line 23) and element 6 (line 25) have the same vertices";
    assert_eq!(
        message(|list| list[5] = (6, 2, [1, 7], &[1, 2, 3])),
        expected,
        "the first group again"
    );
}

/// Elements of a partitioned mesh of version 4.1 are on entities of their own, which `$PartitionedEntities` has the groups of.
#[test]
fn partitioned_meshes_keep_their_groups() {
    let head = "$PhysicalNames\n2\n1 10 \"floor\"\n1 11 \"right\"\n$EndPhysicalNames\n";
    let mut file = format!("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n{head}");
    file += "$Entities\n1 2 1 0\n1 0 0 0 0\n1 0 0 0 1 0 0 1 10 2 1 -1\n2 1 0 0 1 1 0 1 11 0\n1 0 0 0 1 1 0 1 1 0\n$EndEntities\n";
    // Two partitions, a ghost entity; a point, three curves (the third between the partitions), two surfaces.
    file += "$PartitionedEntities\n2 1\n9 1\n1 3 2 0\n2 0 1 2 1 2 0 0 0 0\n3 1 1 1 1 0 0 0 1 0 0 1 10 2 2 -2\n4 1 2 1 1 1 0 0 1 1 0 1 11 0\n\
             5 2 1 2 1 2 0 0 0 1 1 0 0 0\n2 2 1 1 1 0 0 0 1 1 0 0 0\n3 2 1 1 2 0 0 0 1 1 0 0 2 3 -4\n$EndPartitionedEntities\n";
    file += "$Nodes\n1 4 1 4\n2 2 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n$EndNodes\n";
    file += "$Elements\n5 5 1 5\n1 3 1 1\n1 1 2\n1 4 1 1\n2 2 3\n1 5 1 1\n3 1 3\n2 2 2 1\n4 1 2 3\n2 3 2 1\n5 1 3 4\n$EndElements\n";
    let NamedMesh { mesh, facets } = read_named_msh::<2>(file.as_bytes()).expect("a mesh");
    assert_eq!(mesh, samples::square());
    assert_eq!((&facets["floor"][..], &facets["right"][..]), (&[0, 1][..], &[1, 2][..]));

    let bad = file.replace("3 1 1 1 1 0", "3 1 1 1 x 0");
    let refused = read_named_msh::<2>(bad.as_bytes()).expect_err("no number").to_string();
    assert_eq!(refused, "line 21: `x` stands where the number of a partition should be");

    // Entities tell the groups of elements, so they cannot come behind these.
    let (before, entities) = file.split_once("$PartitionedEntities").expect("the section");
    let (entities, behind) = entities.split_once("$EndPartitionedEntities\n").expect("its end");
    let late = format!("{before}{behind}$PartitionedEntities{entities}$EndPartitionedEntities\n");
    let refused = read_named_msh::<2>(late.as_bytes()).expect_err("too late").to_string();
    assert_eq!(
        refused,
        "line 41: `$PartitionedEntities` stands where a section that may follow $Elements should be"
    );
}
