//! The kinds of random targets.

/// What a random target is hard by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum RandomFamily {
    /// A flat top with soft edges, wavy or twisted.
    Plateau,
    /// Laplace laws: a cusp on every hyperplane through the centre along the axes.
    Cusp,
    /// A multivariate t of 3 to 8 degrees of freedom, skewed and wavy.
    HeavyTail,
    /// A peak on a law that is 10 to 100 times as wide, sometimes on a third.
    Nested,
    /// 4 to 16 modes of unequal masses, widths and shapes.
    Modes,
    /// A thin curved ridge: bananas and waves.
    Ridge,
    /// A long piece wound up around a centre, a helix from three dimensions on.
    Spiral,
    /// Two curved pieces, one in the arm of the other.
    Moons,
    /// A scale that depends on a coordinate.
    Funnel,
    /// Planes of the families before, independent of each other: pieces multiply.
    Product,
    /// A lattice of modes, about 64 or 512 of them where the dimension allows, spacings and masses unequal.
    Grid,
    /// A mixture of two to four of the families before.
    Blend,
}

/// Of each, in the order of the list above, its name for tables and the smallest dimension that it has.
const FAMILIES: [(RandomFamily, &str, usize); 12] = [
    (RandomFamily::Plateau, "plateau", 1),
    (RandomFamily::Cusp, "cusp", 1),
    (RandomFamily::HeavyTail, "heavy-tail", 1),
    (RandomFamily::Nested, "nested", 1),
    (RandomFamily::Modes, "modes", 1),
    (RandomFamily::Ridge, "ridge", 2),
    (RandomFamily::Spiral, "spiral", 2),
    (RandomFamily::Moons, "moons", 2),
    (RandomFamily::Funnel, "funnel", 2),
    (RandomFamily::Product, "product", 3),
    (RandomFamily::Grid, "grid", 2),
    (RandomFamily::Blend, "blend", 2),
];

impl RandomFamily {
    /// All of them.
    pub fn all() -> [Self; FAMILIES.len()] {
        FAMILIES.map(|(family, ..)| family)
    }

    /// The smallest dimension that the family has.
    pub fn minimum_dimension(self) -> usize {
        FAMILIES[self as usize].2
    }

    /// A name for tables.
    pub fn name(self) -> &'static str {
        FAMILIES[self as usize].1
    }
}
