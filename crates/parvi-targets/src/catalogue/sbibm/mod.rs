//! Posteriors of a benchmark of simulation-based inference whose likelihoods are known: uniform priors on a box, numbered observations.
//!
//! Source: J.-M. Lueckmann, J. Boelts, D. S. Greenberg, P. J. Gonçalves, J. H. Macke, *Benchmarking simulation-based inference*,
//! AISTATS 2021, the appendix on tasks; the observations are those of <https://github.com/sbi-benchmark/sbibm>, commit 1a45fa72.

mod box_posterior;
mod inverse_wishart;
mod nested_normals;
mod simple_likelihood;
mod simulator;
mod two_moons;

pub use box_posterior::BoxPosterior;
pub use nested_normals::NestedNormals;
pub use simple_likelihood::SimpleLikelihood;
pub use simulator::Simulator;
pub use two_moons::TwoMoons;

/// The coordinates that a sampler moves, as log odds of the parameters' places in the box; `None` for the name of another target.
pub(crate) fn coordinate_names(target: &str) -> Option<Vec<String>> {
    let dimension = match target.strip_prefix("sbibm-")?.rsplit_once('-')?.0 {
        "slcp" => 5,
        _ => 2,
    };
    Some((1..=dimension).map(|k| format!("logit θ_{{{k}}}")).collect())
}
