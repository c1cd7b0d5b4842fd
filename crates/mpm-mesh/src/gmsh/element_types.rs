//! Types of elements by their numbers (Gmsh reference manual, "MSH file format").

/// A type of elements.
pub struct ElementType {
    pub name: &'static str,
    pub dimension: usize,
    pub node_count: usize,
}

/// Name, dimension and number of nodes of types 1, 2, …
const TYPES: [(&str, usize, usize); 31] = [
    ("segment", 1, 2),
    ("triangle", 2, 3),
    ("quadrangle", 2, 4),
    ("tetrahedron", 3, 4),
    ("hexahedron", 3, 8),
    ("prism", 3, 6),
    ("pyramid", 3, 5),
    ("segment of 3 nodes", 1, 3),
    ("triangle of 6 nodes", 2, 6),
    ("quadrangle of 9 nodes", 2, 9),
    ("tetrahedron of 10 nodes", 3, 10),
    ("hexahedron of 27 nodes", 3, 27),
    ("prism of 18 nodes", 3, 18),
    ("pyramid of 14 nodes", 3, 14),
    ("point", 0, 1),
    ("quadrangle of 8 nodes", 2, 8),
    ("hexahedron of 20 nodes", 3, 20),
    ("prism of 15 nodes", 3, 15),
    ("pyramid of 13 nodes", 3, 13),
    ("triangle of 9 nodes", 2, 9),
    ("triangle of 10 nodes", 2, 10),
    ("triangle of 12 nodes", 2, 12),
    ("triangle of 15 nodes", 2, 15),
    ("triangle of 15 nodes", 2, 15),
    ("triangle of 21 nodes", 2, 21),
    ("segment of 4 nodes", 1, 4),
    ("segment of 5 nodes", 1, 5),
    ("segment of 6 nodes", 1, 6),
    ("tetrahedron of 20 nodes", 3, 20),
    ("tetrahedron of 35 nodes", 3, 35),
    ("tetrahedron of 56 nodes", 3, 56),
];

/// The type of a number.
pub fn element_type(kind: u64) -> Option<ElementType> {
    let &(name, dimension, node_count) = TYPES.get(usize::try_from(kind).ok()?.checked_sub(1)?)?;
    Some(ElementType {
        name,
        dimension,
        node_count,
    })
}

/// Number and name of the simplex of a dimension.
pub fn simplex(dimension: usize) -> (u64, &'static str) {
    match dimension {
        1 => (1, "segment"),
        2 => (2, "triangle"),
        _ => (4, "tetrahedron"),
    }
}
