//! Options whose values are words.

use parvi::{BasisChoice, Condensation, MomentCorrection, Monitor, NonFiniteScores, ScoreLocation, StartDraws};

use crate::words;

words! {
    /// Background basis.
    #[derive(Default)]
    Basis {
        /// Hat functions on the simplices of the lattice A_D*
        #[default]
        Lattice,
        /// Tensor-product hat functions
        Linear,
        /// Tensor-product quadratic B-splines
        Quadratic,
        /// Tensor-product cubic B-splines
        Cubic,
        /// Hat functions on the mesh of --mesh, in 2 and 3 dimensions (mpm)
        Mesh,
    }

    /// On or off.
    Switch {
        /// On
        On,
        /// Off
        Off,
    }

    /// What particles are made of a weighted pool.
    CondensationName {
        /// Particles of equal mass
        On,
        /// The points of the pool, with their weights
        Off,
        /// The points of the pool and free draws of its proposals, with weights that are less noisy
        Controlled,
    }

    /// What the last move puts right.
    Correction {
        /// Nothing
        Off,
        /// The mean
        Mean,
        /// Mean and covariance
        Affine,
    }

    /// How particles are drawn from their initial law.
    Draws {
        /// Scrambled Sobol points through the normal quantile
        QuasiRandom,
        /// Independent draws
        Independent,
    }

    /// How velocities travel between particles and nodes.
    Transfer {
        /// Particle in cell
        Pic,
        /// Affine particle in cell
        Apic,
        /// A blend of FLIP and PIC, see --flip-share
        Flip,
        /// A blend of affine FLIP and affine particle in cell, see --flip-share
        AffineFlip,
    }

    /// What is watched of a body on its way.
    #[derive(Default)]
    MonitorName {
        /// Kernel Stein discrepancy
        #[default]
        Stein,
        /// Minus the mean log density of the target at the particles
        LogDensity,
        /// Minus the mean log density of the particles on the grid
        ParticleDensity,
    }

    /// Where the score is evaluated.
    Score {
        /// At the particles
        Particles,
        /// At the nodes
        Nodes,
        /// At the particles, interpolated from a grid whose nodes are evaluated once (mpm, not on a mesh)
        Cached,
    }

    /// What is done about a particle whose score is not finite.
    NonFinite {
        /// Pull the particle towards the centre of the frame
        PullBack,
        /// Take steps back and make them again with half of the time step
        RejectStep,
        /// End with an error
        Report,
    }

    /// The coordinates that the paper's algorithms work in.
    FrameName {
        /// Those in which the target has unit scale
        Target,
        /// The target's own
        Identity,
    }

    /// How the factor before the score goes from --alpha-from to --alpha-to.
    AlphaSchedule {
        /// Geometric
        Geometric,
        /// Linear
        Linear,
        /// Linear, several times, see --alpha-cycles
        Cyclic,
    }

    /// What Stein thinning chooses from.
    PoolChoice {
        /// Independent exact draws
        Exact,
        /// Draws of the No-U-Turn sampler
        Nuts,
    }
}

impl Basis {
    /// The basis without end; none for a mesh.
    pub fn uniform(self) -> Option<BasisChoice> {
        match self {
            Self::Lattice => Some(BasisChoice::Lattice),
            Self::Linear => Some(BasisChoice::Linear),
            Self::Quadratic => Some(BasisChoice::Quadratic),
            Self::Cubic => Some(BasisChoice::Cubic),
            Self::Mesh => None,
        }
    }

    /// Nodes per particle.
    pub fn stencil(self, dim: usize) -> usize {
        let power = |base: usize| base.saturating_pow(dim as u32);
        match self {
            Self::Lattice | Self::Mesh => dim + 1,
            Self::Linear => power(2),
            Self::Quadratic => power(3),
            Self::Cubic => power(4),
        }
    }
}

impl Switch {
    /// Whether it is on.
    pub fn is_on(self) -> bool {
        self == Self::On
    }
}

impl From<MonitorName> for Monitor {
    fn from(name: MonitorName) -> Self {
        match name {
            MonitorName::Stein => Self::SteinDiscrepancy,
            MonitorName::LogDensity => Self::LogDensity,
            MonitorName::ParticleDensity => Self::ParticleDensity,
        }
    }
}

/// The library's choice of the same name for every word.
macro_rules! as_in_the_library {
    ($words:ident => $choices:ident { $($name:ident),* }) => {
        impl From<$words> for $choices {
            fn from(word: $words) -> Self {
                match word {
                    $($words::$name => Self::$name),*
                }
            }
        }
    };
}

as_in_the_library!(CondensationName => Condensation { On, Off, Controlled });
as_in_the_library!(Correction => MomentCorrection { Off, Mean, Affine });
as_in_the_library!(Draws => StartDraws { QuasiRandom, Independent });
as_in_the_library!(Score => ScoreLocation { Particles, Nodes, Cached });
as_in_the_library!(NonFinite => NonFiniteScores { PullBack, RejectStep, Report });
