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

impl RandomFamily {
    /// All of them, in the order of this list.
    pub const ALL: [Self; 12] = [
        Self::Plateau,
        Self::Cusp,
        Self::HeavyTail,
        Self::Nested,
        Self::Modes,
        Self::Ridge,
        Self::Spiral,
        Self::Moons,
        Self::Funnel,
        Self::Product,
        Self::Grid,
        Self::Blend,
    ];

    /// The smallest dimension that the family has.
    pub fn minimum_dimension(self) -> usize {
        match self {
            Self::Plateau | Self::Cusp | Self::HeavyTail | Self::Nested | Self::Modes => 1,
            Self::Ridge | Self::Spiral | Self::Moons | Self::Funnel | Self::Grid | Self::Blend => 2,
            Self::Product => 3,
        }
    }

    /// A name for tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Plateau => "plateau",
            Self::Cusp => "cusp",
            Self::HeavyTail => "heavy-tail",
            Self::Nested => "nested",
            Self::Modes => "modes",
            Self::Ridge => "ridge",
            Self::Spiral => "spiral",
            Self::Moons => "moons",
            Self::Funnel => "funnel",
            Self::Product => "product",
            Self::Grid => "grid",
            Self::Blend => "blend",
        }
    }
}
