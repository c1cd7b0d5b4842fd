use mpm_materials::{Law, Material, Memory};

/// What a body of the paper's algorithms is handed beside its options: inputs that depend on the dimension or are code.
#[derive(Clone, Copy, Default)]
pub struct PaperBody<'a, const D: usize> {
    /// The material, Ψ of the paper's inputs; `None`: that of the options.
    pub material: Option<&'a dyn Material<D>>,
    /// A law with memory or rates in the place of a material: `&Numbered(law)`.
    pub law: Option<&'a dyn Law<D, State = Memory>>,
    /// α in step t of T, (t, T) ↦ α with t from 1: any finite number of either sign. Asked for once per step, in order, before the run. `None`: that of the options.
    pub alpha: Option<&'a dyn Fn(usize, usize) -> f64>,
}
