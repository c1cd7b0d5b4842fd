use mpm_materials::{DruckerPragerState, SofteningState};

/// Internal variables of any law.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Memory {
    /// None: hyperelastic laws and fluids.
    #[default]
    Nothing,
    /// Of metal plasticity.
    Softening(SofteningState),
    /// Of granular friction.
    DruckerPrager(DruckerPragerState),
}

/// Numbers that say all that a law remembers.
pub const MEMORY_SIZE: usize = 2;

/// Names of internal variables, as files call them.
pub const INTERNAL_VARIABLES: &[&str] = &["plastic_strain", "out_of_plane_strain", "volume_correction"];

impl Memory {
    /// An internal variable by its name; `None` where the law has no such one.
    pub fn variable(&self, name: &str) -> Option<f64> {
        match (self, name) {
            (Self::Softening(state), "plastic_strain") => Some(state.accumulated_plastic_strain),
            (Self::Softening(state), "out_of_plane_strain") => Some(state.out_of_plane_strain),
            (Self::DruckerPrager(state), "volume_correction") => Some(state.volume_correction),
            _ => None,
        }
    }

    /// All of it as numbers.
    pub fn numbers(&self) -> [f64; MEMORY_SIZE] {
        match self {
            Self::Nothing => [0.0; MEMORY_SIZE],
            Self::Softening(state) => [state.accumulated_plastic_strain, state.out_of_plane_strain],
            Self::DruckerPrager(state) => [state.volume_correction, 0.0],
        }
    }

    /// The memory of the same kind as this one with these [`numbers`](Self::numbers).
    pub fn with_numbers(&self, numbers: &[f64; MEMORY_SIZE]) -> Self {
        match self {
            Self::Nothing => Self::Nothing,
            Self::Softening(_) => Self::Softening(SofteningState {
                accumulated_plastic_strain: numbers[0],
                out_of_plane_strain: numbers[1],
            }),
            Self::DruckerPrager(_) => Self::DruckerPrager(DruckerPragerState {
                volume_correction: numbers[0],
            }),
        }
    }
}

/// A law's own internal variables, in and out of a [`Memory`].
pub(super) trait Remembered: Default {
    /// These variables; virgin where the memory is another law's.
    fn recall(memory: &Memory) -> Self;

    /// A memory of them.
    fn store(self) -> Memory;
}

impl Remembered for () {
    #[inline(always)]
    fn recall(_: &Memory) -> Self {}

    #[inline(always)]
    fn store(self) -> Memory {
        Memory::Nothing
    }
}

impl Remembered for SofteningState {
    #[inline(always)]
    fn recall(memory: &Memory) -> Self {
        match memory {
            Memory::Softening(state) => *state,
            _ => Self::default(),
        }
    }

    #[inline(always)]
    fn store(self) -> Memory {
        Memory::Softening(self)
    }
}

impl Remembered for DruckerPragerState {
    #[inline(always)]
    fn recall(memory: &Memory) -> Self {
        match memory {
            Memory::DruckerPrager(state) => *state,
            _ => Self::default(),
        }
    }

    #[inline(always)]
    fn store(self) -> Memory {
        Memory::DruckerPrager(self)
    }
}
