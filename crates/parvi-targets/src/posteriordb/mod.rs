//! Posteriors of posteriordb: models of the field on their data, which have published reference draws.
//!
//! Source: M. Magnusson, P. Bürkner, A. Vehtari et al., posteriordb, <https://github.com/stan-dev/posteriordb>, commit 28f8d3d6.

mod data;
mod linear;
mod model_posterior;
mod prior;

pub use linear::LinearModel;
pub use model_posterior::ModelPosterior;
pub use prior::Prior;

/// The coordinates that a sampler moves, in the names of posteriordb's parameters; `None` for the name of another target.
pub(crate) fn coordinate_names(target: &str) -> Option<Vec<String>> {
    let names: &[&str] = match target {
        "kidscore" | "mesquite" => &["beta[1]", "beta[2]", "beta[3]", "beta[4]", "log sigma"],
        "blr" => &["beta[1]", "beta[2]", "beta[3]", "beta[4]", "beta[5]", "log sigma"],
        _ => return None,
    };
    Some(names.iter().map(|&name| name.to_owned()).collect())
}
