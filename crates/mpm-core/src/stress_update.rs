/// When in a step the particles deform, and so which state the stress is of (Bardenhagen 2002; Nairn 2003).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum StressUpdate {
    /// USF: with the velocities that the particles bring to the grid, before forces are taken. Keeps energy, at the
    /// price of a second mapping of the momentum.
    First,
    /// USL: with the velocities after the forces, in the pass that moves the particles.
    #[default]
    Last,
    /// MUSL (Sulsky, Zhou & Schreyer 1995): with the velocities that the moved particles send to the grid once more.
    ModifiedLast,
}
